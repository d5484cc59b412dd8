// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the Stanford diagram counts each value in its region and draws what it counted. Does not prove: that it is
// good to look at.

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "io/picture/stanford_diagram.hpp"

namespace pose_wall::tools::picture {
namespace {

TEST(Stanford, CountsRegions) {
  StanfordCounts counts(angle_scale(1.0));
  counts.add(0.1, 0.2);   // within
  counts.add(0.2, 0.2);   // within: on the diagonal the promise holds
  counts.add(0.5, 2.0);   // too wide
  counts.add(1.5, 2.0);   // too wide, and it says so
  counts.add(0.3, 0.2);   // beyond
  counts.add(3.0, 2.0);   // beyond: but it does not claim to be good
  counts.add(1.1, 1.0);   // misleading if valid
  counts.add(50.0, 0.1);  // misleading if valid
  const StanfordCounts::Regions& r = counts.regions();
  EXPECT_EQ(r.within, 2U);
  EXPECT_EQ(r.too_wide, 2U);
  EXPECT_EQ(r.beyond_protection, 2U);
  EXPECT_EQ(r.misleading_if_valid, 2U);
}

TEST(Stanford, NumbersBeyondTheAxesCountAtTheirEnds) {
  StanfordCounts counts(distance_scale(0.1));
  const std::size_t last = StanfordCounts::kCells - 1;
  counts.add(0.0, 1000.0);
  EXPECT_EQ(counts.cell(0, last), 1U);
  counts.add(1000.0, 0.0);
  EXPECT_EQ(counts.cell(last, 0), 1U);
  counts.add(1000.0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(counts.cell(last, 0), 2U);
  EXPECT_EQ(counts.regions().misleading_if_valid, 2U);
  EXPECT_EQ(counts.largest_cell(), 2U);
}

TEST(Stanford, DrawsWhatItCounted) {
  StanfordCounts counts(distance_scale(0.1));
  const std::string empty = stanford_diagram(counts, "nothing");
  for (int i = 0; i < 7; ++i) counts.add(0.01, 0.03);
  counts.add(0.2, 0.03);
  const std::string svg = stanford_diagram(counts, "a title");
  EXPECT_EQ(svg.rfind("<svg", 0), 0U);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
  for (const char* words : {"a title", "7 (87.5 %)", "1 (12.5 %)", "within protection", "value > protection",
                            "misleading if valid", "alert limit 100 mm"}) {
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  }
  EXPECT_NE(svg, empty);
}

}  // namespace
}  // namespace pose_wall::tools::picture
