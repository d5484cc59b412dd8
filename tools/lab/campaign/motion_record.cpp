// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/motion_record.hpp"

#include "lab/campaign/record_file.hpp"
#include "study/motion/motion_rows.hpp"

namespace pose_wall::tools::campaign {
namespace {

// Base in the road, and the road's direction there.
const std::vector<std::string> kTruthColumns = {"true_x",  "true_y",  "true_z",      "true_qx",    "true_qy",
                                                "true_qz", "true_qw", "true_road_x", "true_road_y"};

double true_number(const CsvTable& table, std::size_t row, std::size_t which) {
  return table.number(row, demanded_column(table, "record", kTruthColumns[which]));
}

void add_truth(const CsvTable& table, std::size_t row, PoseTruth* truth) {
  const auto number = [&](std::size_t which) { return true_number(table, row, which); };
  const std::optional<Eigen::Quaterniond> R = unit_quaternion(number(3), number(4), number(5), number(6));
  if (!R) throw CsvError(fmt::format("line {}: true_qx to true_qw have not the length 1", table.line(row)));
  truth->T_world_base.emplace_back(Eigen::Translation3d(number(0), number(1), number(2)) * *R);
  truth->along_world.emplace_back(number(7), number(8), 0.0);
}

}  // namespace

std::vector<std::string> motion_record_head() {
  std::vector<std::string> head = run_head();
  for (const std::vector<std::string>& part : {motion_head(), kTruthColumns}) {
    head.insert(head.end(), part.begin(), part.end());
  }
  return head;
}

std::vector<std::string> motion_record_cells(const Run& run, const MotionOutcome& outcome,
                                             const sim::Simulator& simulator, std::uint32_t frame) {
  std::vector<std::string> cells = run_cells(run);
  const std::vector<std::string> measured = motion_cells(outcome);
  cells.insert(cells.end(), measured.begin(), measured.end());
  const sim::MachinePose pose = simulator.pose(frame);
  const sim::Placement placement = sim::place(simulator.setup(), pose);
  const Eigen::Quaterniond q(placement.R_road_base);
  const sim::Vector& p = placement.origin_road;
  const sim::Vector along = sim::CentreLine(simulator.setup().road.curve_radius_m).tangent(pose.along_m);
  for (const double number : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), along.x(), along.y()}) {
    cells.push_back(csv_number(number));
  }
  return cells;
}

MotionRecord motion_record_of(const CsvTable& table) {
  MotionRecord record;
  record.run = run_of(table);
  record.run.frames = static_cast<std::uint32_t>(table.rows());
  record.table = read_motion_table(table);
  record.truth.world_is_road = true;
  record.truth.keys = record.table.keys;
  const std::size_t contrast = demanded_column(table, "record", "contrast");
  const std::size_t patches = demanded_column(table, "record", "patches");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    add_truth(table, row, &record.truth);
    record.contrast.push_back(table.number(row, contrast));
    record.patches.push_back(table.number(row, patches));
  }
  return record;
}

}  // namespace pose_wall::tools::campaign
