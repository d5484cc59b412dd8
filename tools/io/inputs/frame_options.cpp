// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/inputs/frame_options.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "io/config_file/config_place.hpp"
#include "io/terminal/shell_word.hpp"

namespace pose_wall::tools {
namespace {

void append(std::string* words, const std::string& word) {
  if (!words->empty()) *words += ' ';
  *words += shell_word(word);
}

void append(std::string* words, const char* option, const std::string& value) {
  if (value.empty()) return;
  append(words, option);
  append(words, value);
}

}  // namespace

LoadedConfig FrameOptions::load() const {
  LoadedConfig loaded = load_config(config_file, settings);
  tell_notes(loaded, quiet);
  return loaded;
}

FrameSequence FrameOptions::open() const {
  FrameSequence sequence(inputs, input);
  for (const std::string& note : sequence.notes()) {
    if (!quiet) fmt::print(stderr, "{}\n", note);
  }
  return sequence;
}

std::vector<std::filesystem::path> FrameOptions::files_read(const FrameSequence& sequence) const {
  std::vector<std::filesystem::path> files = sequence.files();
  for (const ConfigPlace& place : find_configs(config_file)) files.emplace_back(place.file);
  if (!input.packets.metadata.empty()) files.emplace_back(input.packets.metadata);
  return files;
}

std::string FrameOptions::shell_words() const {
  std::string words;
  append(&words, "-c", config_file);
  for (const std::string& setting : settings) append(&words, "-s", setting);
  append(&words, "--topic", input.topic);
  append(&words, "--source", input.source);
  append(&words, "--sensor", input.packets.sensor);
  append(&words, "--metadata", input.packets.metadata);
  append(&words, "--layout", input.layout);
  append(&words, "--unit", input.unit);
  if (rate_hz != kRateDefault_hz) append(&words, "--rate", fmt::format("{:g}", rate_hz));
  for (const std::string& word : inputs) append(&words, word);
  return words;
}

}  // namespace pose_wall::tools
