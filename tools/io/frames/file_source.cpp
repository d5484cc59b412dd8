// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/file_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <exception>
#include <set>
#include <string>

#include "io/frames/bare_layout_guess.hpp"
#include "io/frames/file_content.hpp"
#include "io/frames/text_points.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kLookedAtMax = 8;  // files without a header

}  // namespace

FileSource::FileSource(const std::vector<std::filesystem::path>& files, std::optional<BareLayout> points)
    : bare_{std::move(points), std::nullopt, std::nullopt} {
  append(files);
}

void FileSource::append(const std::vector<std::filesystem::path>& files) {
  files_.insert(files_.end(), files.begin(), files.end());
  for (const std::filesystem::path& file : files) names_.add(file);
}

void FileSource::choose_layout() {
  std::size_t looked_at = 0;
  for (const std::filesystem::path& file : files_) {
    if (looked_at == kLookedAtMax || !note_.empty()) return;
    if (!bare_.given && has_text_ending(file)) {
      ++looked_at;
      look_at_text(file);
    }
    if (!bare_.given && !has_bare_ending(file)) continue;
    const FileContent content = content_of(beginning_of(file));
    if (bare_.given && content == FileContent::kText) uses_points_ = true;
    if (content != FileContent::kUnknown) continue;
    ++looked_at;
    look_at_bare(file);
  }
}

void FileSource::look_at_bare(const std::filesystem::path& file) {
  if (bare_.given) {
    uses_points_ = true;
    note_ = say("{}: there is no header; read as {}, as --layout says", file.string(), bare_layout_words(*bare_.given));
    return;
  }
  try {
    const BareGuess guess = guess_bare_layout(read_frame_bytes(file));
    if (!guess.is_clear) return;
    bare_.of_others = guess.possible.front();
    note_ = say("{}: there is no header; by its values read as {}. --layout says otherwise", file.string(),
                bare_layout_words(*bare_.of_others));
  } catch (const FrameError&) {  // its own frame says why
  }
}

void FileSource::look_at_text(const std::filesystem::path& file) {
  try {
    if (content_of(beginning_of(file)) != FileContent::kText) return;
    bare_.text_of_others = text_layout_shown(read_frame_bytes(file));
    if (!bare_.text_of_others) return;
    std::string names;
    for (const char letter : bare_.text_of_others->columns) names += " " + std::string(bare_column_name(letter));
    note_ =
        say("{}: no line names the columns; by their values read as{}. --layout says otherwise", file.string(), names);
  } catch (const FrameError&) {  // its own frame says why
  }
}

std::optional<SourcedFrame> FileSource::next() {
  if (next_ == files_.size()) return std::nullopt;
  const std::filesystem::path& file = files_[next_++];
  SourcedFrame sourced;
  sourced.name = file.string();
  sourced.stamp_ns = names_.of(file);
  try {
    sourced.frame = load_frame(file, bare_);
    if (!sourced.stamp_ns) sourced.stamp_ns = sourced.frame->stamp_ns;
  } catch (const std::exception& error) {
    sourced.error = error.what();
  }
  return sourced;
}

SourceAbout FileSource::about() const {
  std::set<std::string> endings;
  for (const std::filesystem::path& file : files_) endings.insert(file.extension().string());
  std::string kind = say("frame files ({})", fmt::format("{}", fmt::join(endings, " ")));
  if (bare_.given || bare_.of_others) kind += ", " + bare_layout_words(bare_.given ? *bare_.given : *bare_.of_others);
  return {std::move(kind), {}, ""};
}

}  // namespace pose_wall::tools
