// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Descriptions of clouds by the bytes of an input; where the points lie is left to the target.

#pragma once

#include "fuzz/fuzz_target.hpp"

namespace pose_wall::test {

inline pose_wall_field field_by(Input* input) {
  return {input->byte() % 40U, input->byte() % 10U};
}

// Any description: most are refused.
inline pose_wall_cloud any_description(Input* input) {
  auto cloud = input->take<pose_wall_cloud>();
  cloud.struct_size = sizeof cloud;
  cloud.inputs = nullptr;  // what a pointer points to nobody can check
  return cloud;
}

// One that is often taken.
inline pose_wall_cloud likely_description(Input* input) {
  pose_wall_cloud cloud{};
  cloud.struct_size = sizeof cloud;
  cloud.big_endian = input->below(2);
  cloud.width = input->take<std::uint16_t>() % 8192U;
  cloud.height = 1 + input->below(4);
  cloud.point_step = 1 + input->byte() % 48U;
  cloud.row_step = input->take<std::uint16_t>();
  cloud.stamp_ns = input->take<std::int64_t>();
  cloud.x = field_by(input);
  cloud.y = field_by(input);
  cloud.z = field_by(input);
  cloud.intensity = field_by(input);
  return cloud;
}

inline pose_wall_cloud description_by(Input* input, bool any) {
  return any ? any_description(input) : likely_description(input);
}

}  // namespace pose_wall::test
