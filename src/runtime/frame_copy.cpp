// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frame_copy.hpp"

#include <cstring>
#include <initializer_list>

#include "overload.hpp"
#include "part/struct_sizes.hpp"

namespace pose_wall::runtime {
namespace {

enum class Point { kReturn, kNotFinite, kZero };

std::uint32_t bytes_of(std::uint32_t type) {
  switch (type) {
    case POSE_WALL_FIELD_INT8:
    case POSE_WALL_FIELD_UINT8:
      return 1;
    case POSE_WALL_FIELD_INT16:
    case POSE_WALL_FIELD_UINT16:
      return 2;
    case POSE_WALL_FIELD_INT32:
    case POSE_WALL_FIELD_UINT32:
    case POSE_WALL_FIELD_FLOAT32:
      return 4;
    case POSE_WALL_FIELD_FLOAT64:
      return 8;
    default:
      return 0;
  }
}

// The number's bits, most significant first in the word, whatever the byte order of the cloud.
std::uint64_t bits_of(const unsigned char* bytes, std::uint32_t count, bool big_endian) {
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < count; ++i) bits = bits << 8 | bytes[big_endian ? i : count - 1 - i];
  return bits;
}

struct Coordinate {
  bool finite;
  bool zero;
};

// By the bits. The engine reads doubles as floats: below half the smallest float they are zero, and the tie with it is
// rounded to zero as well.
Coordinate read(const unsigned char* bytes, std::uint32_t type, bool big_endian) {
  if (type == POSE_WALL_FIELD_FLOAT32) {
    const std::uint64_t bits = bits_of(bytes, 4, big_endian) & 0x7FFFFFFFU;
    return {bits < 0x7F800000U, bits == 0};
  }
  const std::uint64_t bits = bits_of(bytes, 8, big_endian) & 0x7FFFFFFFFFFFFFFFULL;
  constexpr std::uint64_t kHalfTheSmallestFloat = 0x3690000000000000ULL;
  return {bits < 0x7FF0000000000000ULL, bits <= kHalfTheSmallestFloat};
}

Point judge(const pose_wall_cloud& cloud, const unsigned char* point) {
  const bool big = cloud.big_endian != 0;
  const Coordinate x = read(point + cloud.x.offset, cloud.x.type, big);
  const Coordinate y = read(point + cloud.y.offset, cloud.y.type, big);
  const Coordinate z = read(point + cloud.z.offset, cloud.z.type, big);
  if (!(x.finite && y.finite && z.finite)) return Point::kNotFinite;
  return x.zero && y.zero && z.zero ? Point::kZero : Point::kReturn;
}

constexpr std::uint32_t kFields = 6;  // x, y, z, intensity, time, ring

// The field's value, of any type.
double number(const unsigned char* bytes, std::uint32_t type, bool big_endian) {
  const std::uint64_t bits = bits_of(bytes, bytes_of(type), big_endian);
  const auto low = static_cast<std::uint32_t>(bits);
  float single;
  double whole;
  switch (type) {
    case POSE_WALL_FIELD_INT8:
      return static_cast<double>(static_cast<std::int8_t>(low));
    case POSE_WALL_FIELD_INT16:
      return static_cast<double>(static_cast<std::int16_t>(low));
    case POSE_WALL_FIELD_INT32:
      return static_cast<double>(static_cast<std::int32_t>(low));
    case POSE_WALL_FIELD_FLOAT32:
      std::memcpy(&single, &low, sizeof(single));
      return static_cast<double>(single);
    case POSE_WALL_FIELD_FLOAT64:
      std::memcpy(&whole, &bits, sizeof(whole));
      return whole;
    default:
      return static_cast<double>(low);
  }
}

// Of the points that hold no return, those that were measured first and last: times count from the cloud's first to its
// last point, whether they hold a return or not. NaN is neither.
struct Ends {
  const unsigned char* first = nullptr;
  const unsigned char* last = nullptr;
  double first_time = 0.0, last_time = 0.0;

  void note(const unsigned char* point, double time) {
    constexpr double kMost = 1.7976931348623157e308;  // infinite times are none either
    if (!(time >= -kMost && time <= kMost)) return;
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
    const std::uint32_t bytes = bytes_of(c.field[k].type);
    const bool is_extra = k >= 4;
    if (wanted[k] && (!is_extra || c.point_bytes() + bytes <= fields.point_bytes_max)) c.bytes[k] = bytes;
  }
  return c;
}

pose_wall_cloud packed(const Copier& c, const unsigned char* data, std::uint64_t bytes) {
  const std::uint32_t point_bytes = c.point_bytes();
  pose_wall_cloud cloud{};
  cloud.struct_size = sizeof(cloud);
  cloud.big_endian = c.from.big_endian;
  cloud.data = data;
  cloud.data_bytes = bytes;
  cloud.point_step = point_bytes;
  cloud.width = static_cast<std::uint32_t>(bytes / point_bytes);
  cloud.height = 1;
  cloud.stamp_ns = c.from.stamp_ns;
  pose_wall_field* const to[kFields] = {&cloud.x, &cloud.y, &cloud.z, &cloud.intensity, &cloud.time, &cloud.ring};
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
    if (with_time_) ends_.note(point, number(point + from.time.offset, from.time.type, from.big_endian != 0));
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
  const std::uint64_t row_step =
      cloud.row_step != 0 ? cloud.row_step : static_cast<std::uint64_t>(cloud.width) * cloud.point_step;
  const std::uint32_t rows = cloud.width > 0 ? cloud.height : 0;  // empty rows may be any number
  EvenChoice choice(thinning);
  LeftOut left_out(copier);
  unsigned char* to = slot->points;
  for (std::uint32_t row = 0; row < rows; ++row) {
    const unsigned char* point = static_cast<const unsigned char*>(cloud.data) + row * row_step;
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
