// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A number that stands for a text: two that differ give different numbers, but for a chance of 2^-64.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pose_wall::tools::campaign {

// FNV-1a, 64 bits.
std::uint64_t fingerprint(std::string_view text);

// 16 hexadecimal digits.
std::string fingerprint_text(std::uint64_t number);

// Of the file of the program that runs: any change of engine or simulator shows in it, whatever their version says.
// Where the system does not tell that file, the version is all there is.
std::string program_fingerprint();

}  // namespace pose_wall::tools::campaign
