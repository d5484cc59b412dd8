// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: readers never see a value that was put together from two, never an older one after a newer one, and nothing
// before the first; with one writer and several readers at full speed.

#include "runtime/latest_value.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace pose_wall::runtime {
namespace {

struct Value {
  std::uint64_t word[200];
};

Value all(std::uint64_t number) {
  Value v;
  for (std::uint64_t& word : v.word) word = number;
  return v;
}

TEST(LatestValue, NothingBeforeTheFirst) {
  const auto latest = std::make_unique<LatestValue<Value>>();
  Value v = all(7);
  EXPECT_FALSE(latest->load(&v));
  EXPECT_EQ(v.word[0], 7U);
  latest->store(all(1));
  EXPECT_TRUE(latest->load(&v));
  EXPECT_EQ(v.word[199], 1U);
  latest->clear();
  EXPECT_FALSE(latest->load(&v));
}

template <typename Latest>
void expect_never_torn_never_older() {
  constexpr std::uint64_t kValues = 20000;
  const auto latest = std::make_unique<Latest>();
  latest->store(all(1));
  std::atomic<std::uint64_t> torn{0}, older{0};
  const auto read = [&] {
    std::uint64_t last = 0;
    while (last < kValues) {
      Value v = all(0);
      if (!latest->load(&v)) continue;
      for (const std::uint64_t word : v.word) torn += word != v.word[0] ? 1 : 0;
      older += v.word[0] < last ? 1 : 0;
      last = v.word[0];
    }
  };
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) readers.emplace_back(read);
  for (std::uint64_t i = 2; i <= kValues; ++i) latest->store(all(i));
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(older, 0U);
}

TEST(LatestValue, NeverTornNeverOlder) {
  expect_never_torn_never_older<LatestValue<Value>>();
}

// With one cell readers and writer meet all the time: the cell's own lock is what is tested.
TEST(LatestValue, NeverTornInOneCell) {
  expect_never_torn_never_older<LatestValue<Value, 1>>();
}

}  // namespace
}  // namespace pose_wall::runtime
