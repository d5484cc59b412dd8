// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/input_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <system_error>

#include "io/frames/file_content.hpp"
#include "io/frames/frame_stamps.hpp"
#include "io/frames/load_frame.hpp"
#include "io/frames/natural_order.hpp"
#include "io/frames/text_points.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

namespace fs = std::filesystem;

// What is no frame and has many.
constexpr std::array<std::string_view, 5> kRecordingEndings = {".pcap", ".pcapng", ".bag", ".mcap", ".db3"};

// Fractions of seconds of unequal length are in no natural order: 0.5 comes behind 0.25.
void sort_by_stamps(std::vector<fs::path>* files) {
  NameStamps names;
  for (const fs::path& file : *files) names.add(file);
  const auto has_stamp = [&names](const fs::path& file) { return names.of(file).has_value(); };
  if (!std::all_of(files->begin(), files->end(), has_stamp)) return;
  std::stable_sort(files->begin(), files->end(),
                   [&names](const fs::path& a, const fs::path& b) { return *names.of(a) < *names.of(b); });
}

// Whatever is called like a frame and is no folder: load_frame says of a link that leads nowhere what is wrong with it.
std::vector<fs::path> frames_in(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> files, texts;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::error_code ignored;
    if (entry.is_directory(ignored)) continue;
    if (has_frame_ending(entry.path())) files.push_back(entry.path());
    if (has_text_ending(entry.path())) texts.push_back(entry.path());
  }
  // Tables beside a folder of frames tell of these.
  std::error_code none;
  if (files.empty() && !fs::is_directory(folder / "frames", none)) {
    std::copy_if(texts.begin(), texts.end(), std::back_inserter(files),
                 [](const fs::path& file) { return begins_like_points(beginning_of(file)); });
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return natural_less(a.native(), b.native()); });
  sort_by_stamps(&files);
  return files;
}

// The first two names whose order is another than that of their bytes; empty where there are none.
std::string order_note(const fs::path& folder, const std::vector<fs::path>& files) {
  for (std::size_t i = 1; i < files.size(); ++i) {
    if (files[i - 1].native() < files[i].native()) continue;
    return say("{}: read by the numbers in the names: {} before {}", folder.string(), files[i - 1].filename().string(),
               files[i].filename().string());
  }
  return "";
}

std::vector<std::string> recordings_in(const fs::path& folder) {
  std::error_code ignored;
  std::vector<std::string> recordings;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const fs::path ending = entry.path().extension();
    if (std::find(kRecordingEndings.begin(), kRecordingEndings.end(), ending) == kRecordingEndings.end()) continue;
    recordings.push_back(entry.path().string());
  }
  std::sort(recordings.begin(), recordings.end());
  return recordings;
}

// What is likely meant by a folder without frames: the folder of frames in it, as `sim` makes it, or a recording.
std::string what_is_meant(const fs::path& folder) {
  std::error_code ignored;
  const fs::path inner = folder / "frames";
  if (!frames_in(inner, ignored).empty()) return say("; did you mean '{}'?", inner.string());
  const std::vector<std::string> recordings = recordings_in(folder);
  return recordings.empty() ? "" : say("; bags and captures are named themselves: {}", recordings.front());
}

void add_folder(const fs::path& folder, FrameInputs& inputs) {
  std::error_code error;
  const std::vector<fs::path> files = frames_in(folder, error);
  if (error) {
    inputs.errors.push_back(fmt::format("{}: {}", folder.string(), error.message()));
    return;
  }
  if (files.empty()) {
    inputs.errors.push_back(say("{}: no frame in this folder; files ending in {} are looked for{}", folder.string(),
                                frame_endings_text(), what_is_meant(folder)));
  }
  const std::string note = order_note(folder, files);
  if (!note.empty()) inputs.notes.push_back(note);
  const std::vector<std::string> recordings = recordings_in(folder);
  if (!files.empty() && !recordings.empty()) {
    inputs.notes.push_back(say("{}: its frame files are read; bags and captures are named themselves: {}",
                               folder.string(), fmt::format("{}", fmt::join(recordings, ", "))));
  }
  inputs.files.insert(inputs.files.end(), files.begin(), files.end());
}

}  // namespace

FrameInputs collect_inputs(const std::vector<std::string>& arguments) {
  FrameInputs inputs;
  for (const std::string& argument : arguments) {
    std::error_code ignored;
    if (fs::is_directory(argument, ignored)) {
      add_folder(argument, inputs);
    } else {
      inputs.files.emplace_back(argument);
    }
  }
  return inputs;
}

}  // namespace pose_wall::tools
