// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// libFuzzer target: arbitrary descriptions and bytes of clouds, several frames to one engine. Traps where a result
// breaks a promise; the sanitizers see the rest.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "support/engine_under_test.hpp"

namespace {

using pose_wall::test::EngineUnderTest;

EngineUnderTest& engine() {
  static EngineUnderTest instance(pose_wall::test::config_with(
      {{"points_max", "5000"}, {"ground_inlier_min", "20"}, {"wall_inlier_min", "20"}, {"intensity_weight", "0.5"}}));
  return instance;
}

void require(bool holds) {
  if (!holds) __builtin_trap();
}

void check(const pose_wall_result& r) {
  for (const pose_wall_value& v : r.quantity) {
    require(v.state <= POSE_WALL_VALID);
    require(v.confidence >= 0.0 && v.confidence <= 1.0);
    require(v.age_s >= 0.0);
    if (v.state != POSE_WALL_INVALID) require(std::isfinite(v.value) && std::isfinite(v.protection_level));
  }
  require(r.outliers <= r.voxels);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pose_wall_cloud cloud{};
  constexpr std::size_t kHead = sizeof cloud;
  if (size < kHead) return 0;
  std::memcpy(&cloud, data, kHead);
  cloud.struct_size = sizeof cloud;
  // The bytes that are really there; how the fuzzer describes them is its own affair.
  cloud.data = data + kHead;
  cloud.data_bytes = size - kHead;
  pose_wall_result result{};
  result.struct_size = sizeof result;
  const std::int32_t status = pose_wall_process(engine().get(), &cloud, &result);
  if (status == POSE_WALL_OK) check(result);
  require(std::strcmp(pose_wall_status_text(status), "unknown status") != 0);
  return 0;
}
