// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/features.hpp"

#include <cmath>

#include "base/simd/four_floats.hpp"

namespace pose_wall::motion {
namespace {

constexpr std::int32_t kAround = 5;  // neighbours on each side (Zhang and Singh, LOAM, RSS 2014)
// More is an edge, less a plane. Steel sets stretched the way by 0.25 % with LeGO-LOAM's 0.1, by 0.16 % with this.
constexpr float kEdgeCurvature = 0.03F;
constexpr float kOcclusion_m = 0.1F;    // neighbours that differ by more: one of them stands before the other
constexpr float kBaseline_m = 0.25F;    // to each side, for normals: half of the rock's usual roughness length
constexpr std::uint32_t kCubes = 8192;  // hashed cubic metres
constexpr std::uint8_t kPerCube = 24;   // with 14, and fewer rows of the curve, a Mid-360 on the move found no start
// Of ground and roof, half of all: in a hall they are nine points of ten, and what the walls there tell of the way
// counts little beside them (normal-space sampling: Rusinkiewicz and Levoy 2001).
constexpr std::uint32_t kLevelMost = kObservationsMost / 2;
// Directions, for a neighbour on the same surface. With 1 the sweep measured 103 frames and not 348, and lost 40; with
// 10 it measured 346.
constexpr std::int32_t kTries = 4;

// The ranges of one row, in the order of directions, 0 where no point was kept; its ends go round.
struct RowOfRanges {
  float range[kImageColumnsMost + 2 * kAround + kFour] = {};
  std::uint32_t columns;

  void read(const RangeImage& image, std::uint32_t row) {
    columns = image.columns;
    const Span<std::uint16_t> cell(image.cell.data() + row * columns, columns);
    for (std::uint32_t k = 0; k < columns; ++k) {
      const bool kept = cell[k] != kNoPoint && (image.flags[cell[k]] & kKept) != 0;
      range[k + kAround] = kept ? image.range[cell[k]] : 0.0F;
    }
    for (std::int32_t k = 0; k < kAround; ++k) {
      range[k] = range[static_cast<std::int32_t>(columns) + k];
      range[static_cast<std::int32_t>(columns) + kAround + k] = range[kAround + k];
    }
  }
};

// The row's test of four points side by side, from the column on.
struct FourColumns {
  explicit FourColumns(const float* at) {
    const FourFloats r = load_four(at), zero = all_four(0.0F), least = 0.9F * r - kOcclusion_m;
    FourFloats sum = zero;
    FourInts found = all_four_ints(0);
    FourTruths hidden = all_four_ints(0);
    for (std::int32_t k = -kAround; k <= kAround; ++k) {
      const FourFloats near = load_four(at + k);
      sum += near;
      found -= near > zero;
      // Points that the nearest neighbours hide: the far side of an edge moves with the sensor.
      if (k >= -2 && k <= 2) hidden |= (near > zero) & (near < least);
    }
    told = (r > zero) & (found > kAround) & ~hidden;
    // |sum of (r_j - r_i)| / (n r_i), the document's smoothness.
    const FourFloats n = __builtin_convertvector(found, FourFloats);
    flat = magnitude_of(sum - n * r) < kEdgeCurvature * n * r;
  }

  FourTruths told, flat;
};

// The first point in a direction that lies on the same surface; else the point itself.
std::uint32_t neighbour(const RangeImage& image, std::uint32_t self, std::int32_t row, std::int32_t column,
                        std::int32_t row_step, std::int32_t column_step) {
  const float range = image.range[self];
  for (std::int32_t k = 0; k < kTries; ++k, row += row_step, column += column_step) {
    const std::uint16_t j = image.at(row, column);
    if (j != kNoPoint && std::fabs(image.range[j] - range) < 0.3F + 0.3F * range) return j;
  }
  return self;
}

std::uint32_t cube_of(const Eigen::Vector3f& p) {
  // cut off towards zero is down where all is positive
  const auto whole = [](float v) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(v)); };
  const std::uint32_t key = whole(p.x()) * 0x9E3779B1U ^ whole(p.y()) * 0x85EBCA77U ^ whole(p.z()) * 0xC2B2AE3DU;
  return ((key * 0x27D4EB2FU) >> 16) & (kCubes - 1);
}

