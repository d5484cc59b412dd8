// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A page's HTML with its style, its script and its data put in: one file that needs nothing but itself.

#pragma once

#include <string>

#include "study/report/assets.hpp"

namespace pose_wall::tools::report {

// data: JSON.
std::string filled_page(const Assets& parts, std::string data, const std::string& title);

}  // namespace pose_wall::tools::report
