// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/relief_map.hpp"

#include <Eigen/LU>
#include <cmath>

#include "base/math/golden_ratio.hpp"

namespace pose_wall::motion {
namespace {

// Units of a cell's height, its sizes, and the unit of its points' place:
constexpr float kUnit_m = 1e-4F;
constexpr float kAlong_m = 1.0F / kAlongCells;
constexpr float kAcross_m = 1.0F / kAcrossCells;
constexpr float kPlaceUnit_m = kAlong_m / 256.0F;
// About the first point of a surface whose slope is not known yet: 45 degrees over half a tile, and some relief.
constexpr float kFreshLayer_m = 0.6F;
constexpr double kRidge = 0.05;  // m2: some flat plane goes into a tile's own, so that a line of points tilts nothing

struct Place {
  std::int32_t u, v;       // tile
  float at_u, at_v, at_k;  // from its middle; along the axis, from the corner
};

inline std::int32_t whole(float value) {
  const std::int32_t cut = static_cast<std::int32_t>(value);
  return cut - (value < static_cast<float>(cut) ? 1 : 0);
}

inline Place place_of(const Eigen::Vector3f& p, std::uint8_t facing, const std::int32_t (&corner)[3]) {
  const int iu = kU[facing], iv = kV[facing];
  const std::int32_t u = whole(p[iu]), v = whole(p[iv]);
  return {u + corner[iu], v + corner[iv], p[iu] - static_cast<float>(u) - 0.5F, p[iv] - static_cast<float>(v) - 0.5F,
          p[facing]};
}

std::int32_t along_cell(float u) {
  const std::int32_t i = static_cast<std::int32_t>((u + 0.5F) * kAlongCells);
  return i < 0 ? 0 : i >= kAlongCells ? kAlongCells - 1 : i;
}
std::int32_t across_cell(float v) {
  const std::int32_t i = static_cast<std::int32_t>((v + 0.5F) * kAcrossCells);
  return i < 0 ? 0 : i >= kAcrossCells ? kAcrossCells - 1 : i;
}

float middle_along(std::int32_t i) {
  return (static_cast<float>(i) + 0.5F) * kAlong_m - 0.5F;
}
float middle_across(std::int32_t j) {
  return (static_cast<float>(j) + 0.5F) * kAcross_m - 0.5F;
}

// Where a cell's points lie along u.
float along_of(const Cell& cell, std::int32_t i) {
  return middle_along(i) + static_cast<float>(cell.along) * kPlaceUnit_m;
}
float height_of(const Cell& cell) {
  return static_cast<float>(cell.height_um100) * kUnit_m;
}

std::int16_t rounded(float value, float most) {
  const float r = std::floor(value + 0.5F);
  return static_cast<std::int16_t>(r > most ? most : r < -most ? -most : r);
}

}  // namespace

void ReliefMap::lay_out(Arena& arena) {
  tile_ = arena.take<Tile>(kTilesMost);
  bucket_ = arena.take<std::int16_t>(2 * kTilesMost);
  fresh_ = arena.take<std::int16_t>(kTilesMost);
}

void ReliefMap::clear() {
  bucket_.fill(-1);
  used_ = fresh_count_ = keyframe_ = 0;
  gave_way_ = false;
}

void ReliefMap::set_corner(const Eigen::Vector3d& near_map) {
  constexpr double kAway_m = 128.0;  // so that near places count from zero upwards
  for (int k = 0; k < 3; ++k) corner_[k] = static_cast<std::int32_t>(std::floor(near_map[k] - kAway_m));
}

std::uint32_t ReliefMap::bucket_of(std::int32_t u, std::int32_t v, std::uint8_t facing) const {
  std::uint64_t key = static_cast<std::uint64_t>(static_cast<std::uint32_t>(u)) << 32U | static_cast<std::uint32_t>(v);
  key = (key + facing) * kGoldenTurn64;
  return static_cast<std::uint32_t>(key >> 40U) & (bucket_.size() - 1);
}

bool ReliefMap::find(const Eigen::Vector3f& p, std::uint8_t facing, Surface* out) const {
  const Place at = place_of(p, facing, corner_);
  const float base = static_cast<float>(corner_[facing]);
  float best = kLayer_m;
  bool found = false;
  for (std::int32_t i = bucket_[bucket_of(at.u, at.v, facing)]; i >= 0;) {
    const Tile& tile = tile_[static_cast<std::uint32_t>(i)];
    i = tile.next;
    if (tile.u != at.u || tile.v != at.v || tile.facing != facing || tile.fresh != 0) continue;
    const float above = at.at_k - (tile.height_m - base) - tile.slope_u * at.at_u - tile.slope_v * at.at_v;
    if (!(std::fabs(above) < best)) continue;
    best = std::fabs(above);
    *out = {&tile, at.at_u, at.at_v, above};
    found = true;
  }
  return found;
}

Surface ReliefMap::over(const Tile& tile, const Eigen::Vector3f& p) const {
  const int iu = kU[tile.facing], iv = kV[tile.facing];
  const float u = p[iu] - static_cast<float>(tile.u - corner_[iu]) - 0.5F;
  const float v = p[iv] - static_cast<float>(tile.v - corner_[iv]) - 0.5F;
  const float plane_m = tile.height_m - static_cast<float>(corner_[tile.facing]);
  return {&tile, u, v, p[tile.facing] - plane_m - tile.slope_u * u - tile.slope_v * v};
}

bool ReliefMap::find_again(const Eigen::Vector3f& p, const Tile* before, Surface* out) const {
  *out = over(*before, p);
  if (!(std::fabs(out->u) <= 0.5F && std::fabs(out->v) <= 0.5F)) return find(p, before->facing, out);
  return std::fabs(out->above_m) < kLayer_m;
}

namespace {

// Interpolates between two cells' heights, for one point or four. Steeper than 45 degrees the place of the step within
// the cells is unknown, and the sensor's place decides which side of it is seen: anything between the two heights
// agrees. Steel sets stretched the way by 0.6 % when a slope was drawn there.
template <typename Number>
Number height_between(Number h0, Number h1, Number w, Number above) {
  const Number low = h0 < h1 ? h0 : h1, high = h0 < h1 ? h1 : h0;
  const Number within = above < low ? low : above > high ? high : above;
  return high - low > kAlong_m ? within : h0 + w * (h1 - h0);
}
template <typename Number>
Number spread_between(Number n0, Number n1, Number w) {
  return 1.0F + (1.0F - w) * (1.0F - w) / n0 + w * w / n1;
}

FourInts within(FourInts i, std::int32_t count) {
  i = i < 0 ? all_four_ints(0) : i;
  return i < count ? i : all_four_ints(count - 1);
}

struct FourCells {
  FourCells(const Cell* cells, FourInts row, FourInts i) {
    for (std::uint32_t k = 0; k < kFour; ++k) {
      const Cell& cell = cells[row[k] * kAlongCells + i[k]];
      height[k] = cell.height_um100, along[k] = static_cast<float>(cell.along), count[k] = cell.count;
    }
  }
  FourFloats height_m() const { return __builtin_convertvector(height, FourFloats) * kUnit_m; }
  FourFloats along_m(FourInts i) const {
    return (__builtin_convertvector(i, FourFloats) + 0.5F) * kAlong_m - 0.5F + along * kPlaceUnit_m;
  }
  FourFloats number() const { return __builtin_convertvector(count, FourFloats); }

