// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace pose_wall::tools {

// Binary PCD with the fields x y z intensity, four native floats per point, as one row; there whole or not at all.
// The stamp is a comment, "# stamp_ns N", which others pass over and read_pcd() does not. Throws std::runtime_error
// that names the file.
void write_pcd_binary(const std::filesystem::path& file, const float* xyz_intensity, std::size_t count,
                      std::int64_t stamp_ns);

// The same with the fields t (uint32, nanoseconds from the stamp on) and ring (uint16), as drivers name them.
void write_timed_pcd_binary(const std::filesystem::path& file, const float* xyz_intensity, const std::uint32_t* time_ns,
                            const std::uint16_t* ring, std::size_t count, std::int64_t stamp_ns);

}  // namespace pose_wall::tools
