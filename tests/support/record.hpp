// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A file in memory: what a black box's sink was given, each piece at its offset.

#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

namespace pose_wall::test {

using Record = std::vector<unsigned char>;

// A sink as the runtime takes it; its user is the Record.
inline std::int32_t write_record(void* user, std::uint64_t offset, const void* bytes, std::uint64_t count) {
  Record& record = *static_cast<Record*>(user);
  if (record.size() < offset + count) record.resize(offset + count);
  std::memcpy(record.data() + offset, bytes, count);
  return 0;
}

}  // namespace pose_wall::test
