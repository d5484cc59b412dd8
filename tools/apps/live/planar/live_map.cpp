// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/planar/live_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/language/language.hpp"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools::live {
namespace {

// Two looks free a cell (pose_wall_planar_map.h).
constexpr std::uint32_t kScansOfKeyframe = 2;
// Of a turn: 2 cm apart at 10 m. A trail of 4096 keyframes then takes 0.1 GB.
constexpr std::uint32_t kBeamsKept = POSE_WALL_PLANAR_BEAMS_MAX / 2;
// Scans that a frame inserts anew at most: half a millisecond each.
constexpr std::size_t kRebuiltAtOnce = 30;
// 84,000 square metres of cells of 5 cm, in 39 MB.
constexpr std::uint32_t kTiles = 8192;

pose_wall_planar_map_settings settings_of(double cell_m) {
  pose_wall_planar_map_settings settings{};
  require_ok(pose_wall_planar_map_settings_init(&settings), translatable("the settings of the map"));
  settings.cell_m = cell_m;
  settings.distance_cap_m = 0.0;  // nobody asks for distances here
  settings.tiles = kTiles;
  return settings;
}

std::uint64_t bytes_for(const pose_wall_planar_map_settings& settings) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_map_memory_needed(&settings, &bytes), translatable("the settings of the map"));
  return bytes;
}

// With every second beam, third beam ..., so that few enough are left.
KeptScan thinned(const pose_wall_planar_scan& scan, const pose_wall_planar_slam_result& placed) {
  const std::uint32_t step = (scan.beams + kBeamsKept - 1) / kBeamsKept;
  std::vector<float> range_m;
  range_m.reserve(kBeamsKept);
  for (std::uint32_t k = 0; k < scan.beams; k += step) range_m.push_back(scan.range_m[k]);
  pose_wall_planar_scan few = scan;
  few.beams = static_cast<std::uint32_t>(range_m.size());
  few.angle_step_rad *= step;
  few.range_m = range_m.data();
  few.free_m = nullptr;
  return KeptScan(few, placed);
}

}  // namespace

class LiveMap::Cells {
 public:
  explicit Cells(double cell_m) : settings_(settings_of(cell_m)), block_(bytes_for(settings_)) {
    require_ok(pose_wall_planar_map_open(&settings_, block_.data(), block_.bytes(), &map_),
               translatable("the settings of the map"));
  }
  pose_wall_planar_map* get() const { return map_; }
  double cell_m() const { return settings_.cell_m; }

  pose_wall_planar_box box() const {
    pose_wall_planar_box box{};
    box.struct_size = sizeof box;
    require_ok(pose_wall_planar_map_box(map_, &box), translatable("the map"));
    return box;
  }
  // Rows of the box from row `first` on.
  void read(const pose_wall_planar_box& box, std::uint32_t first, std::uint32_t width, std::uint32_t height,
            std::vector<std::int8_t>* cells) const {
    pose_wall_planar_grid grid{};
    grid.struct_size = sizeof grid;
    cells->resize(std::size_t{width} * height);
    // The middle of the corner's cell: its edge may round into the cell beside it.
    require_ok(pose_wall_planar_map_grid(map_, box.x_min_m + 0.5 * cell_m(), box.y_min_m + (first + 0.5) * cell_m(),
                                         width, height, cells->data(), cells->size(), &grid),
               translatable("the map"));
  }

 private:
  pose_wall_planar_map_settings settings_;
  PartBlock block_;
  pose_wall_planar_map* map_ = nullptr;
};

void coarsen_rows(const std::int8_t* rows, std::uint32_t width, std::uint32_t height, std::uint32_t step,
                  std::int8_t* into) {
  const std::uint32_t columns = (width + step - 1) / step;
  std::fill_n(into, std::size_t{columns} * ((height + step - 1) / step), std::int8_t{POSE_WALL_PLANAR_UNKNOWN});
  for (std::uint32_t row = 0; row < height; ++row) {
    std::int8_t* const of_row = into + std::size_t{row / step} * columns;
    for (std::uint32_t column = 0; column < width; ++column) {
      std::int8_t& cell = of_row[column / step];
      cell = std::max(cell, rows[std::size_t{row} * width + column]);
    }
  }
}

