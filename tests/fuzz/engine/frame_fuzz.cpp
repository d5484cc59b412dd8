// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: a cloud that is described anyhow, over bytes of the input or over a road whose bytes the input changes.
// What is refused changes nothing; what is taken keeps the contract, and so do the same points again and silence.

#include "fuzz/cloud_from_input.hpp"
#include "fuzz/config_from_input.hpp"
#include "fuzz/fuzz_target.hpp"
#include "fuzz/road_from_input.hpp"
#include "support/contract.hpp"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

pose_wall_config config() {
  pose_wall_config c = small_config_for_fuzzing();
  set_key(&c, "points_max", 8000);
  set_key(&c, "intensity_weight", 0.5);
  return c;
}

// A road, its bytes changed here and there.
constexpr std::uint32_t kRoadBytes = kRoadPointsMax * 12;
unsigned char g_road[kRoadBytes];

std::uint32_t changed_road(Input* input) {
  static const std::uint32_t count = scan_road(plain_road(), 0);
  std::memcpy(g_road, road_points(), std::size_t{count} * 12);
  while (input->left() >= 3 && count > 0) {
    const std::uint32_t at = input->take<std::uint16_t>() * 7U % (count * 12);
    g_road[at] = input->byte();
  }
  return count;
}

void give(pose_wall_engine* engine, const pose_wall_cloud& cloud, ContractWatch* watch) {
  pose_wall_result result = empty_result();
  const pose_wall_result before = result;
  const std::int32_t status = pose_wall_process(engine, &cloud, &result);
  require(status == pose_wall_cloud_check(&cloud), "the check says what process says");
  require(std::strcmp(pose_wall_status_text(status), "unknown status") != 0, "a status with a text");
  if (status != POSE_WALL_OK) {
    require(std::memcmp(&before, &result, sizeof result) == 0, "a refused cloud changes nothing");
    return;
  }
  require_kept(watch->processed(result));
  require(result.points_in == cloud.width * cloud.height, "all points are looked at");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock block;
  static const pose_wall_config settings = config();
  Input input(data, size);
  const std::uint8_t how = input.byte();
  pose_wall_cloud cloud = description_by(&input, (how & 1U) != 0);
  cloud.data = input.rest();
  cloud.data_bytes = input.left();
  if ((how & 2U) != 0) {
    const std::uint32_t count = changed_road(&input);
    if ((how & 4U) != 0) {
      require_ok(pose_wall_cloud_xyz32(&cloud, g_road, count, 12, cloud.stamp_ns), "xyz32");
    }
    cloud.data = g_road;
    cloud.data_bytes = std::uint64_t{count} * 12;
  }
  pose_wall_engine* const engine = open_engine(settings, &block, 0xA5);
  ContractWatch watch(settings);
  give(engine, cloud, &watch);
  if ((how & 8U) != 0) give(engine, cloud, &watch);
  pose_wall_result aged = empty_result();
  require_ok(pose_wall_age(engine, cloud.stamp_ns / 2 + 500000000, &aged), "age");
  require_kept(watch.aged(aged));
  return 0;
}
