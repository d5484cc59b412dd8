// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "verbs/frame_options.hpp"

#include <fmt/format.h>

#include <optional>

#include "frames/text_cursor.hpp"
#include "verbs/one_of.hpp"

namespace pose_wall::tools {
namespace {

// Accepts what is inside, so that "nan" is refused.
std::string rate_fault(const std::string& word) {
  const std::optional<double> rate_hz = parse_number<double>(word);
  if (rate_hz && *rate_hz >= 0.001 && *rate_hz <= 1e3) return "";
  return fmt::format("'{}' is refused; a number from 0.001 to 1000 is allowed", word);
}

}  // namespace

LoadedConfig FrameOptions::load() const {
  return load_config(config_file, settings);
}

FrameSequence FrameOptions::open() const {
  return FrameSequence(inputs, input);
}

std::vector<std::filesystem::path> FrameOptions::files_read(const FrameSequence& sequence) const {
  std::vector<std::filesystem::path> files = sequence.files();
  if (!config_file.empty()) files.emplace_back(config_file);
  if (!input.packets.metadata.empty()) files.emplace_back(input.packets.metadata);
  return files;
}

void add_input_options(CLI::App* verb, InputOptions* options) {
  verb->add_option("-t,--topic", options->topic, "Topic of a bag, where it has several with clouds")
      ->type_name("TOPIC");
  verb->add_option("--sensor", options->packets.sensor, "Sensor of packets, where they do not tell it themselves")
      ->check(one_of(sensor_names()))
      ->type_name("NAME");
  verb->add_option("--metadata", options->packets.metadata,
                   "What packets were recorded with: JSON of an Ouster (default: the capture's name, .json), angles of "
                   "a Hesai (CSV)")
      ->check(CLI::ExistingFile);
}

void add_frame_options(CLI::App* verb, FrameOptions* options) {
  verb->add_option("INPUT", options->inputs, kInputHelp)->required();
  add_input_options(verb, &options->input);
  verb->add_option("-c,--config", options->config_file, "Settings, as config/pose_wall.yaml; default: the defaults");
  verb->add_option("-s,--set", options->settings, "KEY=VALUE over the config; may be repeated")
      ->allow_extra_args(false);
  verb->add_option("-r,--rate", options->rate_hz, "Frames per second, for frames without stamps")
      ->capture_default_str()
      ->check(rate_fault, "0.001 to 1000");
  verb->add_flag("-q,--quiet", options->quiet, "Nothing on stderr but errors");
}

}  // namespace pose_wall::tools
