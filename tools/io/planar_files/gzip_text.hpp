// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The text of a file that may be packed by gzip. The first bytes decide, not the name.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace pose_wall::tools {

// Of a log when unpacked: the largest public one has 0.2 GB.
inline constexpr std::uint64_t kUnpackedBytesMax = std::uint64_t{2} << 30U;

// Throws FrameError, without the file's name, for a file that cannot be read, a damaged or cut-off archive, and more
// than bytes_max.
std::string read_text_or_gzip(const std::filesystem::path& file, std::uint64_t bytes_max = kUnpackedBytesMax);

}  // namespace pose_wall::tools
