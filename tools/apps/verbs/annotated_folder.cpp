// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/verbs/annotated_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <system_error>

#include "io/frames/load_frame.hpp"
#include "io/frames/whole_file.hpp"
#include "io/outputs/output_folder.hpp"

namespace pose_wall::tools {
namespace {

namespace fs = std::filesystem;

bool is_same(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b.empty() ? fs::path(".") : b, ignored);
}

// Its head ends within the first lines, whose only long word is a file name.
std::string beginning_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(200, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

}  // namespace

AnnotatedFolder::AnnotatedFolder(const std::string& folder, CloudFormat format, const std::vector<std::string>& inputs)
    : folder_(folder), format_(format) {
  for (const std::string& input : inputs) {
    if (!is_same(folder_, input) && !is_same(folder_, fs::path(input).parent_path())) continue;
    throw std::invalid_argument(
        fmt::format("--annotate {}: the inputs are in it; choose another folder, it is made if need be", folder));
  }
  make_output_folder(folder, "--annotate");
  take_away_earlier();
}

void AnnotatedFolder::take_away_earlier() const {
  std::vector<fs::path> earlier;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    if (!has_frame_ending(entry.path())) continue;
    if (!is_annotated_cloud(beginning_of(entry.path()))) {
      throw std::invalid_argument(
          fmt::format("--annotate {}: {} in it was not annotated by pose_wall; choose another folder, it is made if "
                      "need be",
                      folder_.string(), entry.path().filename().string()));
    }
    earlier.push_back(entry.path());
  }
  for (const fs::path& file : earlier) fs::remove(file);
}

void AnnotatedFolder::look(const pose_wall_points& points, const pose_wall_result& result) {
  points_ = annotated_points(points, result);
}

void AnnotatedFolder::write(const FrameOutcome& outcome) {
  if (!outcome.result) return;
  const std::string comment =
      fmt::format("frame {} stamp_ns {} source {}", outcome.frame, outcome.stamp_ns, outcome.source);
  const char* const ending = format_ == CloudFormat::kPcd ? "pcd" : "ply";
  write_whole_file(folder_ / fmt::format("{:06}.{}", outcome.frame, ending),
                   annotated_cloud(points_, format_, comment));
  ++written_;
}

}  // namespace pose_wall::tools
