// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/range_image.hpp"

#include <cmath>
#include <cstring>

#include "base/math/golden_ratio.hpp"
#include "base/simd/four_floats.hpp"
#include "lidar/body_boxes.hpp"
#include "lidar/point_reader.hpp"

namespace pose_wall::motion {
namespace {

constexpr std::uint32_t kLooks = 4096;  // points for a cloud's rings, elevations and times
// Fewer are the lines of a pattern without rings: four of a Livox Mid-360, six of an Avia or HAP.
constexpr double kRingsLeast = 8.0;

// Within 1e-3 rad: which column, no more (the odd polynomial of Hastings, Approximations for Digital Computers, 1955).
FourFloats rough_arc_tangent2(FourFloats y, FourFloats x) {
  const FourFloats ax = magnitude_of(x), ay = magnitude_of(y), zero = all_four(0.0F);
  const FourFloats big = larger_of(ax, ay), small = smaller_of(ax, ay);
  const FourFloats q = big > zero ? small / big : zero, s = q * q;
  FourFloats a = ((-0.0464964749F * s + 0.15931422F) * s - 0.327622764F) * s * q + q;
  a = ay > ax ? 1.57079637F - a : a;
  a = x < zero ? 3.14159274F - a : a;
  return y < zero ? -a : a;
}

using Points = const unsigned char* const*;  // four of the cloud

// The other fields of one cloud's points, the common types without a switch a field.
class FieldReader {
 public:
  explicit FieldReader(const pose_wall_cloud& cloud)
      : cloud_(cloud),
        swap_(needs_swap(cloud)),
        plain_ring_(!swap_ && cloud.ring.type == POSE_WALL_FIELD_UINT16),
        plain_time_(!swap_ && cloud.time.type == POSE_WALL_FIELD_UINT32) {}

  FourFloats four_rings(Points points) const {
    FourFloats rings;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (plain_ring_) {
        std::uint16_t value;
        std::memcpy(&value, points[lane] + cloud_.ring.offset, sizeof(value));
        rings[lane] = static_cast<float>(value);
      } else {
        rings[lane] = static_cast<float>(read_field(points[lane], cloud_.ring, swap_));
      }
    }
    return rings;
  }

  FourFloats four_times_s(Points points, double zero, double unit_s) const {
    using FourDoubles = double __attribute__((vector_size(32)));
    FourDoubles numbers;
    if (plain_time_) {
      FourWords words;
      for (std::uint32_t lane = 0; lane < kFour; ++lane) {
        std::uint32_t word;
        std::memcpy(&word, points[lane] + cloud_.time.offset, sizeof(word));
        words[lane] = word;
      }
      numbers = __builtin_convertvector(words, FourDoubles);
    } else {
      for (std::uint32_t lane = 0; lane < kFour; ++lane) numbers[lane] = number(points[lane], cloud_.time);
    }
    return __builtin_convertvector((numbers - zero) * unit_s, FourFloats);
  }

  double number(const unsigned char* point, const pose_wall_field& field) const {
    return read_number(point, field, swap_);
  }

