// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/scan.hpp"

#include <cstddef>
#include <cstring>
#include <utility>

namespace pose_wall::tools {

Frame frame_of(const Scan& scan) {
  PointLayout layout;
  layout.point_step = sizeof(ScanPoint);
  layout.count = static_cast<std::uint32_t>(scan.points.size());
  layout.big_endian = host_is_big_endian();
  layout.fields = {{"x", {offsetof(ScanPoint, x_m), POSE_WALL_FIELD_FLOAT32}},
                   {"y", {offsetof(ScanPoint, y_m), POSE_WALL_FIELD_FLOAT32}},
                   {"z", {offsetof(ScanPoint, z_m), POSE_WALL_FIELD_FLOAT32}},
                   {"intensity", {offsetof(ScanPoint, intensity), POSE_WALL_FIELD_FLOAT32}},
                   {"t", {offsetof(ScanPoint, t_ns), POSE_WALL_FIELD_UINT32}},
                   {"ring", {offsetof(ScanPoint, ring), POSE_WALL_FIELD_UINT16}}};
  Bytes bytes(scan.points.size() * sizeof(ScanPoint));
  if (!bytes.empty()) std::memcpy(bytes.data(), scan.points.data(), bytes.size());
  Frame frame = describe_frame(std::move(bytes), layout);
  frame.cloud.width = layout.count / scan.rings;
  frame.cloud.height = scan.rings;
  return frame;
}

std::optional<Scan> ScanAssembler::take() {
  if (scans_.empty()) return std::nullopt;
  std::optional<Scan> scan = std::move(scans_.front());
  scans_.pop_front();
  return scan;
}

}  // namespace pose_wall::tools
