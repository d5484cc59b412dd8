// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The contract of contract.hpp as expectations.

#pragma once

#include <gtest/gtest.h>

#include "support/contract.hpp"

namespace pose_wall::test {

inline void expect_promises(const pose_wall_result& r, const pose_wall_config& config, const char* what) {
  EXPECT_EQ(broken_contract(r, limits_of(config)), "") << what;
}

}  // namespace pose_wall::test
