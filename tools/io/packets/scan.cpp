// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/scan.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

namespace pose_wall::tools {
namespace {

// Points that all have one number would look like those of a planar scanner: a pattern of one line has no rings.
bool has_rings(const Scan& scan) {
  return scan.rings > 1 || std::any_of(scan.points.begin(), scan.points.end(),
                                       [&](const ScanPoint& point) { return point.ring != scan.points.front().ring; });
}

}  // namespace

Frame frame_of(const Scan& scan) {
  PointLayout layout;
  layout.point_step = sizeof(ScanPoint);
  layout.count = static_cast<std::uint32_t>(scan.points.size());
  layout.big_endian = host_is_big_endian();
  layout.fields = {{"x", {offsetof(ScanPoint, x_m), POSE_WALL_FIELD_FLOAT32}},
                   {"y", {offsetof(ScanPoint, y_m), POSE_WALL_FIELD_FLOAT32}},
                   {"z", {offsetof(ScanPoint, z_m), POSE_WALL_FIELD_FLOAT32}},
                   {"intensity", {offsetof(ScanPoint, intensity), POSE_WALL_FIELD_FLOAT32}},
                   {"t", {offsetof(ScanPoint, t_ns), POSE_WALL_FIELD_UINT32}}};
  if (has_rings(scan)) layout.fields.push_back({"ring", {offsetof(ScanPoint, ring), POSE_WALL_FIELD_UINT16}});
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
