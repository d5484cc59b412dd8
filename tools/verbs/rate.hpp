// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// --rate of the verbs that read frames.

#pragma once

#include <string>

namespace pose_wall::tools {

// What is wrong with the word; empty for a rate that is allowed. Accepts what is inside, so that "nan" is refused.
std::string rate_fault(const std::string& word);

}  // namespace pose_wall::tools