std::uint32_t common_divisor(std::uint32_t a, std::uint32_t b) {
  while (b != 0) {
    const std::uint32_t rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

}  // namespace

FeatureCounts mark_features(RangeImage* image) {
  FeatureCounts counts;
  RowOfRanges line;
  for (std::uint32_t row = 0; row < image->rows; ++row) {
    line.read(*image, row);
    const std::uint16_t* const cell = image->cell.data() + row * image->columns;
    for (std::uint32_t column = 0; column < image->columns; column += kFour) {
      const FourColumns four(line.range + column + kAround);
      if (!any_of(four.told)) continue;
      for (std::uint32_t lane = 0; lane < kFour && column + lane < image->columns; ++lane) {
        if (four.told[lane] == 0) continue;
        const bool flat = four.flat[lane] != 0;
        image->flags[cell[column + lane]] |= flat ? kPlane : kEdge;
        ++(flat ? counts.planes : counts.edges);
      }
    }
  }
  return counts;
}

bool normal_about(const RangeImage& image, std::uint32_t i, Eigen::Vector3f* normal) {
  const std::int32_t row = image.row_of(i), column = image.column_of(i);
  const float r = image.range[i];
  const float spacing_m = r * (kTurn_rad / static_cast<float>(image.columns));
  std::int32_t far = static_cast<std::int32_t>(kBaseline_m / spacing_m + 0.5F);
  far = far < 1 ? 1 : far > 16 ? 16 : far;
  const std::uint32_t right = neighbour(image, i, row, column + far, 0, 1);
  const std::uint32_t left = neighbour(image, i, row, column - far, 0, -1);
  const std::int32_t up_by = image.rows > 40 ? (r < 3.0F ? 4 : 2) : 1;
  const std::uint32_t above = neighbour(image, i, row + up_by, column, 1, 0);
  const std::uint32_t below = neighbour(image, i, row - up_by, column, -1, 0);
  if (right == left || above == below) return false;
  const Eigen::Vector3f p = image.point(i);
  Eigen::Vector3f n = (image.point(right) - image.point(left)).cross(image.point(above) - image.point(below));
  const float length2 = n.squaredNorm();
  if (!(length2 > 1e-12F)) return false;
  n /= std::sqrt(length2);
  *normal = n.dot(p) > 0.0F ? Eigen::Vector3f(-n) : n;
  return true;
}

bool facing_of(const Eigen::Vector3f& n, std::uint8_t* facing) {
  const float ax = std::fabs(n.x()), ay = std::fabs(n.y()), az = std::fabs(n.z());
  const float most = ax > ay ? (ax > az ? ax : az) : (ay > az ? ay : az);
  if (!(most > kFaces)) return false;
  *facing = most == az ? kFacesZ : most == ay ? kFacesY : kFacesX;
  return true;
}

bool FacingWalk::go_to(std::uint32_t point) {
  constexpr float kHolds_m = 0.5F * kBaseline_m;  // so far off, half of a normal's neighbours are the same
  const Eigen::Vector3f p = image_.point(point);
  if (has_begun_ && (p - at_).squaredNorm() < kHolds_m * kHolds_m) return faces_;
  has_begun_ = true;
  at_ = p;
  faces_ = normal_about(image_, point, &normal_) && facing_of(R_ * normal_, &facing_);
  return faces_;
}

void ObservationScratch::lay_out(Arena& arena) {
  taken = arena.take<std::uint8_t>(kCubes);
}

namespace {

// Those on walls from the front; ground and roof beyond their half from the back, while there is room.
class Chosen {
 public:
  explicit Chosen(Span<Observation> room) : room_(room) {}

  bool is_full() const { return count_ == room_.size(); }
  // False where it is one too many of its kind.
  bool add(const Observation& o) {
    const bool beyond = o.facing == kFacesZ && level_ >= kLevelMost, no_room = count_ + spare_ == room_.size();
    if (beyond && no_room) return false;
    if (no_room) --spare_;
    room_[beyond ? room_.size() - ++spare_ : count_++] = o;
    level_ += o.facing == kFacesZ && !beyond ? 1U : 0U;
    return true;
  }
  // One behind the other; how many.
  std::uint32_t close_up() {
    for (std::uint32_t k = room_.size() - spare_; k < room_.size(); ++k) room_[count_++] = room_[k];
    return count_;
  }

 private:
  Span<Observation> room_;
  std::uint32_t count_ = 0, spare_ = 0, level_ = 0;
};

}  // namespace

std::uint32_t choose_observations(const RangeImage& image, const Pose& expected, ObservationScratch* scratch,
                                  Span<Observation> out) {
  scratch->taken.fill(0);
  const Eigen::Matrix3f R = expected.R.cast<float>();
  constexpr float kAway_m = 128.0F;  // no point is so far off
  const Eigen::Vector3f t = (expected.t - expected.t.array().floor().matrix()).cast<float>().array() + kAway_m;
  Chosen chosen(out);
  // In steps of the golden ratio, so that full cubes leave out points evenly.
  std::uint32_t step = static_cast<std::uint32_t>(0.618034 * image.count) | 1U;
  while (common_divisor(image.count, step) != 1) step += 2;
  std::uint32_t i = 0;
  for (std::uint32_t k = 0; k < image.count && !chosen.is_full(); ++k) {
    i += step;
    if (i >= image.count) i -= image.count;
    if ((image.flags[i] & kPlane) == 0) continue;
    const Eigen::Vector3f p = image.point(i);
    std::uint8_t& taken = scratch->taken[cube_of(R * p + t)];
    Eigen::Vector3f normal;
    std::uint8_t facing;
    if (taken >= kPerCube || !normal_about(image, i, &normal) || !facing_of(R * normal, &facing)) continue;
    if (chosen.add({p.x(),
                    p.y(),
                    p.z(),
                    {normal.x(), normal.y(), normal.z()},
                    facing,
                    static_cast<std::uint8_t>(facing == kFacesZ ? image.flags[i] & kGround : 0)})) {
      ++taken;
    }
  }
  return chosen.close_up();
}

void face(const Eigen::Matrix3d& R_map_base, Span<Observation> observations) {
  const Eigen::Matrix3f R = R_map_base.cast<float>();
  for (Observation& o : observations) {
    facing_of(R * Eigen::Vector3f(o.normal[0], o.normal[1], o.normal[2]), &o.facing);
  }
}

}  // namespace pose_wall::motion
