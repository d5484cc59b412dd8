// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frames/file_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <exception>
#include <set>
#include <string>

#include "frames/frame_stamps.hpp"
#include "frames/load_frame.hpp"

namespace pose_wall::tools {

std::optional<SourcedFrame> FileSource::next() {
  if (next_ == files_.size()) return std::nullopt;
  const std::filesystem::path& file = files_[next_++];
  SourcedFrame sourced;
  sourced.name = file.string();
  sourced.stamp_ns = stamp_from_name(file);
  try {
    sourced.frame = load_frame(file);
    if (!sourced.stamp_ns) sourced.stamp_ns = sourced.frame->stamp_ns;
  } catch (const std::exception& error) {
    sourced.error = error.what();
  }
  return sourced;
}

SourceAbout FileSource::about() const {
  std::set<std::string> endings;
  for (const std::filesystem::path& file : files_) endings.insert(file.extension().string());
  return {fmt::format("frame files ({})", fmt::join(endings, " ")), {}, ""};
}

}  // namespace pose_wall::tools
