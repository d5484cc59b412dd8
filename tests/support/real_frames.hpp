// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Recorded frames of others, read where POSE_WALL_DATA says they lie, beside their reference.csv.

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "io/csv/csv_table.hpp"
#include "io/frames/load_frame.hpp"
#include "io/numbers/angles.hpp"
#include "support/engine_under_test.hpp"

namespace pose_wall::test {

using tools::kDegPerRad;
using tools::kRadPerDeg;

inline std::filesystem::path data_folder() {
  const char* folder = std::getenv("POSE_WALL_DATA");
  return folder != nullptr ? std::filesystem::path(folder) : std::filesystem::path();
}

// One recording's reference: column by name, row by frame number.
class Reference {
 public:
  explicit Reference(const std::filesystem::path& file) : table_(parse(file)) {
    const std::size_t frame = *table_.find_column("frame");
    for (std::size_t row = 0; row < table_.rows(); ++row) row_of_[std::lround(table_.number(row, frame))] = row;
  }
  double operator()(long frame, const char* column) const {
    return table_.number(row_of_.at(frame), table_.find_column(column).value());
  }

 private:
  static tools::CsvTable parse(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return tools::CsvTable::parse(stream);
  }
  tools::CsvTable table_;
  std::map<long, std::size_t> row_of_;
};

// Skips its cases where the recordings are not there.
class RealFrames : public ::testing::Test {
 protected:
  void SetUp() override {
    if (data_folder().empty()) GTEST_SKIP() << "POSE_WALL_DATA is not set: no recorded frames to test on";
    if (!std::filesystem::is_directory(data_folder())) {
      GTEST_SKIP() << "POSE_WALL_DATA: " << data_folder() << " is no folder";
    }
  }

  static pose_wall_result process(EngineUnderTest* engine, const std::filesystem::path& file, std::int64_t stamp_ns) {
    tools::Frame frame = tools::load_frame(data_folder() / file);
    frame.cloud.stamp_ns = stamp_ns;
    return engine->process(frame.cloud);
  }

  // A frame by itself: no memory of others.
  static pose_wall_result process_alone(const pose_wall_config& config, const std::filesystem::path& file) {
    EngineUnderTest engine(config);
    return process(&engine, file, 0);
  }
};

inline bool is_measured(const pose_wall_value& v) {
  return v.state == POSE_WALL_VALID || v.state == POSE_WALL_DEGRADED;
}

inline bool is_valid(const pose_wall_value& v) {
  return v.state == POSE_WALL_VALID;
}

}  // namespace pose_wall::test
