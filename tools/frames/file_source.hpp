// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Frame files, one frame each.

#pragma once

#include <filesystem>
#include <vector>

#include "frames/frame_source.hpp"

namespace pose_wall::tools {

class FileSource : public FrameSource {
 public:
  explicit FileSource(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}

  std::optional<SourcedFrame> next() override;
  std::size_t frames() const override { return files_.size(); }
  SourceAbout about() const override;

 private:
  std::vector<std::filesystem::path> files_;
  std::size_t next_ = 0;
};

}  // namespace pose_wall::tools
