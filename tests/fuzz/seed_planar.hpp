// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Seeds of the planar library's targets: a trail and a map as the library saves them, logs and images.

#pragma once

#include <string>
#include <vector>

#include "fuzz/scans_from_input.hpp"
#include "pose_wall_planar_map.h"
#include "pose_wall_planar_slam.h"

namespace pose_wall::test::seeds {

// A narrow hall from one of its ends, so that few tiles hold it.
inline const pose_wall_planar_scan& short_scan(std::uint32_t step) {
  static ScanOfInput seen;
  Input none(nullptr, 0);
  begin_scan(&none, &seen);
  Hall hall;
  hall.half_length_m = 1.4;
  hall.half_width_m = 1.1;
  see_hall(hall, {0.3 * step - 0.3, 0.0, 0.1 * step}, &seen);
  return seen.scan;
}

inline std::string saved_trail() {
  pose_wall_planar_slam_settings settings;
  require_ok(pose_wall_planar_slam_settings_init(&settings), "settings");
  settings.keyframes_most = 16;
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_slam_memory_needed(&settings, &bytes), "memory needed");
  KeptBlock block;
  pose_wall_planar_slam* slam = nullptr;
  require_ok(pose_wall_planar_slam_open(&settings, block.filled(bytes, 0), bytes, &slam), "open");
  for (std::uint32_t step = 0; step < 4; ++step) {
    pose_wall_planar_slam_result result{};
    result.struct_size = sizeof result;
    require_ok(pose_wall_planar_slam_process(slam, &short_scan(step), nullptr, &result), "process");
  }
  require_ok(pose_wall_planar_slam_save_bytes(slam, &bytes), "bytes");
  std::string saved(static_cast<std::size_t>(bytes), '\0');
  require_ok(pose_wall_planar_slam_save(slam, saved.data(), bytes, &bytes), "save");
  return saved;
}

inline std::string saved_map(bool is_tile) {
  pose_wall_planar_map_settings settings;
  require_ok(pose_wall_planar_map_settings_init(&settings), "settings");
  settings.tiles = 16;
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_map_memory_needed(&settings, &bytes), "memory needed");
  KeptBlock block;
  pose_wall_planar_map* map = nullptr;
  require_ok(pose_wall_planar_map_open(&settings, block.filled(bytes, 0), bytes, &map), "open");
  pose_wall_planar_map_report report{};
  report.struct_size = sizeof report;
  const pose_wall_planar_pose base{1.6, 1.6, 0.0};  // the middle of a tile
  require_ok(pose_wall_planar_map_insert(map, &short_scan(1), &base, &report), "insert");
  if (is_tile) {
    static pose_wall_planar_tile tile;
    tile.struct_size = sizeof tile;
    require_ok(pose_wall_planar_map_get_tile(map, 0, &tile), "tile");
    return std::string(reinterpret_cast<const char*>(&tile) + 8, sizeof tile - 8);
  }
  require_ok(pose_wall_planar_map_save_bytes(map, &bytes), "bytes");
  std::string saved(static_cast<std::size_t>(bytes), '\0');
  require_ok(pose_wall_planar_map_save_all(map, saved.data(), bytes, nullptr), "save");
  return saved;
}

inline std::vector<std::string> carmen_logs() {
  return {
      "# a log\nPARAM robot_frontlaser_offset 0.22 nohost 0\n"
      "FLASER 4 1.0 2.0 50.00 0.5 0 0 0 0.1 0 0.01 1.5 host 0.5\r\n"
      "FLASER 5 1.0 2.0 50.00 0.5 3 0 0 0 0.1 0 0.01 1.4 host 0.6\nODOM 0 0 0 0 0 0 1.5 host 0.5\nFLASER 3 1 2\n",
      "ROBOTLASER1 0 -1.570796 3.141593 1.570796 81.9 0.01 0 3 1.0 2.0 81.91 0 0.22 0 0 0 0 0 0 0 0 0 0 "
      "1232658478.161285 nohost 0\n",
      "FLASER 1 nan 0 0 0 0 0 0 976052857.436207 nohost 0",
  };
}

inline std::vector<std::string> pgm_images() {
  return {
      std::string("P5\n# c\n3 2\n255\n\0\1\2\3\4\5", 21),
      "P2\n3 2 # c\n65535\n0 1 2\n3 4 65535\n",
      std::string("P5 2 2 300\n\1\0\0\1\0\2\1\2", 19),
  };
}

}  // namespace pose_wall::test::seeds