  FourInts height, count;
  FourFloats along;
};

}  // namespace

bool ReliefMap::relief(const Surface& at, Relief* out) {
  const Cell* const cells = at.tile->cell + across_cell(at.v) * kAlongCells;
  const std::int32_t i = along_cell(at.u);
  if (cells[i].count == 0) return false;
  const float here = along_of(cells[i], i);
  const std::int32_t j = at.u > here ? i + 1 : i - 1;
  if (j < 0 || j >= kAlongCells || cells[j].count == 0) return false;
  const float there = along_of(cells[j], j);
  const float w = (at.u - here) / (there - here);
  out->spread = spread_between(static_cast<float>(cells[i].count), static_cast<float>(cells[j].count), w);
  out->height_m = height_between(height_of(cells[i]), height_of(cells[j]), w, at.above_m);
  return true;
}

FourTruths ReliefMap::relief(const FourSurfaces& at, FourReliefs* out) {
  const FourInts row = within(cut_off((at.v + 0.5F) * kAcrossCells), kAcrossCells);
  const FourInts i = within(cut_off((at.u + 0.5F) * kAlongCells), kAlongCells);
  const FourCells near(at.tile->cell, row, i);
  const FourFloats here = near.along_m(i);
  const FourInts j = i + (at.u > here ? all_four_ints(1) : all_four_ints(-1)), j_within = within(j, kAlongCells);
  const FourCells next(at.tile->cell, row, j_within);
  const FourFloats w = (at.u - here) / (next.along_m(j) - here);
  out->spread = spread_between(near.number(), next.number(), w);
  out->height_m = height_between(near.height_m(), next.height_m(), w, at.above_m);
  return (near.count > 0) & (next.count > 0) & (j == j_within);
}

std::int32_t ReliefMap::take_tile() {
  if (used_ < tile_.size()) return static_cast<std::int32_t>(used_++);
  std::uint32_t oldest = 0;
  for (std::uint32_t i = 1; i < tile_.size(); ++i) {
    if (tile_[i].seen < tile_[oldest].seen) oldest = i;
  }
  const Tile& tile = tile_[oldest];
  if (tile.seen == keyframe_) return -1;  // one scan fills the map
  gave_way_ = true;
  std::int16_t* link = &bucket_[bucket_of(tile.u, tile.v, tile.facing)];
  while (*link != static_cast<std::int16_t>(oldest)) link = &tile_[static_cast<std::uint32_t>(*link)].next;
  *link = tile.next;
  return static_cast<std::int32_t>(oldest);
}

// Points come one beside the other: most lie on the tile of the one before.
bool ReliefMap::is_still_over(const Tile& tile, const Eigen::Vector3f& p, std::uint8_t facing, Surface* at) const {
  if (tile.facing != facing) return false;
  *at = over(tile, p);
  constexpr float kNoOther_m = 0.5F * kLayer_m;  // further off, another surface may be nearer
  return std::fabs(at->u) < 0.5F && std::fabs(at->v) < 0.5F && std::fabs(at->above_m) < kNoOther_m;
}

Tile* ReliefMap::tile_for(const Eigen::Vector3f& p, std::uint8_t facing, Surface* at) {
  if (find(p, facing, at)) return &tile_[index_of(at->tile)];
  const Place place = place_of(p, facing, corner_);
  const float base = static_cast<float>(corner_[facing]);
  const std::uint32_t bucket = bucket_of(place.u, place.v, facing);
  for (std::int32_t i = bucket_[bucket]; i >= 0; i = tile_[static_cast<std::uint32_t>(i)].next) {
    Tile& tile = tile_[static_cast<std::uint32_t>(i)];
    if (tile.u != place.u || tile.v != place.v || tile.facing != facing || tile.fresh == 0) continue;
    const float above = place.at_k - (tile.height_m - base);
    if (!(std::fabs(above) < kFreshLayer_m)) continue;
    *at = {&tile, place.at_u, place.at_v, above};
    return &tile;
  }
  const std::int32_t index = fresh_count_ < fresh_.size() ? take_tile() : -1;
  if (index < 0) return nullptr;
  Tile& tile = tile_[static_cast<std::uint32_t>(index)];
  tile = {place.u, place.v, place.at_k + base, 0.0F, 0.0F, 1.0F, keyframe_, bucket_[bucket], facing, 1, 0, 0, {}, {}};
  bucket_[bucket] = static_cast<std::int16_t>(index);
  fresh_[fresh_count_++] = static_cast<std::int16_t>(index);
  *at = {&tile, place.at_u, place.at_v, 0.0F};
  return &tile;
}

void ReliefMap::add(const Eigen::Vector3f& p, std::uint8_t facing) {
  Surface at;
  Tile* const tile = last_ != nullptr && is_still_over(*last_, p, facing, &at) ? last_ : tile_for(p, facing, &at);
  if (tile == nullptr) return;
  last_ = tile;
  tile->seen = keyframe_;
  const std::int32_t i = along_cell(at.u);
  Cell& cell = tile->cell[across_cell(at.v) * kAlongCells + i];
  if (cell.count < 255) ++cell.count;
  const float share = 1.0F / static_cast<float>(cell.count);
  const float height = height_of(cell), along = static_cast<float>(cell.along);
  const float place = (at.u - middle_along(i)) / kPlaceUnit_m;
  cell.height_um100 = rounded((height + (at.above_m - height) * share) / kUnit_m, 32767.0F);
  cell.along = static_cast<std::int8_t>(rounded(along + (place - along) * share, 127.0F));
}

namespace {

// How far rays from the sensor go along a tile, along u and v, for each metre towards its axis.
struct RaysOver {
  RaysOver(const Tile& tile, float height_m, const Eigen::Vector3f& sensor)
      : towards_m(height_m - sensor[tile.facing]),
        middle_u_m(static_cast<float>(tile.u) + 0.5F - sensor[kU[tile.facing]]),
        middle_v_m(static_cast<float>(tile.v) + 0.5F - sensor[kV[tile.facing]]) {}

