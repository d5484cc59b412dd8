// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: process images. Of any result, also one that no engine gave, the image has no number that stops a
// controller and passes its own check; any image that passes the check does not when one bit of it is turned.

#include <cmath>
#include <initializer_list>

#include "fuzz/config_from_input.hpp"
#include "fuzz/fuzz_target.hpp"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

template <typename Quantity>
void require_numbers(const Quantity& q, float value, float protection) {
  require(std::isfinite(value) && std::isfinite(protection), "floats are finite");
  require(protection >= 0.0F, "a level is not negative");
  require(q.state <= POSE_WALL_VALID, "a known state");
}

void require_bits_matter(pose_wall_image image, std::uint8_t which) {
  auto* const bytes = reinterpret_cast<unsigned char*>(&image);
  // The first four are struct_size: another size is another image.
  bytes[which % sizeof image] = static_cast<unsigned char>(bytes[which % sizeof image] ^ (1U << (which % 8U)));
  require(pose_wall_image_check(&image) != POSE_WALL_OK, "a turned bit is found");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock block;
  static pose_wall_engine* const engine = open_engine(small_config_for_fuzzing(), &block, 0xA5);
  Input input(data, size);
  const std::uint8_t which = input.byte();
  if ((which & 1U) != 0) {
    auto image = input.take<pose_wall_image>();
    if (pose_wall_image_check(&image) == POSE_WALL_OK) require_bits_matter(image, which);
    return 0;
  }
  auto result = input.take<pose_wall_result>();
  result.struct_size = sizeof result;
  for (pose_wall_value& v : result.quantity) v.state %= POSE_WALL_VALID + 1U;
  pose_wall_image image;
  image.struct_size = sizeof image;
  require_ok(pose_wall_image_fill(&result, &image), "fill");
  require_ok(pose_wall_image_check(&image), "check");
  for (const pose_wall_image_angle* a : {&image.roll, &image.pitch, &image.yaw}) {
    require_numbers(*a, a->value_rad, a->protection_rad);
  }
  for (const pose_wall_image_distance* d : {&image.d_lf, &image.d_lb, &image.d_rf, &image.d_rb}) {
    require_numbers(*d, d->value_m, d->protection_m);
  }
  require_bits_matter(image, which);
  return 0;
}
