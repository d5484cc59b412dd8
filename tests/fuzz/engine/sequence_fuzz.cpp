// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target and oracle: a config, then roads, garbage, silence, repeats, resets, saving and loading, under stamps
// that go anywhere. Every result keeps the contract, nothing that shows no road is valid, the image says what the
// result says, and a second engine on another block gives the same bits, also after it forgot all and loaded what the
// first one saved.

#include <cmath>

#include "fuzz/config_from_input.hpp"
#include "fuzz/fuzz_target.hpp"
#include "fuzz/garbage_from_input.hpp"
#include "fuzz/road_from_input.hpp"
#include "fuzz/stamps_from_input.hpp"
#include "support/contract.hpp"
#include "support/moments.hpp"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

// Bounds the time of an input.
constexpr int kEventsMax = 6;
// Above pose_wall_memento_bytes(); checked where it is used.
constexpr std::uint64_t kMementoRoom = 16384;

struct Pair {
  pose_wall_config config;
  pose_wall_engine* one;
  pose_wall_engine* other;
  KeptBlock* block_of_other;
  ContractWatch watch;
  std::int64_t stamp_ns = 0;
  std::uint32_t points = 0;  // in road_points()
  bool any_road = false;     // since all was forgotten
};

void require_same_points(const Pair& pair) {
  pose_wall_points a, b;
  require_ok(pose_wall_last_points(pair.one, &a), "last points");
  require_ok(pose_wall_last_points(pair.other, &b), "last points");
  require(a.count == b.count, "as many points");
  if (a.count == 0) return;
  for (const auto axis : {&pose_wall_points::x_base_m, &pose_wall_points::y_base_m, &pose_wall_points::z_base_m}) {
    require(std::memcmp(a.*axis, b.*axis, a.count * sizeof(float)) == 0, "the same points");
  }
  require(std::memcmp(a.label, b.label, a.count) == 0, "the same labels");
}

void require_image(const pose_wall_result& result) {
  pose_wall_image image;
  std::memset(&image, 0, sizeof image);
  image.struct_size = sizeof image;
  require_ok(pose_wall_image_fill(&result, &image), "image");
  require_ok(pose_wall_image_check(&image), "image check");
  const pose_wall_value& yaw = result.quantity[POSE_WALL_YAW];
  if (std::isnan(yaw.value)) {
    require(image.yaw.value_mdeg == POSE_WALL_IMAGE_NO_VALUE, "no value");
    return;
  }
  constexpr double kMdeg = 180000.0 / 3.14159265358979323846;
  const double off = std::fabs(image.yaw.value_mdeg - yaw.value * kMdeg);
  require(off <= 0.501, "the image's value is the result's");
  const bool bounded = image.yaw.protection_mdeg != POSE_WALL_IMAGE_NO_BOUND;
  require(!bounded || image.yaw.protection_mdeg >= yaw.protection_level * kMdeg, "the image's level is no smaller");
}

void process(Pair* pair, bool shows_a_road) {
  pose_wall_cloud cloud;
  require_ok(pose_wall_cloud_xyz32(&cloud, road_points(), pair->points, 12, pair->stamp_ns), "xyz32");
  pose_wall_result one = empty_result(), other = empty_result();
  require_ok(pose_wall_process(pair->one, &cloud, &one), "process");
  require_ok(pose_wall_process(pair->other, &cloud, &other), "process");
  require(std::memcmp(&one, &other, sizeof one) == 0, "the same bits");
  require_same_points(*pair);
  require_kept(pair->watch.processed(one));
  require(one.points_in == pair->points, "all points are looked at");
  if (!shows_a_road) require_kept(valid_from_garbage(one));
  require_image(one);
}

void age(Pair* pair) {
  pose_wall_result one = empty_result(), other = empty_result();
  require_ok(pose_wall_age(pair->one, pair->stamp_ns, &one), "age");
  require_ok(pose_wall_age(pair->other, pair->stamp_ns, &other), "age");
  require(std::memcmp(&one, &other, sizeof one) == 0, "the same bits while silent");
  require_kept(pair->watch.aged(one));
  require_image(one);
}

// The other engine begins anew, on another garbage, and goes on from what the first one remembers.
void hand_over(Pair* pair, int garbage) {
  static unsigned char memento[kMementoRoom], again[kMementoRoom];
  const std::uint64_t bytes = pose_wall_memento_bytes();
  require(bytes <= kMementoRoom, "room for a memento");
  require_ok(pose_wall_save(pair->one, nullptr, memento, bytes), "save");
  pair->other = open_engine(pair->config, pair->block_of_other, garbage);
  require_ok(pose_wall_load(pair->other, &kSameClock, memento, bytes), "load");
  require_ok(pose_wall_save(pair->other, nullptr, again, bytes), "save again");
  require(std::memcmp(memento, again, bytes) == 0, "what was loaded is what is saved");
}

void reset(Pair* pair) {
  require_ok(pose_wall_reset(pair->one), "reset");
  require_ok(pose_wall_reset(pair->other), "reset");
  pair->watch.forget();
}

void event(Input* input, Pair* pair) {
  const std::uint8_t what = input->byte();
  move_stamp(input, {160, 200, 220}, &pair->stamp_ns);
  switch (what % 8U) {
    case 0:
    case 1:
      pair->points = scan_road(road_by(input), what);
      pair->points = damage_points(input, road_points(), pair->points);
      pair->any_road = true;
      return process(pair, true);
    case 2:
    case 3:
      pair->points = garbage_points(input, road_points(), kRoadPointsMax);
      pair->any_road = false;
      return process(pair, false);
    case 4:
      return process(pair, pair->any_road);  // the very points of before
    case 5:
      return age(pair);
    case 6:
      return hand_over(pair, what);
    default:
      return reset(pair);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock block_of_one, block_of_other;
  Input input(data, size);
  const pose_wall_config config = config_by(&input);
  Pair pair{config, open_engine(config, &block_of_one, 0xA5), open_engine(config, &block_of_other, 0x00),
            &block_of_other, ContractWatch(config)};
  for (int i = 0; i < kEventsMax && !input.empty(); ++i) event(&input, &pair);
  return 0;
}
