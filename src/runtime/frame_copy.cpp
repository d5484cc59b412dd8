// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frame_copy.hpp"

#include <cstring>
#include <initializer_list>

#include "lidar/cloud_fields.hpp"
#include "part/struct_sizes.hpp"
#include "thinning.hpp"

namespace pose_wall::runtime {
namespace {

enum class Point { kReturn, kNotFinite, kZero };

// As the engine reads it: a double that rounds to no float but zero is one.
Point judge(const pose_wall_cloud& cloud, const unsigned char* point) {
  const bool swap = needs_swap(cloud);
  const float x = to_float(read_field(point, cloud.x, swap)), y = to_float(read_field(point, cloud.y, swap));
  const float z = to_float(read_field(point, cloud.z, swap));
  const auto is_number = [](float value) { return is_finite(static_cast<double>(value)); };
  if (!(is_number(x) && is_number(y) && is_number(z))) return Point::kNotFinite;
  return x == 0.0F && y == 0.0F && z == 0.0F ? Point::kZero : Point::kReturn;
}

// Of the points that hold no return, those that were measured first and last: times count from the cloud's first to its
// last point, whether they hold a return or not. NaN is neither.
struct Ends {
  const unsigned char* first = nullptr;
  const unsigned char* last = nullptr;
  double first_time = 0.0, last_time = 0.0;

  void note(const unsigned char* point, double time) {
    if (!is_finite(time)) return;
    if (first == nullptr || time < first_time) {
      first = point;
      first_time = time;
    }
    if (last == nullptr || time > last_time) {
      last = point;
      last_time = time;
    }
  }
};

struct Copier {
  const pose_wall_cloud& from;
  pose_wall_field field[kFields];  // of the source
  std::uint32_t bytes[kFields];    // 0: not copied

  std::uint32_t point_bytes() const {
    std::uint32_t sum = 0;
    for (const std::uint32_t of_field : bytes) sum += of_field;
    return sum;
  }

  unsigned char* copy(const unsigned char* point, unsigned char* to) const {
    for (std::uint32_t k = 0; k < kFields; ++k) {
      std::memcpy(to, point + field[k].offset, bytes[k]);
      to += bytes[k];
    }
    return to;
  }
};

Copier copier_of(const pose_wall_cloud& cloud, const CopiedFields& fields) {
  Copier c{cloud, {cloud.x, cloud.y, cloud.z, cloud.intensity, cloud.time, cloud.ring}, {}};
  const bool wanted[kFields] = {true, true, true, fields.intensity, fields.time, fields.ring};
  for (std::uint32_t k = 0; k < kFields; ++k) {
    const std::uint32_t bytes = field_bytes(c.field[k].type);
    const bool is_extra = k >= 4;
    if (wanted[k] && (!is_extra || c.point_bytes() + bytes <= fields.point_bytes_max)) c.bytes[k] = bytes;
  }
  return c;
}

pose_wall_cloud packed(const Copier& c, const unsigned char* data, std::uint64_t bytes) {
  const std::uint32_t point_bytes = c.point_bytes();
  const auto points = static_cast<std::uint32_t>(bytes / point_bytes);
  pose_wall_cloud cloud = cloud_in_a_row(data, points, point_bytes, c.from.stamp_ns);
  cloud.big_endian = c.from.big_endian;
  const auto to = fields_of(&cloud);
  std::uint32_t offset = 0;
  for (std::uint32_t k = 0; k < kFields; ++k) {
    if (c.bytes[k] > 0) *to[k] = {offset, c.field[k].type};
    offset += c.bytes[k];
  }
  return cloud;
}

// The points that hold no return: counted, and of those with times the first and the last copied all the same.
class LeftOut {
 public:
  explicit LeftOut(const Copier& copier) : copier_(copier), with_time_(copier.bytes[4] > 0) {}

  void note(Point kind, const unsigned char* point) {
    if (kind == Point::kReturn) return;
    ++(kind == Point::kZero ? zero_ : not_finite_);
    const pose_wall_cloud& from = copier_.from;
    if (with_time_) ends_.note(point, read_field(point, from.time, needs_swap(from)));
  }

  unsigned char* copy_ends(unsigned char* to) {
    for (const unsigned char* point : {ends_.first, ends_.last != ends_.first ? ends_.last : nullptr}) {
      if (point == nullptr) continue;
      --(judge(copier_.from, point) == Point::kZero ? zero_ : not_finite_);
      to = copier_.copy(point, to);
    }
    return to;
  }

  std::uint32_t zero() const { return zero_; }
  std::uint32_t not_finite() const { return not_finite_; }

 private:
  const Copier& copier_;
  bool with_time_;
  Ends ends_;
  std::uint32_t zero_ = 0, not_finite_ = 0;
};

}  // namespace

std::uint32_t packed_bytes(const pose_wall_cloud& cloud, bool with_intensity) {
  CopiedFields fields;
  fields.intensity = with_intensity;
  return copier_of(cloud, fields).point_bytes();
}

void copy_frame(const pose_wall_cloud& cloud, const CopiedFields& fields, std::uint32_t thinning, FrameSlot* slot) {
  const Copier copier = copier_of(cloud, fields);
  const bool filter = !fields.intensity || cloud.intensity.type == POSE_WALL_FIELD_NONE;
  EvenChoice choice(thinning);
  LeftOut left_out(copier);
  unsigned char* to = slot->points;
  for (std::uint32_t row = 0; row < rows_of(cloud); ++row) {
    const unsigned char* point = row_of(cloud, row);
    for (std::uint32_t column = 0; column < cloud.width; ++column, point += cloud.point_step) {
      const Point kind = filter ? judge(cloud, point) : Point::kReturn;
      left_out.note(kind, point);
      if (kind == Point::kReturn && choice.takes_next()) to = copier.copy(point, to);
    }
  }
  to = left_out.copy_ends(to);
  slot->left_out_not_finite = left_out.not_finite();
  slot->left_out_zero = left_out.zero();
  slot->cloud = packed(copier, slot->points, static_cast<std::uint64_t>(to - slot->points));
  if (cloud.inputs == nullptr) return;
  slot->inputs = read_struct<pose_wall_inputs>(cloud.inputs, cloud.inputs->struct_size);
  slot->cloud.inputs = &slot->inputs;
}

}  // namespace pose_wall::runtime