LiveMap::LiveMap(double cell_m) : cell_m_(cell_m), shown_(std::make_shared<Cells>(cell_m)) {}

void LiveMap::insert(Cells* cells, const KeptScan& kept, const pose_wall_planar_slam* slam) {
  pose_wall_planar_keyframe keyframe{};
  keyframe.struct_size = sizeof keyframe;
  require_ok(pose_wall_planar_slam_keyframe(slam, kept.keyframe, &keyframe), translatable("a keyframe"));
  const pose_wall_planar_pose base = combined(keyframe.pose, kept.in_keyframe);
  pose_wall_planar_map_report report{};
  report.struct_size = sizeof report;
  const pose_wall_planar_scan scan = kept.view();
  require_ok(pose_wall_planar_map_insert(cells->get(), &scan, &base, &report), translatable("the scan"));
  beams_not_stored_ += report.beams_not_stored;
}

void LiveMap::add(const pose_wall_planar_scan& scan, const pose_wall_planar_slam_result& placed,
                  const pose_wall_planar_slam* slam) {
  if (placed.keyframe != keyframe_) keyframe_ = placed.keyframe, of_keyframe_ = 0;
  // A full trail has no place for it for sure; a doubtful or blind scan has none either.
  const bool is_placed = placed.state == POSE_WALL_PLANAR_SLAM_FIRST || placed.state == POSE_WALL_PLANAR_SLAM_TRACKED;
  if (is_placed && placed.is_full == 0 && of_keyframe_ < kScansOfKeyframe) {
    kept_.push_back(thinned(scan, placed));
    insert(shown_.get(), kept_.back(), slam);
    ++of_keyframe_;
    is_changed_ = true;
  }
  go_on_building(slam, placed.solution);
}

void LiveMap::go_on_building(const pose_wall_planar_slam* slam, std::uint32_t solution) {
  if (kept_.size() == 1 && !is_building_) solution_shown_ = solution;  // nothing was moved before the first
  if (!is_building_ && solution != solution_shown_) {
    if (building_ == nullptr) building_ = std::make_shared<Cells>(cell_m_);
    require_ok(pose_wall_planar_map_clear(building_->get()), translatable("the map"));
    is_building_ = true;
    built_ = 0;
    solution_building_ = solution;
  }
  if (!is_building_) return;
  for (std::size_t k = 0; k < kRebuiltAtOnce && built_ < kept_.size(); ++k)
    insert(building_.get(), kept_[built_++], slam);
  if (built_ < kept_.size()) return;
  std::swap(shown_, building_);
  solution_shown_ = solution_building_;
  is_building_ = false;
  is_changed_ = true;
  ++rebuilt_;
}

std::shared_ptr<const RoadwayMap> LiveMap::changed(std::int64_t header_stamp_ns) {
  if (!is_changed_) return nullptr;
  const pose_wall_planar_box box = shown_->box();
  if (box.cells_seen == 0) return nullptr;
  is_changed_ = false;
  const auto width = static_cast<std::uint32_t>(std::lround((box.x_max_m - box.x_min_m) / cell_m_));
  const auto height = static_cast<std::uint32_t>(std::lround((box.y_max_m - box.y_min_m) / cell_m_));
  std::uint32_t step = 1;
  const auto side = [&step](std::uint32_t cells) { return (std::uint64_t{cells} + step - 1) / step; };
  while (side(width) * side(height) > kCellsMost) ++step;
  auto map = std::make_shared<RoadwayMap>();
  map->version = ++version_;
  map->header_stamp_ns = header_stamp_ns;
  map->width = static_cast<std::uint32_t>(side(width)), map->height = static_cast<std::uint32_t>(side(height));
  map->resolution_m = cell_m_ * step;
  map->origin_x_m = box.x_min_m, map->origin_y_m = box.y_min_m;
  map->cells.resize(std::size_t{map->width} * map->height);
  const std::uint32_t rows_at_once = 16 * step;
  std::vector<std::int8_t> rows;
  for (std::uint32_t row = 0; row < height; row += rows_at_once) {
    const std::uint32_t count = std::min(rows_at_once, height - row);
    shown_->read(box, row, width, count, &rows);
    coarsen_rows(rows.data(), width, count, step, map->cells.data() + std::size_t{row / step} * map->width);
  }
  return map;
}

}  // namespace pose_wall::tools::live
