// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The bytes of a zip, without libzip: every one belongs to a member that the list at its end names, and each member has
// one name. Or else programs that read from the front, or repair, would unpack what nobody has checked.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pose_wall::tools::evidence {

// Names in the order of the list, as their bytes stand there. Throws std::runtime_error that says what is wrong: no
// zip, cut off, comments, bytes between members, before the first or behind the end, members that overlap or have two
// names.
std::vector<std::string> checked_layout(const std::filesystem::path& zip);

}  // namespace pose_wall::tools::evidence