 private:
  const pose_wall_cloud& cloud_;
  bool swap_, plain_ring_, plain_time_;
};

// How this cloud's points go into rows, and its times into seconds.
struct Layout {
  bool has_ring, has_time;
  double rings = 1.0;
  float sine_least = 1.0F, row_scale = 0.0F;  // of elevation
  double time_zero = 0.0, time_unit_s = 0.0;
  std::uint32_t rows = kImageRowsMost, columns = kImageColumnsMost;
  std::uint32_t share = 0xFFFFFFFFU;  // of the points that are looked at, of 2^32
};

// The ranges of rings, elevations and times, from an even share of a cloud's points.
struct Extent {
  double ring_most = 0.0, time_least = 1e300, time_most = -1e300;
  float sine_least = 1.0F, sine_most = -1.0F;
};

Extent extent_of(const pose_wall_cloud& cloud, const FieldReader& fields, std::uint64_t points) {
  const PointReader reader(cloud);
  const bool has_ring = cloud.ring.type != POSE_WALL_FIELD_NONE, has_time = cloud.time.type != POSE_WALL_FIELD_NONE;
  Extent extent;
  const std::uint64_t stride = (points / kLooks) | 1U;  // odd, so that no ring of an even number is passed over
  for (std::uint64_t i = 0; i < points; i += stride) {
    const unsigned char* const point =
        row_of(cloud, static_cast<std::uint32_t>(i / cloud.width)) + (i % cloud.width) * cloud.point_step;
    float x, y, z;
    reader.one(point, &x, &y, &z);
    const float r2 = x * x + y * y + z * z;
    if (!(r2 > 0.01F && r2 < 1e6F)) continue;
    const float s = z / std::sqrt(r2);
    if (s < extent.sine_least) extent.sine_least = s;
    if (s > extent.sine_most) extent.sine_most = s;
    const double ring = has_ring ? fields.number(point, cloud.ring) : 0.0;
    if (ring > extent.ring_most && ring < 4096.0) extent.ring_most = ring;
    const double t = has_time ? fields.number(point, cloud.time) : 0.0;
    if (t < extent.time_least) extent.time_least = t;
    if (t > extent.time_most) extent.time_most = t;
  }
  return extent;
}

Layout look_at(const pose_wall_cloud& cloud, const FieldReader& fields) {
  const std::uint64_t points = static_cast<std::uint64_t>(cloud.width) * rows_of(cloud);
  const Extent extent = extent_of(cloud, fields, points);
  Layout layout;
  layout.time_unit_s = time_unit_s(extent.time_most - extent.time_least);
  layout.time_zero = time_of_stamp(extent.time_least, extent.time_most, layout.time_unit_s);
  layout.has_time = cloud.time.type != POSE_WALL_FIELD_NONE && layout.time_unit_s > 0.0;
  layout.rings = extent.ring_most + 1.0;
  layout.has_ring = cloud.ring.type != POSE_WALL_FIELD_NONE && layout.rings >= kRingsLeast;
  if (layout.has_ring && layout.rings < kImageRowsMost) layout.rows = static_cast<std::uint32_t>(layout.rings);
  // A little fewer than points of a row: where columns stay empty, neighbours are none.
  const double directions = 0.9 * static_cast<double>(points) / layout.rows;
  const double room_for = static_cast<double>(kImageCells / layout.rows);
  const double columns = directions < room_for ? directions : room_for;
  layout.columns = columns < kImageColumnsMost ? static_cast<std::uint32_t>(columns) : kImageColumnsMost;
  if (layout.columns < kImageColumnsLeast) layout.columns = kImageColumnsLeast;
  const double room = 1.15 * layout.rows * layout.columns;
  if (static_cast<double>(points) > room) {
    layout.share = static_cast<std::uint32_t>(4294967295.0 * (room / static_cast<double>(points)));
  }
  layout.sine_least = extent.sine_least;
  const float spread = extent.sine_most - extent.sine_least;
  layout.row_scale = spread > 0.0F ? static_cast<float>(layout.rows) * 0.9999F / spread : 0.0F;
  return layout;
}

}  // namespace

void RangeImage::lay_out(Arena& arena) {
  x = arena.take<float>(kImageCells);
  y = arena.take<float>(kImageCells);
  z = arena.take<float>(kImageCells);
  range = arena.take<float>(kImageCells);
  place = arena.take<std::uint16_t>(kImageCells);
  flags = arena.take<std::uint8_t>(kImageCells);
  cell = arena.take<std::uint16_t>(kImageCells);
}

