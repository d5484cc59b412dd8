// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/fingerprint.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "pose_wall.h"

namespace pose_wall::tools::campaign {

std::uint64_t fingerprint(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char letter : text) {
    hash ^= static_cast<unsigned char>(letter);
    hash *= 0x100000001b3U;
  }
  return hash;
}

std::string fingerprint_text(std::uint64_t number) {
  return fmt::format("{:016x}", number);
}

std::string program_fingerprint() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(program), std::istreambuf_iterator<char>()};
  return fingerprint_text(fingerprint(bytes.empty() ? std::string(pose_wall_version()) : bytes));
}

}  // namespace pose_wall::tools::campaign
