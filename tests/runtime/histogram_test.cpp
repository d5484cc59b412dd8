// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every time lies in the bucket whose edges enclose it, quantiles are those of the sorted times rounded up by
// at most 1/32, the worst is exact.

#include "runtime/histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace pose_wall::runtime {
namespace {

TEST(Histogram, BucketsEncloseTheirTimes) {
  std::vector<std::uint64_t> times;
  for (std::uint64_t t = 0; t < 5000; ++t) times.push_back(t);
  for (int bit = 12; bit < 41; ++bit) {
    for (const std::uint64_t off : {0ULL, 1ULL, 12345ULL}) {
      times.push_back((1ULL << bit) + off);
      times.push_back((1ULL << bit) - 1 - off % 4096);
    }
  }
  for (const std::uint64_t t : times) {
    const std::uint32_t bucket = Histogram::bucket_of(t);
    ASSERT_LT(bucket, Histogram::kBuckets);
    EXPECT_LE(t, Histogram::upper_edge(bucket)) << t;
    if (bucket > 0) {
      EXPECT_GT(t, Histogram::upper_edge(bucket - 1)) << t;
    }
    EXPECT_LE(Histogram::upper_edge(bucket), t + t / 32) << t;
  }
  EXPECT_EQ(Histogram::bucket_of(~0ULL), Histogram::kBuckets - 1);
}

TEST(Histogram, QuantilesAreThoseOfTheSortedTimes) {
  std::mt19937_64 random(1);
  for (const std::size_t count : {1U, 2U, 10U, 999U, 1000U, 1001U, 20000U}) {
    const auto histogram = std::make_unique<Histogram>();
    std::vector<std::int64_t> times;
    for (std::size_t i = 0; i < count; ++i) {
      times.push_back(static_cast<std::int64_t>(random() >> (24 + random() % 40)));
      histogram->add(times.back());
    }
    std::sort(times.begin(), times.end());
    const pose_wall_runtime_times t = histogram->times();
    const auto expect = [&](std::int64_t got, std::size_t thousandths) {
      const std::int64_t exact = times[(count * thousandths + 999) / 1000 - 1];
      EXPECT_GE(got, exact) << thousandths << " of " << count;
      EXPECT_LE(got, exact + exact / 32) << thousandths << " of " << count;
    };
    expect(t.p50_ns, 500);
    expect(t.p99_ns, 990);
    expect(t.p999_ns, 999);
    EXPECT_EQ(t.worst_ns, times.back());
    EXPECT_EQ(t.count, count);
  }
}

TEST(Histogram, EmptyAndBackwards) {
  const auto histogram = std::make_unique<Histogram>();
  EXPECT_EQ(histogram->times().count, 0U);
  EXPECT_EQ(histogram->times().p999_ns, 0);
  histogram->add(-5);  // a clock of the caller's that went back
  EXPECT_EQ(histogram->times().count, 1U);
  EXPECT_EQ(histogram->times().worst_ns, 0);
}

}  // namespace
}  // namespace pose_wall::runtime
