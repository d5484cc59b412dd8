// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the list keeps the best that differ, in order, and a near-copy never takes a second place.

#include "base/estimation/shortlist.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pose_wall {
namespace {

// Planes named by their d; alike within 1.
Hypothesis at(double d, double cost) {
  Hypothesis h;
  h.plane.d = d;
  h.cost = cost;
  return h;
}
bool alike(const Plane& a, const Plane& b) {
  return std::fabs(a.d - b.d) <= 1.0;
}

TEST(Shortlist, KeepsTheBestInOrder) {
  Shortlist<3> list;
  for (const double d : {50.0, 10.0, 40.0, 20.0, 30.0}) list.offer(at(d, d), alike);
  ASSERT_EQ(list.count(), 3U);
  EXPECT_EQ(list[0].plane.d, 10.0);
  EXPECT_EQ(list[1].plane.d, 20.0);
  EXPECT_EQ(list[2].plane.d, 30.0);
}

TEST(Shortlist, AWorseCopyIsNoNews) {
  Shortlist<3> list;
  list.offer(at(10, 1), alike);
  list.offer(at(10.5, 2), alike);
  list.offer(at(10.5, 1), alike);
  ASSERT_EQ(list.count(), 1U);
  EXPECT_EQ(list[0].plane.d, 10.0);
}

TEST(Shortlist, ABetterOneReplacesAllItsCopies) {
  Shortlist<4> list;
  list.offer(at(10.0, 5), alike);
  list.offer(at(11.5, 6), alike);
  list.offer(at(99.0, 7), alike);
  list.offer(at(10.8, 1), alike);
  ASSERT_EQ(list.count(), 2U);
  EXPECT_EQ(list[0].plane.d, 10.8);
  EXPECT_EQ(list[1].plane.d, 99.0);
}

TEST(Shortlist, WhenFullTheWorstGoesOrTheNewOneIsRefused) {
  Shortlist<2> list;
  list.offer(at(10, 1), alike);
  list.offer(at(20, 2), alike);
  list.offer(at(30, 3), alike);
  EXPECT_EQ(list[1].plane.d, 20.0);
  list.offer(at(40, 1.5), alike);
  EXPECT_EQ(list[1].plane.d, 40.0);
  EXPECT_EQ(list.count(), 2U);
  list.clear();
  EXPECT_EQ(list.count(), 0U);
}

TEST(Shortlist, TellsWhatItWouldNotTake) {
  Shortlist<2> list;
  EXPECT_GT(list.too_much(), 1e9) << "there is room";
  list.offer(at(10, 1), alike);
  EXPECT_GT(list.too_much(), 1e9) << "there is room";
  list.offer(at(20, 5), alike);
  EXPECT_EQ(list.too_much(), 5.0);
  list.offer(at(30, 5), alike);
  EXPECT_EQ(list[1].plane.d, 20.0) << "as dear is too dear";
  list.offer(at(30, 4), alike);
  EXPECT_EQ(list[1].plane.d, 30.0);
  EXPECT_EQ(list.too_much(), 4.0);
  list.clear();
  EXPECT_GT(list.too_much(), 1e9);
}

}  // namespace
}  // namespace pose_wall
