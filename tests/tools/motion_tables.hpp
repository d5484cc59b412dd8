// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Motion tables and true poses written by hand, cell by cell.

#pragma once

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "study/motion/motion_rows.hpp"

namespace pose_wall::tools::test {

using Cells = std::map<std::string, std::string>;

// Of a frame with a pose at x, y, z, turned to the left by yaw_rad.
inline Cells placed(double x, double y, double z = 0.0, double yaw_rad = 0.0) {
  return {{"x", fmt::format("{}", x)},
          {"y", fmt::format("{}", y)},
          {"z", fmt::format("{}", z)},
          {"qx", "0"},
          {"qy", "0"},
          {"qz", fmt::format("{:.17g}", std::sin(0.5 * yaw_rad))},
          {"qw", fmt::format("{:.17g}", std::cos(0.5 * yaw_rad))}};
}

// The pose with other cells beside it.
inline Cells with(Cells cells, const Cells& more) {
  for (const auto& [name, text] : more) cells[name] = text;
  return cells;
}

inline Cells lost_frame() {
  return {{"along_state", "lost"}, {"along_pl", "inf"}};
}

inline Cells stepped(double x, double y, double yaw_rad = 0.0) {
  return {{"step_x", fmt::format("{}", x)},
          {"step_y", fmt::format("{}", y)},
          {"step_z", "0"},
          {"step_rx", "0"},
          {"step_ry", "0"},
          {"step_rz", fmt::format("{}", yaw_rad)}};
}

// Numbered from 0, 0.1 s apart, measured unless a row says otherwise.
inline std::string motion_csv(const std::vector<Cells>& rows) {
  const std::vector<std::string> head = motion_head();
  std::string text = csv_line(head);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Cells cells = with({{"frame", std::to_string(i)},
                              {"source", fmt::format("{:06}.pcd", i)},
                              {"stamp_ns", std::to_string(100'000'000 * i)},
                              {"along_state", "measured"},
                              {"along_pl", "1"}},
                             rows[i]);
    std::vector<std::string> line;
    for (const std::string& name : head) {
      const auto cell = cells.find(name);
      line.push_back(cell == cells.end() ? "" : cell->second);
    }
    text += csv_line(line);
  }
  return text;
}

// As the simulator writes it: base in the road.
inline std::string pose_truth_csv(const std::vector<Cells>& rows) {
  const std::vector<std::string> head = {"frame", "stamp_ns", "x", "y", "z", "qx", "qy", "qz", "qw"};
  std::string text = csv_line(head);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string> line = {std::to_string(i), std::to_string(100'000'000 * i)};
    for (std::size_t k = 2; k < head.size(); ++k) {
      const auto cell = rows[i].find(head[k]);
      line.push_back(cell == rows[i].end() ? "" : cell->second);
    }
    text += csv_line(line);
  }
  return text;
}

}  // namespace pose_wall::tools::test