namespace {

// Which cells points belong to, and where they lie in base.
class Projector {
 public:
  Projector(const pose_wall_cloud& cloud, const Mount& mount, const Twist& twist, RangeImage* image, CloudPrint* print)
      : reader_(cloud),
        fields_(cloud),
        layout_(look_at(cloud, fields_)),
        R_(mount.R_base_lidar.cast<float>()),
        origin_(mount.sensor_base_m.cast<float>()),
        velocity_(twist.velocity_m_s.cast<float>()),
        turn_(twist.turn_rad_s.cast<float>()),
        near2_(static_cast<float>(mount.range_min_m * mount.range_min_m)),
        far2_(static_cast<float>(mount.range_max_m * mount.range_max_m)),
        body_(mount.body, cloud),
        image_(image),
        print_(print) {}

  const Layout& layout() const { return layout_; }

  // Those of four. The first point of a cell stays. No-returns, points out of range and the machine's own body are
  // dropped.
  void put(Points points, FourTruths those) const {
    const FourPlaces raw = reader_.four(points);
    const FourFloats r2 = range2_of(raw), range = root_of(r2), turn = turn_of(raw);
    those &= is_in_range(r2);
    if (print_ != nullptr) print_->add_four(sectors_of(turn), words_of(raw), those);
    FourInts cells;
    those &= cells_of(points, raw, range, turn, &cells);
    const FourPlaces p = base_of(points, raw);
    if (!body_.empty()) those &= ~body_.hold(p);
    const RangeImage to = *image_;  // a copy, so that no store can seem to change where its rows are
    std::uint32_t k = to.count;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const std::uint32_t place = static_cast<std::uint32_t>(cells[lane]);
      if (those[lane] == 0 || to.cell[place] != kNoPoint) continue;
      to.cell[place] = static_cast<std::uint16_t>(k);
      to.x[k] = p.x[lane], to.y[k] = p.y[lane], to.z[k] = p.z[lane], to.range[k] = range[lane];
      to.place[k] = static_cast<std::uint16_t>(place);
      ++k;
    }
    image_->count = k;
  }

  // Those of four that the image has no room for: which ones these are depends on the order of the cloud, and a print
  // must not.
  void print(Points points, FourTruths those) const {
    const FourPlaces raw = reader_.four(points);
    print_->add_four(sectors_of(turn_of(raw)), words_of(raw), those & is_in_range(range2_of(raw)));
  }
  bool prints() const { return print_ != nullptr; }

 private:
  static FourFloats range2_of(const FourPlaces& raw) { return raw.x * raw.x + raw.y * raw.y + raw.z * raw.z; }
  FourTruths is_in_range(FourFloats r2) const { return (r2 >= near2_) & (r2 <= far2_); }
  static FourFloats turn_of(const FourPlaces& raw) {  // of one turn
    return rough_arc_tangent2(raw.y, raw.x) * (1.0F / kTurn_rad) + 0.5F;
  }

  static FourInts sectors_of(FourFloats turn) {
    return cut_off(turn * CloudPrint::kSectors) & static_cast<std::int32_t>(CloudPrint::kSectors - 1);
  }

