// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frames/frame_stamps.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace pose_wall::tools {

std::optional<std::int64_t> stamp_from_name(const std::filesystem::path& path) {
  const std::string name = path.stem().string();
  const bool digits = std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits || name.size() < 16) return std::nullopt;
  std::int64_t stamp_ns = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), stamp_ns);
  if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
  return stamp_ns;
}

double seconds_between(std::int64_t from_ns, std::int64_t to_ns) {
  std::int64_t step_ns = 0;
  if (!__builtin_sub_overflow(to_ns, from_ns, &step_ns)) return static_cast<double>(step_ns) * 1e-9;
  return static_cast<double>(to_ns) * 1e-9 - static_cast<double>(from_ns) * 1e-9;
}

std::int64_t FrameStamps::next(const std::optional<std::int64_t>& stamp_ns) {
  if (stamp_ns) {
    base_ns_ = *stamp_ns;
    frames_since_base_ = 1;
    return base_ns_;
  }
  return base_ns_ + std::llround(static_cast<double>(frames_since_base_++) * 1e9 / rate_hz_);
}

}  // namespace pose_wall::tools
