// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Frame files, one frame each.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/frames/bare_points.hpp"
#include "io/frames/frame_source.hpp"
#include "io/frames/frame_stamps.hpp"
#include "io/frames/load_frame.hpp"

namespace pose_wall::tools {

class FileSource : public FrameSource {
 public:
  // `points`: how points without a header are read, where the user says.
  explicit FileSource(const std::vector<std::filesystem::path>& files, std::optional<BareLayout> points = std::nullopt);

  // More files behind those there are.
  void append(const std::vector<std::filesystem::path>& files);

  // Looks into files without a header until one shows its layout: the others that do not show theirs are read so, too.
  // Once, before the first frame.
  void choose_layout();

  // How points without a header are read, for a person; empty where no file needs it.
  std::string note() const override { return note_; }

  // Whether a file was seen that `points` goes for.
  bool uses_points() const { return uses_points_; }

  std::optional<SourcedFrame> next() override;
  std::size_t frames() const override { return files_.size(); }
  SourceAbout about() const override;

 private:
  void look_at_bare(const std::filesystem::path& file);
  void look_at_text(const std::filesystem::path& file);

  std::vector<std::filesystem::path> files_;
  NameStamps names_;
  BareChoice bare_;
  std::string note_;
  bool uses_points_ = false;
  std::size_t next_ = 0;
};

}  // namespace pose_wall::tools