  // At a place of the tile.
  float along_u(float u) const { return no_flatter(middle_u_m + u); }
  float along_v(float v) const { return no_flatter(middle_v_m + v); }

  // A flatter ray meets the edge of a surface, not the surface.
  float no_flatter(float along_m) const {
    constexpr float kFlattest = 20.0F;  // 2.9 degrees: ground that a sensor 1.4 m high sees 28 m away
    const float most_m = kFlattest * std::fabs(towards_m);
    return std::fabs(along_m) < most_m ? along_m / towards_m : std::copysign(kFlattest, along_m * towards_m);
  }

  float towards_m, middle_u_m, middle_v_m;
};

float mean_height(const Tile& tile) {
  float sum = 0.0F, cells = 0.0F;
  for (const Cell& cell : tile.cell) {
    if (cell.count == 0) continue;
    sum += height_of(cell);
    cells += 1.0F;
  }
  return sum / cells;  // a tile begins with a point
}

// A plane through a tile's cells: its height in the middle, and its slopes along u and v.
//
// Where rock stands out, a ray meets it sooner: places and heights err together along the ray, and a line of points on
// rough ground tilts towards the sensor, whatever the ground does. Where a ray meets the tile's mean height is the
// ray's alone, so that place is the instrument of the place (least squares by instrumental variables).
Eigen::Vector3f plane_of(const Tile& tile, const Eigen::Vector3f& sensor) {
  const float mean = mean_height(tile);
  const RaysOver rays(tile, tile.height_m + mean, sensor);
  Eigen::Matrix3d A = Eigen::Vector3d(1e-6, kRidge, kRidge).asDiagonal(), by_places = A, by_rays = A;
  Eigen::Vector3d b = Eigen::Vector3d::Zero(), b_by_places = b;
  for (std::int32_t k = 0; k < kAlongCells * kAcrossCells; ++k) {
    const Cell& cell = tile.cell[k];
    if (cell.count == 0) continue;
    const float u = along_of(cell, k % kAlongCells), v = middle_across(k / kAlongCells);
    const float above = height_of(cell) - mean;
    const Eigen::Vector3d place(1.0, static_cast<double>(u), static_cast<double>(v));
    const Eigen::Vector3d ray(1.0, static_cast<double>(u - above * rays.along_u(u)),
                              static_cast<double>(v - above * rays.along_v(v)));
    A += ray * place.transpose();
    by_places += place * place.transpose();
    by_rays += ray * ray.transpose();
    b += ray * static_cast<double>(above);
    b_by_places += place * static_cast<double>(above);
  }
  // A surface that faces flat rays steeply, or noise: the rays tell little of the places, and the places do not follow
  // the heights.
  constexpr double kTells = 0.25;
  const bool tells = A.determinant() > kTells * by_rays.determinant();
  Eigen::Vector3f plane = (tells ? A.inverse() * b : by_places.inverse() * b_by_places).cast<float>();
  plane[0] += mean;
  return plane;
}

}  // namespace

// The plane of a surface that began in this keyframe; heights count from it then.
void ReliefMap::settle(Tile* tile) {
  const Eigen::Vector3f plane = plane_of(*tile, sensor_);
  for (std::int32_t k = 0; k < kAlongCells * kAcrossCells; ++k) {
    Cell& cell = tile->cell[k];
    if (cell.count == 0) continue;
    const float height = height_of(cell) - plane[0] - plane[1] * along_of(cell, k % kAlongCells) -
                         plane[2] * middle_across(k / kAlongCells);
    if (std::fabs(height) < kLayer_m) {
      cell.height_um100 = rounded(height / kUnit_m, 32767.0F);
    } else {
      cell = Cell{};
    }
  }
  tile->height_m += plane[0];
  tile->slope_u = plane[1];
  tile->slope_v = plane[2];
  tile->cosine = 1.0F / std::sqrt(1.0F + plane[1] * plane[1] + plane[2] * plane[2]);
  tile->fresh = 0;
}

std::uint32_t ReliefMap::end_keyframe() {
  const std::uint32_t began = fresh_count_;
  for (std::uint32_t f = 0; f < began; ++f) settle(&tile_[static_cast<std::uint32_t>(fresh_[f])]);
  fresh_count_ = 0;
  for (std::uint32_t t = 0; t < used_; ++t) {
    Tile& tile = tile_[t];
    if (tile.seen != keyframe_) continue;
    tile.stands_free = goes_on_behind(tile) ? 1 : 0;
    if (tile.keyframes < 255) ++tile.keyframes;
    const float share = 1.0F / static_cast<float>(tile.keyframes);
    for (int k = 0; k < 3; ++k) tile.seen_from[k] += share * (sensor_[k] - tile.seen_from[k]);
  }
  return began;
}

bool ReliefMap::has_ground(std::int32_t x, std::int32_t y, float below_m) const {
  for (std::int32_t i = bucket_[bucket_of(x, y, kFacesZ)]; i >= 0;) {
    const Tile& tile = tile_[static_cast<std::uint32_t>(i)];
    i = tile.next;
    if (tile.u == x && tile.v == y && tile.facing == kFacesZ && tile.height_m < below_m) return true;
  }
  return false;
}

// Another surface over the same square, further from the sensor; or ground, where all of the tile and its layer have
// ended.
bool ReliefMap::goes_on_behind(const Tile& tile) const {
  const float away = tile.height_m > sensor_[tile.facing] ? 1.0F : -1.0F;
  for (std::int32_t i = bucket_[bucket_of(tile.u, tile.v, tile.facing)]; i >= 0;) {
    const Tile& other = tile_[static_cast<std::uint32_t>(i)];
    i = other.next;
    if (other.u != tile.u || other.v != tile.v || other.facing != tile.facing) continue;
    if (away * (other.height_m - tile.height_m) > kLayer_m) return true;
  }
  if (tile.facing == kFacesZ) return false;
  const float half_m = 0.5F * (std::fabs(tile.slope_u) + std::fabs(tile.slope_v)) + kLayer_m;
  const std::int32_t beyond = whole(tile.height_m + away * half_m) + (away > 0.0F ? 1 : -1);
  const float middle_m = static_cast<float>(tile.v) + 0.5F;
  const float below_m = middle_m < sensor_.z() ? middle_m : sensor_.z();
  return tile.facing == kFacesX ? has_ground(beyond, tile.u, below_m) : has_ground(tile.u, beyond, below_m);
}

void ReliefMap::forget_relief() {
  for (std::uint32_t t = 0; t < used_; ++t) {
    for (Cell& cell : tile_[t].cell) cell = Cell{};
  }
}

double ReliefMap::unevenness() const {
  double worst = 0.0;
  for (const std::uint8_t facing : {kFacesY, kFacesZ}) {
    double n = 0.0, su = 0.0, squares = 0.0;
    for (std::uint32_t t = 0; t < used_; ++t) {
      if (tile_[t].facing != facing) continue;
      const double u = static_cast<double>(tile_[t].slope_u);
      n += 1.0;
      su += u;
      squares += u * u;
    }
    const double variance = n > 0.0 ? (squares - su * su / n) / n : 0.0;
    if (variance > worst) worst = variance;
  }
  return std::sqrt(worst);
}

std::uint32_t ReliefMap::points(std::uint32_t first, std::uint32_t capacity, float* xyz_m) const {
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < used_; ++t) {
    const Tile& tile = tile_[t];
    for (std::int32_t k = 0; k < kAlongCells * kAcrossCells; ++k) {
      const Cell& cell = tile.cell[k];
      if (cell.count == 0) continue;
      if (count >= first && count - first < capacity) {
        const float u = along_of(cell, k % kAlongCells), v = middle_across(k / kAlongCells);
        float* const out = xyz_m + std::size_t{3} * (count - first);
        out[kU[tile.facing]] = static_cast<float>(tile.u) + 0.5F + u;
        out[kV[tile.facing]] = static_cast<float>(tile.v) + 0.5F + v;
        out[tile.facing] = tile.height_m + tile.slope_u * u + tile.slope_v * v + height_of(cell);
      }
      ++count;
    }
  }
  return count;
}

}  // namespace pose_wall::motion
