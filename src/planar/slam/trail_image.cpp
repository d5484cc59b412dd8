// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/slam/trail_image.hpp"

#include <cmath>
#include <cstring>

#include "base/math/crc32.hpp"
#include "base/math/finite.hpp"
#include "pose_wall_planar_slam.h"

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kMagic = 0x4C545750U;  // "PWTL"
constexpr std::uint32_t kVersion = POSE_WALL_PLANAR_TRAIL_VERSION;
constexpr std::uint64_t kHead = 5 * 4, kKeyframe = 8 + 4 + 5 * 8, kPoint = 2 * 4, kEdge = 3 * 4 + 9 * 8, kTail = 4;

class Writer {
 public:
  explicit Writer(unsigned char* to) : to_(to) {}
  void put(std::uint64_t value, std::uint32_t bytes) {
    for (std::uint32_t k = 0; k < bytes; ++k) {
      const auto byte = static_cast<unsigned char>(value >> (8U * k));
      *to_++ = byte;
      crc_.add_byte(byte);
    }
  }
  void put_u32(std::uint32_t value) { put(value, 4); }
  void put_double(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    put(bits, 8);
  }
  void put_float(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    put(bits, 4);
  }
  void put_pose(const Pose2& pose) {
    put_double(pose.x_m);
    put_double(pose.y_m);
    put_double(pose.yaw_rad);
  }
  std::uint32_t crc() const { return crc_.value(); }

 private:
  unsigned char* to_;
  Crc32 crc_;
};

class Reader {
 public:
  explicit Reader(const unsigned char* from) : from_(from) {}
  std::uint64_t get(std::uint32_t bytes) {
    std::uint64_t value = 0;
    for (std::uint32_t k = 0; k < bytes; ++k) value |= static_cast<std::uint64_t>(*from_++) << (8U * k);
    return value;
  }
  std::uint32_t get_u32() { return static_cast<std::uint32_t>(get(4)); }
  double get_double() {
    const std::uint64_t bits = get(8);
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  float get_float() {
    const std::uint32_t bits = get_u32();
    float value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  Pose2 get_pose() {
    Pose2 pose;
    pose.x_m = get_double();
    pose.y_m = get_double();
    pose.yaw_rad = get_double();
    return pose;
  }

 private:
  const unsigned char* from_;
};

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
bool is_trail(const Head& head, Reader reader) {
  std::uint64_t points = 0;
  double travel_m = 0.0;
  for (std::uint32_t k = 0; k < head.keyframes; ++k) {
    reader.get(8);
    points += reader.get_u32();
    const Pose2 pose = reader.get_pose();
    const double next_m = reader.get_double(), doubt_rad = reader.get_double();
    if (!is_pose(pose) || !(next_m >= travel_m && next_m < kFarthest_m) || !(doubt_rad >= 0.0 && doubt_rad < 1e9)) {
      return false;
    }
    travel_m = next_m;
  }
  if (points != head.points) return false;
  for (std::uint32_t k = 0; k < 2 * head.points; ++k) {
    if (!is_within(static_cast<double>(reader.get_float()), kMostPoint_m)) return false;
  }
  for (std::uint32_t k = 0; k < head.edges; ++k) {
    const std::uint32_t from = reader.get_u32(), to = reader.get_u32(), is_closure = reader.get_u32();
    if (!(from < to && to < head.keyframes && is_closure <= 1) || (is_closure == 0 && to != from + 1)) return false;
    if (!is_pose(reader.get_pose())) return false;
    for (int i = 0; i < 6; ++i) {
      if (!is_within(reader.get_double(), 1e12)) return false;
    }
  }
  return true;
}

constexpr int kUpper[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};

void read_keyframes(Reader* reader, Span<Keyframe> keyframes, Span<Pose2> poses) {
  std::uint32_t first = 0;
  for (std::uint32_t k = 0; k < keyframes.size(); ++k) {
    Keyframe& keyframe = keyframes[k];
    keyframe.stamp_ns = static_cast<std::int64_t>(reader->get(8));
    keyframe.first = first;
    keyframe.count = reader->get_u32();
    first += keyframe.count;
    poses[k] = reader->get_pose();
    keyframe.travel_m = reader->get_double();
    keyframe.doubt_rad = reader->get_double();
  }
}

void read_edge(Reader* reader, Edge* edge) {
  edge->from = reader->get_u32();
  edge->to = reader->get_u32();
  edge->is_closure = reader->get_u32() == 1;
  edge->step = reader->get_pose();
  for (const auto& at : kUpper) {
    edge->information(at[0], at[1]) = reader->get_double();
    edge->information(at[1], at[0]) = edge->information(at[0], at[1]);
  }
}

}  // namespace

std::uint64_t TrailImage::bytes(const Trail& trail) {
  return Head{trail.size(), trail.point_count_, trail.edge_count_}.bytes();
}

void TrailImage::write(const Trail& trail, unsigned char* to) {
  Writer writer(to);
  for (const std::uint32_t word : {kMagic, kVersion, trail.count_, trail.point_count_, trail.edge_count_}) {
    writer.put_u32(word);
  }
  for (std::uint32_t k = 0; k < trail.count_; ++k) {
    const Keyframe& keyframe = trail.keyframes_[k];
    writer.put(static_cast<std::uint64_t>(keyframe.stamp_ns), 8);
    writer.put_u32(keyframe.count);
    writer.put_pose(trail.poses_[k]);
    writer.put_double(keyframe.travel_m);
    writer.put_double(keyframe.doubt_rad);
  }
  for (std::uint32_t k = 0; k < trail.point_count_; ++k) {
    writer.put_float(trail.points_[k].x_m);
    writer.put_float(trail.points_[k].y_m);
  }
  for (std::uint32_t k = 0; k < trail.edge_count_; ++k) {
    const Edge& edge = trail.edges_[k];
    writer.put_u32(edge.from);
    writer.put_u32(edge.to);
    writer.put_u32(edge.is_closure ? 1 : 0);
    writer.put_pose(edge.step);
    for (const auto& at : kUpper) writer.put_double(edge.information(at[0], at[1]));
  }
  writer.put_u32(writer.crc());
}

std::int32_t TrailImage::read(const unsigned char* from, std::uint64_t bytes, Trail* trail) {
  if (bytes < kHead + kTail) return POSE_WALL_PLANAR_E_MAP_FILE;
  Reader reader(from);
  if (reader.get_u32() != kMagic || reader.get_u32() != kVersion) return POSE_WALL_PLANAR_E_MAP_FILE;
  Head head{};
  head.keyframes = reader.get_u32();
  head.points = reader.get_u32();
  head.edges = reader.get_u32();
  if (head.bytes() != bytes) return POSE_WALL_PLANAR_E_MAP_FILE;
  Crc32 crc;
  for (std::uint64_t k = 0; k < bytes - kTail; ++k) crc.add_byte(from[k]);
  if (Reader(from + bytes - kTail).get_u32() != crc.value() || !is_trail(head, reader))
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
    point.x_m = reader.get_float();
    point.y_m = reader.get_float();
  }
  for (Edge& edge : trail->edges_.first(head.edges)) read_edge(&reader, &edge);
  return POSE_WALL_OK;
}

}  // namespace pose_wall::planar
