// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/range_image.hpp"

#include <cmath>
#include <cstring>

#include "stages/voxel_cloud_reader.hpp"

namespace pose_wall::motion {
namespace {

constexpr std::uint32_t kLooks = 4096;  // points that tell a cloud's rings, elevations and times
constexpr double kRingsLeast = 4.0;     // fewer: a driver of a pattern without rings that fills in the field
constexpr float kTurn_rad = 6.2831853F;

// Within 1e-3 rad: which column, no more (the odd polynomial of Hastings, Approximations for Digital Computers, 1955).
float rough_arc_tangent2(float y, float x) {
  const float ax = std::fabs(x), ay = std::fabs(y);
  const float big = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
  const float q = big > 0.0F ? small / big : 0.0F, s = q * q;
  float a = ((-0.0464964749F * s + 0.15931422F) * s - 0.327622764F) * s * q + q;
  if (ay > ax) a = 1.57079637F - a;
  if (x < 0.0F) a = 3.14159274F - a;
  return y < 0.0F ? -a : a;
}

// A scan takes 0.01 to 1 s: the unit of its times by how far they spread; 0 where no unit makes a scan of them.
double time_unit_s(double spread) {
  for (const double unit_s : {1.0, 1e-3, 1e-6, 1e-9}) {
    const double scan_s = spread * unit_s;
    if (scan_s >= 0.01 && scan_s <= 1.0) return unit_s;
  }
  return 0.0;
}

struct Raw {
  float x, y, z;
};

// Reads points of one cloud, the common layouts without a switch a field.
class Reader {
 public:
  explicit Reader(const pose_wall_cloud& cloud)
      : cloud_(cloud), swap_(needs_swap(cloud)), plain_(is_plain_xyz32(cloud)) {}

  Raw xyz(const unsigned char* point) const {
    Raw p;
    if (plain_) {
      std::memcpy(&p.x, point + cloud_.x.offset, sizeof(float));
      std::memcpy(&p.y, point + cloud_.y.offset, sizeof(float));
      std::memcpy(&p.z, point + cloud_.z.offset, sizeof(float));
      return p;
    }
    return {static_cast<float>(read_field(point, cloud_.x, swap_)),
            static_cast<float>(read_field(point, cloud_.y, swap_)),
            static_cast<float>(read_field(point, cloud_.z, swap_))};
  }

  float ring(const unsigned char* point) const {
    if (!swap_ && cloud_.ring.type == POSE_WALL_FIELD_UINT16) {
      std::uint16_t value;
      std::memcpy(&value, point + cloud_.ring.offset, sizeof(value));
      return static_cast<float>(value);
    }
    return static_cast<float>(read_field(point, cloud_.ring, swap_));
  }

  double number(const unsigned char* point, const pose_wall_field& field) const {
    if (!swap_ && field.type == POSE_WALL_FIELD_UINT32) {
      std::uint32_t value;
      std::memcpy(&value, point + field.offset, sizeof(value));
      return static_cast<double>(value);
    }
    return read_field(point, field, swap_);
  }

