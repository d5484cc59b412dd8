// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The checksum of zip files (reflected polynomial 0xEDB88320).

#pragma once

#include <cstdint>

#include "io/bags/byte_cursor.hpp"

namespace pose_wall::tools {

std::uint32_t crc32(ByteView bytes);

}  // namespace pose_wall::tools
