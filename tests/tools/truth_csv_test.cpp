// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: truth.csv gives back every number to nine digits, with poses and without; what it lacks is named.
// named.

#include "io/csv/truth_csv.hpp"
#include "support/said_by.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using test::contains;
using test::TempFolder;

// Of numbers below 10, as csv_number writes them.
constexpr double kNineDigits = 1e-8;

std::vector<TruthRow> two_rows() {
  std::vector<TruthRow> rows(2);
  rows[1].frame = 1;
  rows[1].stamp_ns = 1'234'567'890'123'456'789;
  rows[0].value = {0.1, -0.2, 1.0 / 3.0, 2.5, 2.5, kNoTruth, kNoTruth};
  return rows;
}

void expect_same(const std::vector<TruthRow>& read, const std::vector<TruthRow>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].frame, written[i].frame);
    EXPECT_EQ(read[i].stamp_ns, written[i].stamp_ns);
    ASSERT_EQ(read[i].pose.has_value(), written[i].pose.has_value());
    for (std::size_t k = 0; read[i].pose && k < kPoseNumbers; ++k) {
      EXPECT_NEAR((*read[i].pose)[k], (*written[i].pose)[k], kNineDigits);
    }
    for (std::size_t q = 0; q < kTruthQuantities; ++q) {
      if (std::isnan(written[i].value[q])) {
        EXPECT_TRUE(std::isnan(read[i].value[q])) << q;
      } else {
        EXPECT_NEAR(read[i].value[q], written[i].value[q], kNineDigits) << q;
      }
    }
  }
}

TEST(TruthCsv, GivesBackWhatWasWritten) {
  const TempFolder folder;
  std::vector<TruthRow> rows = two_rows();
  write_truth_csv(folder.file("a.csv"), rows);
  expect_same(read_truth_csv(folder.file("a.csv")), rows);
  rows[0].pose = BasePose{0.0, -1.0, 1.4, 0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)};
  rows[1].pose = BasePose{0.1, -1.0, 1.0 / 3.0, 0.0, 0.0, 0.0, 1.0};
  write_truth_csv(folder.file("b.csv"), rows);
  expect_same(read_truth_csv(folder.file("b.csv")), rows);
}

TEST(TruthCsv, HalfAPoseIsRefusedByTheColumnThatIsMissing) {
  const TempFolder folder;
  const std::string file = folder.write("a.csv",
                                        "frame,stamp_ns,roll,pitch,yaw,d_lf,d_lb,d_rf,d_rb,x,y,z,qx,qy,qz\n"
                                        "0,0,0,0,0,1,1,1,1,0,0,0,0,0,0\n");
  const std::string why = test::said_by<std::runtime_error>([&] { read_truth_csv(file); });
  EXPECT_TRUE(contains(why, "a.csv: no column 'qw'")) << why;
}

}  // namespace
}  // namespace pose_wall::tools
