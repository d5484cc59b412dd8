// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: each sense holds at its limit and on its own side alone. NaN passes no gate. A test ratio is compared without
// a division, so that nothing allowed is no fault. Limits are compared in the value's own type where both are whole.

#include "base/gates/gate.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "base/gates/constant_row.hpp"
#include "base/gates/overrides.hpp"
#include "base/math/finite.hpp"

namespace pose_wall {
namespace gate_test {

enum Id : std::uint32_t { LEAST, MOST, OVER, UNDER, COUNTED, RATIO, ASKED, OF_SETTINGS, OF_CALLER };
struct Settings {
  double limit = 0.0;
};

}  // namespace gate_test

#define GATE(id, sense, limit) POSE_WALL_CONSTANT_GATE(gate_test::id, sense, limit)
GATE(LEAST, AT_LEAST, 2.0)
GATE(MOST, AT_MOST, 2.0)
GATE(OVER, ABOVE, 2.0)
GATE(UNDER, BELOW, 2.0)
GATE(COUNTED, AT_LEAST, 60)
GATE(RATIO, ABOVE, 25.0)
#undef GATE
template <>
struct GateRow<gate_test::ASKED> {
  static constexpr GateSense sense = GateSense::IS_SO;
  static constexpr bool by_caller = false;
};
template <>
struct GateRow<gate_test::OF_SETTINGS> {
  static constexpr GateSense sense = GateSense::AT_MOST;
  static constexpr bool by_caller = false;
  static double limit(const gate_test::Settings& s) { return s.limit; }
};
template <>
struct GateRow<gate_test::OF_CALLER> {
  static constexpr GateSense sense = GateSense::AT_MOST;
  static constexpr bool by_caller = true;
};

namespace {

template <auto id>
int passes_of_three() {  // below, at and above the limit, as bits
  return (passes<id>(1.5) ? 1 : 0) | (passes<id>(2.0) ? 2 : 0) | (passes<id>(2.5) ? 4 : 0);
}

TEST(Gate, EachSenseHoldsOnItsOwnSide) {
  EXPECT_EQ(passes_of_three<gate_test::LEAST>(), 2 | 4);
  EXPECT_EQ(passes_of_three<gate_test::MOST>(), 1 | 2);
  EXPECT_EQ(passes_of_three<gate_test::OVER>(), 4);
  EXPECT_EQ(passes_of_three<gate_test::UNDER>(), 1);
}

TEST(Gate, NotANumberPassesNone) {
  EXPECT_FALSE(passes<gate_test::LEAST>(not_a_number()));
  EXPECT_FALSE(passes<gate_test::MOST>(not_a_number()));
  EXPECT_FALSE(passes<gate_test::OVER>(not_a_number()));
  EXPECT_FALSE(passes<gate_test::UNDER>(not_a_number()));
  EXPECT_FALSE(passes_of<gate_test::RATIO>(not_a_number(), 1.0));
  EXPECT_FALSE(passes_of<gate_test::RATIO>(1.0, not_a_number()));
}

TEST(Gate, ARatioIsOfWhatIsAllowed) {
  EXPECT_FALSE(passes_of<gate_test::RATIO>(50.0, 2.0));
  EXPECT_TRUE(passes_of<gate_test::RATIO>(50.001, 2.0));
  EXPECT_TRUE(passes_of<gate_test::RATIO>(1e-300, 0.0)) << "nothing is allowed, so anything is above it";
  EXPECT_FALSE(passes_of<gate_test::RATIO>(0.0, 0.0));
}

TEST(Gate, CountsAreComparedWhole) {
  EXPECT_FALSE(passes<gate_test::COUNTED>(std::uint32_t{59}));
  EXPECT_TRUE(passes<gate_test::COUNTED>(std::uint32_t{60}));
  EXPECT_TRUE(passes<gate_test::COUNTED>(std::uint32_t{0xFFFFFFFF}));
}

TEST(Gate, YesAndNo) {
  EXPECT_TRUE(passes<gate_test::ASKED>(true));
  EXPECT_FALSE(passes<gate_test::ASKED>(false));
}

TEST(Gate, TheLimitIsTheSettingsOrTheCallers) {
  EXPECT_TRUE(passes<gate_test::OF_SETTINGS>(3.0, gate_test::Settings{3.0}));
  EXPECT_FALSE(passes<gate_test::OF_SETTINGS>(3.5, gate_test::Settings{3.0}));
  EXPECT_TRUE(passes<gate_test::OF_CALLER>(3.0, 3.0));
  EXPECT_FALSE(passes<gate_test::OF_CALLER>(3.5, 3.0));
  EXPECT_EQ(limit_of<gate_test::OF_SETTINGS>(gate_test::Settings{7.0}), 7.0);
}

TEST(GateOverrides, StandInPlaceOfTheTableUntilTheyAreForgotten) {
  GateOverrides<3> overrides;
  EXPECT_EQ(overrides.limit_or(1, 5.0), 5.0);
  overrides.set(1, 7.0);
  overrides.let_pass(2);
  EXPECT_EQ(overrides.limit_or(1, 5.0), 7.0);
  EXPECT_EQ(overrides.limit_or(2, 5.0), 5.0);
  EXPECT_TRUE(overrides.lets_pass(2));
  EXPECT_FALSE(overrides.lets_pass(1));
  overrides.forget();
  EXPECT_EQ(overrides.limit_or(1, 5.0), 5.0);
  EXPECT_FALSE(overrides.lets_pass(2));
}

}  // namespace
}  // namespace pose_wall
