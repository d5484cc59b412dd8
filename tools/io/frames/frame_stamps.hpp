// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// When each frame of a recording was taken.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace pose_wall::tools {

// Stamps by the names of a recording's files: formats of single frames have none. A name (without ending) is a stamp
// where it is digits and nothing else: 13 are milliseconds since 1970, 16 microseconds, 17 to 19 nanoseconds; a number
// padded with zeros is one in nanoseconds from 17 digits on. So are 10 digits, a point, and digits: seconds since 1970
// with a fraction, or with nanoseconds that are not padded. Which of them, all names tell together. Other names give
// none, as do calendar dates.
class NameStamps {
 public:
  void add(const std::filesystem::path& path);
  std::optional<std::int64_t> of(const std::filesystem::path& path) const;

 private:
  bool are_unpadded() const;

  std::size_t shortest_ = 0, longest_ = 0;  // fraction behind the point, digits
  bool begins_with_zero_ = false, ends_with_zero_ = false;
};

// Of one name alone.
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