 private:
  const pose_wall_cloud& cloud_;
  bool swap_, plain_;
};

// How this cloud's points go into rows, and its times into seconds.
struct Layout {
  bool has_ring, has_time;
  double rings = 1.0;
  float sine_least = 1.0F, row_scale = 0.0F;  // of elevation
  double time_least = 0.0, time_unit_s = 0.0;
  std::uint32_t rows = kImageRowsMost, columns = kImageColumnsMost;
  std::uint32_t share = 0xFFFFFFFFU;  // of the points that are looked at, of 2^32
};

// What an even share of a cloud's points tells: how far rings, elevations and times reach.
struct Extent {
  double ring_most = 0.0, time_least = 1e300, time_most = -1e300;
  float sine_least = 1.0F, sine_most = -1.0F;
};

Extent extent_of(const pose_wall_cloud& cloud, const Reader& reader, std::uint64_t points) {
  const bool has_ring = cloud.ring.type != POSE_WALL_FIELD_NONE, has_time = cloud.time.type != POSE_WALL_FIELD_NONE;
  Extent extent;
  const std::uint64_t stride = (points / kLooks) | 1U;  // odd, so that no ring of an even number is passed over
  for (std::uint64_t i = 0; i < points; i += stride) {
    const unsigned char* const point =
        row_of(cloud, static_cast<std::uint32_t>(i / cloud.width)) + (i % cloud.width) * cloud.point_step;
    const Raw p = reader.xyz(point);
    const float r2 = p.x * p.x + p.y * p.y + p.z * p.z;
    if (!(r2 > 0.01F && r2 < 1e6F)) continue;
    const float s = p.z / std::sqrt(r2);
    if (s < extent.sine_least) extent.sine_least = s;
    if (s > extent.sine_most) extent.sine_most = s;
    const double ring = has_ring ? reader.number(point, cloud.ring) : 0.0;
    if (ring > extent.ring_most && ring < 4096.0) extent.ring_most = ring;
    const double t = has_time ? reader.number(point, cloud.time) : 0.0;
    if (t < extent.time_least) extent.time_least = t;
    if (t > extent.time_most) extent.time_most = t;
  }
  return extent;
}

Layout look_at(const pose_wall_cloud& cloud, const Reader& reader) {
  const std::uint64_t points = static_cast<std::uint64_t>(cloud.width) * rows_of(cloud);
  const Extent extent = extent_of(cloud, reader, points);
  Layout layout;
  layout.time_least = extent.time_least;
  layout.time_unit_s = time_unit_s(extent.time_most - extent.time_least);
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

bool is_of_body(const Reading& reading, const Eigen::Vector3f& p) {
  for (const Box& box : reading.body) {
    if (box.holds_something() && box.contains(p.x(), p.y(), p.z())) return true;
  }
  return false;
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

// Which cell a point belongs to, and where it lies in base.
class Projector {
 public:
  Projector(const pose_wall_cloud& cloud, const Reading& reading, const Twist& twist)
      : reader_(cloud),
        layout_(look_at(cloud, reader_)),
        cloud_(cloud),
        reading_(reading),
        R_(reading.R_base_lidar.cast<float>()),
        origin_(reading.lidar_base_m.cast<float>()),
        velocity_(twist.velocity_m_s.cast<float>()),
        turn_(twist.turn_rad_s.cast<float>()),
        near2_(static_cast<float>(reading.range_min_m * reading.range_min_m)),
        far2_(static_cast<float>(reading.range_max_m * reading.range_max_m)) {
    for (const Box& box : reading.body) has_body_ = has_body_ || box.holds_something();
  }

  const Layout& layout() const { return layout_; }
  Raw read(const unsigned char* point) const { return reader_.xyz(point); }

  // False for a point that is no return, or out of range.
  bool cell_of(const unsigned char* point, const Raw& raw, float* range, std::uint32_t* place) const {
    const float r2 = raw.x * raw.x + raw.y * raw.y + raw.z * raw.z;
    if (!(r2 >= near2_ && r2 <= far2_)) return false;
    *range = std::sqrt(r2);
    float row;
    if (layout_.has_ring) {
      const float ring = reader_.ring(point);
      if (!(ring >= 0.0F && ring < static_cast<float>(layout_.rings))) return false;
      row = ring * static_cast<float>(static_cast<double>(layout_.rows) / layout_.rings);
    } else {
      row = (raw.z / *range - layout_.sine_least) * layout_.row_scale;
    }
    const float top = static_cast<float>(layout_.rows) - 0.5F;
    row = row > 0.0F ? (row < top ? row : top) : 0.0F;
    const float column = (rough_arc_tangent2(raw.y, raw.x) / kTurn_rad + 0.5F) * static_cast<float>(layout_.columns);
    const std::uint32_t turned = static_cast<std::uint32_t>(static_cast<std::int32_t>(column));
    *place = static_cast<std::uint32_t>(static_cast<std::int32_t>(row)) * layout_.columns +
             (turned < layout_.columns ? turned : 0);
    return true;
  }

  // At the stamp, to second order of the turn. False for a point of the machine's own body.
  bool base_of(const unsigned char* point, const Raw& raw, Eigen::Vector3f* p) const {
    *p = R_ * Eigen::Vector3f(raw.x, raw.y, raw.z) + origin_;
    if (layout_.has_time) {
      const float t =
          static_cast<float>((reader_.number(point, cloud_.time) - layout_.time_least) * layout_.time_unit_s);
      if (t > -0.1F && t <= 1.0F) {
        const Eigen::Vector3f around = turn_.cross(*p);
        *p += t * (velocity_ + around) + (0.5F * t * t) * turn_.cross(around);
      }
    }
    return !has_body_ || !is_of_body(reading_, *p);
  }

 private:
  Reader reader_;
  Layout layout_;
  const pose_wall_cloud& cloud_;
  const Reading& reading_;
  Eigen::Matrix3f R_;
  Eigen::Vector3f origin_, velocity_, turn_;
  float near2_, far2_;
  bool has_body_ = false;
};

}  // namespace

void project(const pose_wall_cloud& cloud, const Reading& reading, const Twist& twist, RangeImage* image) {
  const Projector projector(cloud, reading, twist);
  image->rows = projector.layout().rows;
  image->columns = projector.layout().columns;
  image->count = 0;
  image->cell.first(image->rows * image->columns).fill(kNoPoint);
  // More points than cells: a share of them, spread by the golden ratio over rings and directions alike.
  constexpr std::uint32_t kGolden = 0x9E3779B9U;
  std::uint32_t lot = 0;
  const std::uint32_t rows_in = rows_of(cloud);
  for (std::uint32_t row_in = 0; row_in < rows_in; ++row_in) {
    const unsigned char* point = row_of(cloud, row_in);
    for (std::uint32_t i = 0; i < cloud.width; ++i, point += cloud.point_step) {
      lot += kGolden;
      if (lot > projector.layout().share) continue;
      const Raw raw = projector.read(point);
      float range;
      std::uint32_t place;
      Eigen::Vector3f p;
      if (!projector.cell_of(point, raw, &range, &place) || image->cell[place] != kNoPoint) continue;
      if (!projector.base_of(point, raw, &p)) continue;
      const std::uint32_t k = image->count++;
      image->cell[place] = static_cast<std::uint16_t>(k);
      image->x[k] = p.x(), image->y[k] = p.y(), image->z[k] = p.z(), image->range[k] = range;
      image->place[k] = static_cast<std::uint16_t>(place);
      image->flags[k] = 0;
    }
  }
}

}  // namespace pose_wall::motion
