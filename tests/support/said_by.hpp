// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a call says that refuses.

#pragma once

#include <string>

namespace pose_wall::tools::test {

// The words of an exception of this type; "" where there is none. Another type is a fault of the test.
template <typename Error, typename Call>
std::string said_by(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace pose_wall::tools::test
