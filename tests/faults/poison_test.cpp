// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: whichever frame of a good sequence is replaced by garbage of whichever kind, alone, with the next one, or
// with one of any kind a few good frames later, what is told meanwhile and while it comes back keeps to its levels and
// the contract, nothing valid is told of clouds that show no road, and the engine is back as promised: the frame after
// it is measured, and within kBackWithin frames all that was valid is valid. The machine moves. Does not prove:
// anything of clouds that are another road (undetectable_test.cpp).

#include "poisoned_run.hpp"

namespace pose_wall::test {
namespace {

class PoisonedSequence : public ::testing::TestWithParam<std::tuple<Poison, std::uint32_t>> {};

TEST_P(PoisonedSequence, IsNeverMisleadingAndComesBack) {
  const auto& [poison, in_a_row] = GetParam();
  for (std::uint32_t k = 1; k + in_a_row <= kFrames; ++k) {
    PoisonedRun run(k);
    for (std::uint32_t i = 0; i < in_a_row; ++i) run.poisoned(poison);
    run.good_until_back();
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, PoisonedSequence,
                         ::testing::Combine(::testing::ValuesIn(kPoisons), ::testing::Values(1U, 2U)),
                         [](const auto& test) {
                           return name_of(std::get<0>(test.param).name) +
                                  (std::get<1>(test.param) == 1 ? "_once" : "_twice");
                         });

// Wrong twice with good frames between, of two kinds: the second comes while the engine is on its way back from the
// first one, or just after. Every kind is followed by every other and by itself, after 1 to kBackWithin good frames by
// turns: 144 pairs in all. Where the first one stands goes round with the pair.
class PoisonedSequencePairs : public ::testing::TestWithParam<std::size_t> {};

TEST_P(PoisonedSequencePairs, AreNeverMisleadingAndComeBack) {
  const std::size_t kind = GetParam();
  for (std::size_t other = 0; other < std::size(kPoisons); ++other) {
    const int between = 1 + static_cast<int>((kind + other) % kBackWithin);
    const std::uint32_t last_begin = kFrames - 2 - static_cast<std::uint32_t>(between);
    const auto k = 1 + static_cast<std::uint32_t>(2 * kind + other) % last_begin;
    SCOPED_TRACE(std::string(kPoisons[other].name) + " after " + std::to_string(between) +
                 " good frames, first at frame " + std::to_string(k));
    PoisonedRun run(k);
    run.poisoned(kPoisons[kind]);
    for (int after = 1; after <= between; ++after) run.good(after);
    run.poisoned(kPoisons[other]);
    run.good_until_back();
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, PoisonedSequencePairs, ::testing::Range<std::size_t>(0, std::size(kPoisons)),
                         [](const auto& test) { return name_of(kPoisons[test.param].name) + "_and_another"; });

// Wrong again and again, each time another road than the time before: no jump confirms another.
TEST(PoisonedSequenceItself, IsNeverConfirmedByRoadsInTurns) {
  const Poison& larger = kPoisons[std::size(kPoisons) - 2];
  const Poison& smaller = kPoisons[std::size(kPoisons) - 1];
  for (std::uint32_t k = 1; k <= kFrames / 2; ++k) {
    PoisonedRun run(k);
    for (int turn = 0; turn <= kBackWithin; ++turn) run.poisoned(turn % 2 == 0 ? larger : smaller);
    run.good_until_back();
  }
}

TEST(PoisonedSequenceItself, IsGoodWithoutPoison) {
  for (const std::string& states : sequence().states) EXPECT_EQ(states, "VVVVVVV");
}

}  // namespace
}  // namespace pose_wall::test
