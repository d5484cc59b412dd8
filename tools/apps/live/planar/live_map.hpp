// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The map of a SLAM that goes on. Scans come in as they are taken. Where the graph moves earlier poses, the map is
// built anew beside the present one, some scans at a time, so that no frame waits for it.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "apps/live/planar/planar_news.hpp"
#include "pose_wall_planar_map.h"
#include "study/planar/part_block.hpp"
#include "study/planar/scan_trail.hpp"

namespace pose_wall::tools::live {

class LiveMap {
 public:
  // Throws PlanarError.
  explicit LiveMap(double cell_m);

  // A scan that the SLAM has just placed. Throws PlanarError.
  void add(const pose_wall_planar_scan& scan, const pose_wall_planar_slam_result& placed,
           const pose_wall_planar_slam* slam);

  // What it holds now; nothing where no cell was seen, or nothing has changed since the last one. A map of more than
  // kCellsMost cells comes in larger ones.
  std::shared_ptr<const RoadwayMap> changed(std::int64_t header_stamp_ns);

  std::uint64_t beams_not_stored() const { return beams_not_stored_; }
  std::uint64_t rebuilt() const { return rebuilt_; }

  static constexpr std::uint64_t kCellsMost = std::uint64_t{1} << 22U;

 private:
  class Cells;

  void go_on_building(const pose_wall_planar_slam* slam, std::uint32_t solution);
  void insert(Cells* cells, const KeptScan& kept, const pose_wall_planar_slam* slam);

  double cell_m_;
  std::vector<KeptScan> kept_;
  std::uint32_t keyframe_ = UINT32_MAX, of_keyframe_ = 0;  // the newest, and how many scans of it were kept
  std::shared_ptr<Cells> shown_, building_;
  std::uint32_t solution_shown_ = 0, solution_building_ = 0;
  std::size_t built_ = 0;  // of kept_, in building_
  bool is_building_ = false, is_changed_ = false;
  std::uint64_t beams_not_stored_ = 0, rebuilt_ = 0, version_ = 0;
};

// `map` with squares of `step` cells as one: a thing wins, then the likeliest; unknown where nothing is known.
void coarsen_rows(const std::int8_t* rows, std::uint32_t width, std::uint32_t height, std::uint32_t step,
                  std::int8_t* into);

}  // namespace pose_wall::tools::live
