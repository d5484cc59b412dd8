// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: process images. Of any result with an engine's head, whatever its quantities hold, both images have no
// number that stops a controller and pass their own check; any image that passes the check does not when one bit of it
// is turned. A result whose head no engine wrote gives none.

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

template <typename Quantity>
void require_numbers2(const Quantity& q, std::int32_t protection) {
  require(protection >= 0, "a level is not negative");
  require(q.state <= POSE_WALL_VALID, "a known state");
  require(q.cause <= POSE_WALL_PARTS, "a known cause");
  require((q.cause == POSE_WALL_PARTS) || protection != POSE_WALL_IMAGE_NO_BOUND, "no level, no cause");
}

template <typename Image>
void require_bits_matter(Image image, std::uint8_t which, std::int32_t (*check)(const Image*)) {
  auto* const bytes = reinterpret_cast<unsigned char*>(&image);
  // The first four are struct_size: another size is another image.
  bytes[which % sizeof image] = static_cast<unsigned char>(bytes[which % sizeof image] ^ (1U << (which % 8U)));
  require(check(&image) != POSE_WALL_OK, "a turned bit is found");
}

template <typename Image>
void look_at_bytes(Input* input, std::uint8_t which, std::int32_t (*check)(const Image*)) {
  const auto image = input->take<Image>();
  if (check(&image) == POSE_WALL_OK) require_bits_matter(image, which, check);
}

// The quantities are the input's, the head is the engine's.
pose_wall_result result_of(pose_wall_engine* engine, Input* input) {
  auto result = input->take<pose_wall_result>();
  result.struct_size = sizeof result;
  pose_wall_result head;
  head.struct_size = sizeof head;
  require_ok(pose_wall_age(engine, result.stamp_ns, &head), "age");
  result.mark = head.mark;
  result.config_crc32 = head.config_crc32;
  result.publication = head.publication;
  result.stamp_ns = head.stamp_ns;
  result.frame_index = head.frame_index;
  for (pose_wall_value& v : result.quantity) v.state %= POSE_WALL_VALID + 1U;
  return result;
}

void look_at_image(const pose_wall_result& result, std::uint8_t which) {
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
  require_bits_matter(image, which, pose_wall_image_check);
}

void look_at_image2(const pose_wall_result& result, pose_wall_image_source source, std::uint8_t which) {
  pose_wall_image2 image;
  image.struct_size = sizeof image;
  source.struct_size = sizeof source;
  require_ok(pose_wall_image2_fill(&result, (which & 2U) != 0 ? &source : nullptr, &image), "fill 2");
  require_ok(pose_wall_image2_check(&image), "check 2");
  for (const pose_wall_image2_angle* a : {&image.roll, &image.pitch, &image.yaw}) {
    require_numbers2(*a, a->protection_mdeg);
  }
  for (const pose_wall_image2_distance* d : {&image.d_lf, &image.d_lb, &image.d_rf, &image.d_rb}) {
    require_numbers2(*d, d->protection_mm);
  }
  require_bits_matter(image, which, pose_wall_image2_check);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock block;
  static pose_wall_engine* const engine = open_engine(small_config_for_fuzzing(), &block, 0xA5);
  Input input(data, size);
  const std::uint8_t which = input.byte();
  if ((which & 1U) != 0) {
    look_at_bytes<pose_wall_image>(&input, which, pose_wall_image_check);
    look_at_bytes<pose_wall_image2>(&input, which, pose_wall_image2_check);
    return 0;
  }
  pose_wall_result result = result_of(engine, &input);
  look_at_image(result, which);
  look_at_image2(result, input.take<pose_wall_image_source>(), which);
  ++result.mark;
  pose_wall_image image;
  image.struct_size = sizeof image;
  require(pose_wall_image_fill(&result, &image) == POSE_WALL_E_RESULT, "no engine made it");
  return 0;
}
