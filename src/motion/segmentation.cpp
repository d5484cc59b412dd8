// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/segmentation.hpp"

#include <cmath>
#include <initializer_list>

namespace pose_wall::motion {
namespace {

// Neighbouring rings on level ground lie within 10 degrees of level (the document's and LeGO-LOAM's threshold).
constexpr float kGroundSlope = 0.17633F;
// Ground lies below the sensor, by more than a step.
constexpr float kBelowSensor_m = 0.3F;
// Smaller clusters are noise (the document: "points < 30").
constexpr std::uint32_t kClusterLeast = 30;

// Neighbours are of one surface when their ranges are this alike: a wall that is met at 10 degrees steps by 6 times the
// spacing of directions, which is 0.012 rad.
float step_most_m(float range_m) {
  return 0.15F + 0.07F * range_m;
}

// Of two neighbours one above the other: both are ground if the line between them is level.
std::uint32_t mark_ground(const Eigen::Matrix3d& R_map_base, const Mount& mount, RangeImage* image) {
  const Eigen::Vector3f up = R_map_base.row(2).transpose().cast<float>();
  const float sensor = up.dot(mount.sensor_base_m.cast<float>()) - kBelowSensor_m;
  const std::uint32_t columns = image->columns;
  for (std::uint32_t a = 0; a < image->count; ++a) {
    const Eigen::Vector3f pa = image->point(a);
    if (!(up.dot(pa) < sensor)) continue;
    const std::uint32_t above = image->place[a] + columns;
    if (above >= image->rows * columns) continue;
    std::uint16_t b = image->cell[above];
    if (b == kNoPoint && above + columns < image->rows * columns) b = image->cell[above + columns];
    if (b == kNoPoint) continue;
    const Eigen::Vector3f pb = image->point(b), d = pb - pa;
    const float rise = up.dot(d);
    if (!(up.dot(pb) < sensor)) continue;
    if (!(rise * rise < kGroundSlope * kGroundSlope * (d.squaredNorm() - rise * rise))) continue;
    image->flags[a] |= kGround | kKept;
    image->flags[b] |= kGround | kKept;
  }
  std::uint32_t marked = 0;
  for (std::uint32_t i = 0; i < image->count; ++i) marked += image->flags[i] & 1U;
  return marked;
}

// Which points are of one surface. Row by row from the lowest: a point takes the label of its left neighbour, and where
// it meets the row below, two labels turn out to be one (Rosenfeld and Pfaltz 1966). A search breadth first looked at
// each point eight times.
class Clusters {
 public:
  Clusters(const RangeImage& image, SegmentScratch* scratch) : image_(image), s_(*scratch) {}

  void label_all() {
    const std::uint32_t columns = image_.columns, cells = image_.rows * columns;
    for (std::uint32_t row = 0; row < cells; row += columns) {
      std::uint16_t left = kNoPoint, but_one = kNoPoint;
      for (std::uint32_t place = row; place < row + columns; ++place) {
        const std::uint16_t at = image_.cell[place];
        if (is_rock(at)) {
          const std::uint16_t beside = other_of(at, left, but_one);
          s_.label[at] = beside != kNoPoint ? s_.label[beside] : new_label();
          join(at, place >= columns ? image_.cell[place - columns] : kNoPoint,
               place >= 2 * columns ? image_.cell[place - 2 * columns] : kNoPoint);
        }
        but_one = left;
        left = at;
      }
      // columns go round
      const std::uint16_t first = image_.cell[row], second = image_.cell[row + 1];
      if (is_rock(first)) join(first, left, but_one);
      if (is_rock(second) && !is_rock(first)) join(second, first, left);
    }
    for (std::uint32_t k = 0; k < labels_; ++k) s_.leads_to[k] = root(static_cast<std::uint16_t>(k));
  }

  std::uint16_t of(std::uint32_t point) const { return s_.leads_to[s_.label[point]]; }
  std::uint32_t labels() const { return labels_; }

 private:
  bool is_rock(std::uint16_t i) const { return i != kNoPoint && (image_.flags[i] & kGround) == 0; }

  // The one of the two on the same surface; none if that is ground. If the next is on another surface, as between the
  // lines of a pattern or in dust, the next but one is tried.
  std::uint16_t other_of(std::uint16_t at, std::uint16_t next, std::uint16_t but_one) const {
    for (const std::uint16_t other : {next, but_one}) {
      if (other == kNoPoint) continue;
      const float a = image_.range[at], b = image_.range[other];
      if (!(std::fabs(a - b) < step_most_m(a > b ? a : b))) continue;
      return is_rock(other) ? other : kNoPoint;
    }
    return kNoPoint;
  }

  void join(std::uint16_t at, std::uint16_t next, std::uint16_t but_one) {
    const std::uint16_t other = other_of(at, next, but_one);
    if (other == kNoPoint || s_.label[at] == s_.label[other]) return;
    const std::uint16_t a = root(s_.label[at]), b = root(s_.label[other]), least = a < b ? a : b;
    s_.leads_to[a] = s_.leads_to[b] = least;
    s_.label[at] = least;
  }

  std::uint16_t new_label() {
    const std::uint16_t label = static_cast<std::uint16_t>(labels_++);
    s_.leads_to[label] = label;
    return label;
  }
  std::uint16_t root(std::uint16_t label) const {
    while (s_.leads_to[label] != label) label = s_.leads_to[label] = s_.leads_to[s_.leads_to[label]];
    return label;
  }

  const RangeImage& image_;
  SegmentScratch& s_;
  std::uint32_t labels_ = 0;
};

}  // namespace

void SegmentScratch::lay_out(Arena& arena) {
  label = arena.take<std::uint16_t>(kImageCells);
  leads_to = arena.take<std::uint16_t>(kImageCells);
  size = arena.take<std::uint16_t>(kImageCells);
}

Segments segment(const Eigen::Matrix3d& R_map_base, const Mount& mount, SegmentScratch* scratch, RangeImage* image) {
  Segments out;
  out.ground = mark_ground(R_map_base, mount, image);
  Clusters clusters(*image, scratch);
  clusters.label_all();
  scratch->size.first(clusters.labels()).fill(0);
  for (std::uint32_t i = 0; i < image->count; ++i) {
    if ((image->flags[i] & kGround) == 0) ++scratch->size[clusters.of(i)];
  }
  for (std::uint32_t label = 0; label < clusters.labels(); ++label) {
    out.clusters += scratch->size[label] >= kClusterLeast ? 1U : 0U;
  }
  for (std::uint32_t i = 0; i < image->count; ++i) {
    if ((image->flags[i] & kGround) != 0) continue;
    if (scratch->size[clusters.of(i)] >= kClusterLeast) image->flags[i] |= kKept;
  }
  return out;
}

}  // namespace pose_wall::motion