  FourTruths cells_of(Points points, const FourPlaces& raw, FourFloats range, FourFloats turn, FourInts* cells) const {
    FourTruths those = all_four_ints(-1);
    FourFloats row;
    if (layout_.has_ring) {
      const FourFloats ring = fields_.four_rings(points);
      those = (ring >= 0.0F) & (ring < static_cast<float>(layout_.rings));
      row = ring * static_cast<float>(static_cast<double>(layout_.rows) / layout_.rings);
    } else {
      row = (raw.z / range - layout_.sine_least) * layout_.row_scale;
    }
    const FourFloats zero = all_four(0.0F), top = all_four(static_cast<float>(layout_.rows) - 0.5F);
    row = row > zero ? smaller_of(row, top) : zero;
    const FourFloats columns = all_four(static_cast<float>(layout_.columns));
    FourFloats column = turn * columns;
    column = column >= zero ? column : zero;
    column = column < columns ? column : zero;  // once round
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      (*cells)[lane] = static_cast<std::int32_t>(row[lane]) * static_cast<std::int32_t>(layout_.columns) +
                       static_cast<std::int32_t>(column[lane]);
    }
    return those;
  }

  // At the stamp, to second order of the turn.
  FourPlaces base_of(Points points, const FourPlaces& raw) const {
    FourPlaces p = {R_(0, 0) * raw.x + R_(0, 1) * raw.y + R_(0, 2) * raw.z + origin_[0],
                    R_(1, 0) * raw.x + R_(1, 1) * raw.y + R_(1, 2) * raw.z + origin_[1],
                    R_(2, 0) * raw.x + R_(2, 1) * raw.y + R_(2, 2) * raw.z + origin_[2]};
    if (!layout_.has_time) return p;
    const FourFloats time = fields_.four_times_s(points, layout_.time_zero, layout_.time_unit_s);
    const FourTruths is_time = (time > -0.1F) & (time <= 1.0F);
    const FourFloats t = is_time ? time : all_four(0.0F), half = 0.5F * t * t;
    const FourPlaces around = turned(p), twice = turned(around);
    p.x += t * (around.x + velocity_[0]) + half * twice.x;
    p.y += t * (around.y + velocity_[1]) + half * twice.y;
    p.z += t * (around.z + velocity_[2]) + half * twice.z;
    return p;
  }
  FourPlaces turned(const FourPlaces& p) const {
    return {turn_[1] * p.z - turn_[2] * p.y, turn_[2] * p.x - turn_[0] * p.z, turn_[0] * p.y - turn_[1] * p.x};
  }

  PointReader reader_;
  FieldReader fields_;
  Layout layout_;
  Eigen::Matrix3f R_;
  Eigen::Vector3f origin_, velocity_, turn_;
  float near2_, far2_;
  BodyBoxes body_;
  RangeImage* image_;
  CloudPrint* print_;  // or NULL
};

// Points on their way, four at a time.
class Gathered {
 public:
  template <typename Take>
  void add(const unsigned char* point, const Take& take) {
    points_[count_] = point;
    if (++count_ < kFour) return;
    take(points_, first_of_four(kFour));
    count_ = 0;
  }
  template <typename Take>
  void end(const Take& take) {
    if (count_ == 0) return;
    for (std::uint32_t lane = count_; lane < kFour; ++lane) points_[lane] = points_[0];
    take(points_, first_of_four(count_));
    count_ = 0;
  }

 private:
  const unsigned char* points_[kFour];
  std::uint32_t count_ = 0;
};

void project_some(const pose_wall_cloud& cloud, const Projector& projector, RangeImage* image) {
  image->rows = projector.layout().rows;
  image->columns = projector.layout().columns;
  image->count = 0;
  image->cell.first(image->rows * image->columns).fill(kNoPoint);
  // More points than cells: a share of them, spread by the golden ratio over rings and directions alike.
  const std::uint32_t rows_in = rows_of(cloud), share = projector.layout().share;
  std::uint32_t lot = 0;
  const auto put = [&](Points points, FourTruths those) { projector.put(points, those); };
  const auto print = [&](Points points, FourTruths those) { projector.print(points, those); };
  Gathered chosen, others;
  for (std::uint32_t row_in = 0; row_in < rows_in; ++row_in) {
    const unsigned char* point = row_of(cloud, row_in);
    for (std::uint32_t i = 0; i < cloud.width; ++i, point += cloud.point_step) {
      lot += kGoldenTurn32;
      if (lot <= share) {
        chosen.add(point, put);
      } else if (projector.prints()) {
        others.add(point, print);
      }
    }
  }
  chosen.end(put);
  others.end(print);
}

}  // namespace

void project(const pose_wall_cloud& cloud, const Mount& mount, const Twist& twist, RangeImage* image,
             CloudPrint* print) {
  print->clear();
  image->flags.fill(0);
  project_some(cloud, Projector(cloud, mount, twist, image, print), image);
}

void project_again(const pose_wall_cloud& cloud, const Mount& mount, const Twist& twist, RangeImage* image) {
  project_some(cloud, Projector(cloud, mount, twist, image, nullptr), image);
}

}  // namespace pose_wall::motion
