// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// When each frame of a recording was taken.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace pose_wall::tools {

// Formats of single frames have no stamp. A file name (without ending) of 16 to 19 digits and nothing else is a stamp
// in nanoseconds; any other name gives none.
std::optional<std::int64_t> stamp_from_name(const std::filesystem::path& path);

// By whole nanoseconds, of which a double holds too few for stamps of the epoch; where a damaged stamp lies further off
// than they reach, by doubles.
double seconds_between(std::int64_t from_ns, std::int64_t to_ns);

// Stamps for a row of frames: a frame with a stamp keeps it, the others follow the last stamp (0 at the start) at the
// frame rate, counted from it so that no rounding adds up.
class FrameStamps {
 public:
  explicit FrameStamps(double rate_hz) : rate_hz_(rate_hz) {}

  std::int64_t next(const std::optional<std::int64_t>& stamp_ns);
  std::int64_t next(const std::filesystem::path& path) { return next(stamp_from_name(path)); }

 private:
  double rate_hz_;
  std::int64_t base_ns_ = 0;
  std::int64_t frames_since_base_ = 0;
};

}  // namespace pose_wall::tools
