// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: readers never see a value that was put together from two, never an older one after a newer one, and nothing
// before the first, with one writer and several readers at full speed; and none in which a bit fell over.

#include "runtime/latest_value.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
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
  EXPECT_EQ(latest->load(&v), LatestStatus::kNothing);
  EXPECT_EQ(v.word[0], 7U);
  latest->store(all(1));
  EXPECT_EQ(latest->load(&v), LatestStatus::kThere);
  EXPECT_EQ(v.word[199], 1U);
  latest->clear();
  EXPECT_EQ(latest->load(&v), LatestStatus::kNothing);
}

// The newest cell is found by what it holds, and every bit of it is turned once.
TEST(LatestValue, NoBitFallsOverUnnoticed) {
  using Latest = LatestValue<Value>;
  const auto latest = std::make_unique<Latest>();
  Value given{}, v{};
  for (std::uint64_t i = 0; i < 200; ++i) given.word[i] = 0x5555000000000000 + i;
  latest->store(given);
  auto* const bytes = reinterpret_cast<unsigned char*>(latest.get());
  std::size_t at = 0;
  while (at + sizeof given <= sizeof(Latest) && std::memcmp(bytes + at, &given, sizeof given) != 0) at += 8;
  ASSERT_LE(at + sizeof given, sizeof(Latest));
  for (std::size_t bit = 0; bit < sizeof given * 8; ++bit) {
    bytes[at + bit / 8] ^= static_cast<unsigned char>(1U << bit % 8);
    ASSERT_EQ(latest->load(&v), LatestStatus::kDamaged) << bit;
    bytes[at + bit / 8] ^= static_cast<unsigned char>(1U << bit % 8);
  }
  ASSERT_EQ(latest->load(&v), LatestStatus::kThere);
  latest->store(all(2));
  EXPECT_EQ(latest->load(&v), LatestStatus::kThere);
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
      if (latest->load(&v) != LatestStatus::kThere) continue;
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
