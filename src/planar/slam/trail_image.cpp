// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/slam/trail_image.hpp"

#include <cmath>

#include "base/math/crc32.hpp"
#include "base/math/finite.hpp"
#include "part/saved_bytes.hpp"
#include "pose_wall_planar_slam.h"

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kMagic = 0x4C545750U;                       // "PWTL", by the format
constexpr std::uint32_t kVersion = POSE_WALL_PLANAR_TRAIL_VERSION;  // of the format, as the header says
// Bytes of the format's parts, field by field as they are written below.
constexpr std::uint64_t kHead = 5 * 4, kKeyframe = 8 + 4 + 5 * 8, kPoint = 2 * 4, kEdge = 3 * 4 + 9 * 8, kTail = 4;

void put_pose(const Pose2& pose, SavedWriter* writer) {
  for (const double number : {pose.x_m, pose.y_m, pose.yaw_rad}) writer->put(number);
}

Pose2 get_pose(SavedReader* reader) {
  Pose2 pose;
  for (double* const number : {&pose.x_m, &pose.y_m, &pose.yaw_rad}) *number = reader->get<double>();
  return pose;
}

struct Head {
  std::uint32_t keyframes, points, edges;

  std::uint64_t bytes() const { return kHead + keyframes * kKeyframe + points * kPoint + edges * kEdge + kTail; }
};

bool is_within(double value, double most) {
  return value >= -most && value <= most;
}

constexpr double kFarthest_m = 1e7, kMostPoint_m = 2000.0;  // beyond any road, and any range

bool is_pose(const Pose2& pose) {
  return is_within(pose.x_m, kFarthest_m) && is_within(pose.y_m, kFarthest_m) && is_within(pose.yaw_rad, 4.0);
}

// The numbers behind the head are a trail's: a checksum alone does not say so.
bool is_trail(const Head& head, SavedReader reader) {
  std::uint64_t points = 0;
  double travel_m = 0.0;
  for (std::uint32_t k = 0; k < head.keyframes; ++k) {
    reader.get<std::uint64_t>();
    points += reader.get<std::uint32_t>();
    const Pose2 pose = get_pose(&reader);
    const double next_m = reader.get<double>(), doubt_rad = reader.get<double>();
    if (!is_pose(pose) || !(next_m >= travel_m && next_m < kFarthest_m) || !(doubt_rad >= 0.0 && doubt_rad < 1e9)) {
      return false;
    }
    travel_m = next_m;
  }
  if (points != head.points) return false;
  for (std::uint32_t k = 0; k < 2 * head.points; ++k) {
    if (!is_within(static_cast<double>(reader.get<float>()), kMostPoint_m)) return false;
  }
  for (std::uint32_t k = 0; k < head.edges; ++k) {
    const std::uint32_t from = reader.get<std::uint32_t>(), to = reader.get<std::uint32_t>(),
                        is_closure = reader.get<std::uint32_t>();
    if (!(from < to && to < head.keyframes && is_closure <= 1) || (is_closure == 0 && to != from + 1)) return false;
    if (!is_pose(get_pose(&reader))) return false;
    for (int i = 0; i < 6; ++i) {
      if (!is_within(reader.get<double>(), 1e12)) return false;
    }
  }
  return true;
}

// Row and column of what a symmetric matrix is written as: its upper triangle, by the format.
constexpr int kUpper[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};

void read_keyframes(SavedReader* reader, Span<Keyframe> keyframes, Span<Pose2> poses) {
  std::uint32_t first = 0;
  for (std::uint32_t k = 0; k < keyframes.size(); ++k) {
    Keyframe& keyframe = keyframes[k];
    keyframe.stamp_ns = reader->get<std::int64_t>();
    keyframe.first = first;
    keyframe.count = reader->get<std::uint32_t>();
    first += keyframe.count;
    poses[k] = get_pose(reader);
    keyframe.travel_m = reader->get<double>();
    keyframe.doubt_rad = reader->get<double>();
  }
}

void read_edge(SavedReader* reader, Edge* edge) {
  edge->from = reader->get<std::uint32_t>();
  edge->to = reader->get<std::uint32_t>();
  edge->is_closure = reader->get<std::uint32_t>() == 1;
  edge->step = get_pose(reader);
  for (const auto& at : kUpper) {
    edge->information(at[0], at[1]) = reader->get<double>();
    edge->information(at[1], at[0]) = edge->information(at[0], at[1]);
  }
}

}  // namespace

std::uint64_t TrailImage::bytes(const Trail& trail) {
  return Head{trail.size(), trail.point_count_, trail.edge_count_}.bytes();
}

void TrailImage::write(const Trail& trail, unsigned char* to) {
  SavedWriter writer(to);
  for (const std::uint32_t word : {kMagic, kVersion, trail.count_, trail.point_count_, trail.edge_count_}) {
    writer.put(word);
  }
  for (std::uint32_t k = 0; k < trail.count_; ++k) {
    const Keyframe& keyframe = trail.keyframes_[k];
    writer.put(keyframe.stamp_ns);
    writer.put(keyframe.count);
    put_pose(trail.poses_[k], &writer);
    writer.put(keyframe.travel_m);
    writer.put(keyframe.doubt_rad);
  }
  for (std::uint32_t k = 0; k < trail.point_count_; ++k) {
    writer.put(trail.points_[k].x_m);
    writer.put(trail.points_[k].y_m);
  }
  for (std::uint32_t k = 0; k < trail.edge_count_; ++k) {
    const Edge& edge = trail.edges_[k];
    writer.put(edge.from);
    writer.put(edge.to);
    writer.put<std::uint32_t>(edge.is_closure ? 1 : 0);
    put_pose(edge.step, &writer);
    for (const auto& at : kUpper) writer.put(edge.information(at[0], at[1]));
  }
  writer.put(crc32(to, bytes(trail) - kTail));
}

std::int32_t TrailImage::read(const unsigned char* from, std::uint64_t bytes, Trail* trail) {
  if (bytes < kHead + kTail) return POSE_WALL_PLANAR_E_MAP_FILE;
  SavedReader reader(from);
  if (reader.get<std::uint32_t>() != kMagic || reader.get<std::uint32_t>() != kVersion)
    return POSE_WALL_PLANAR_E_MAP_FILE;
  Head head{};
  head.keyframes = reader.get<std::uint32_t>();
  head.points = reader.get<std::uint32_t>();
  head.edges = reader.get<std::uint32_t>();
  if (head.bytes() != bytes) return POSE_WALL_PLANAR_E_MAP_FILE;
  if (SavedReader(from + bytes - kTail).get<std::uint32_t>() != crc32(from, bytes - kTail) || !is_trail(head, reader))
    return POSE_WALL_PLANAR_E_MAP_FILE;
  if (head.keyframes > trail->keyframes_.size() || head.points > trail->points_.size() ||
      head.edges > trail->edges_.size()) {
    return POSE_WALL_E_BLOCK_SMALL;
  }
  trail->count_ = head.keyframes;
  trail->point_count_ = head.points;
  trail->edge_count_ = head.edges;
  read_keyframes(&reader, trail->keyframes_.first(head.keyframes), trail->poses_);
  for (ScanPoint& point : trail->points_.first(head.points)) {
    point.x_m = reader.get<float>();
    point.y_m = reader.get<float>();
  }
  for (Edge& edge : trail->edges_.first(head.edges)) read_edge(&reader, &edge);
  return POSE_WALL_OK;
}

}  // namespace pose_wall::planar
