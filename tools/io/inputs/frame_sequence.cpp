// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/inputs/frame_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/bags/bag_source.hpp"
#include "io/bags/rosbag2_folder.hpp"
#include "io/frames/input_list.hpp"
#include "io/frames/length_unit.hpp"
#include "io/language/language.hpp"
#include "io/packets/bag_packets.hpp"
#include "io/packets/packet_source.hpp"
#include "io/planar_files/planar_input.hpp"

namespace pose_wall::tools {

FrameSequence::FrameSequence(const std::vector<std::string>& arguments, const InputOptions& options)
    : metres_per_unit_(metres_of(options.unit)) {
  if (!options.layout.empty()) {
    points_ = parse_bare_layout(options.layout);
    if (!points_) throw std::invalid_argument(fmt::format("--layout {}: {}", options.layout, bare_layout_rule()));
  }
  for (const std::string& argument : arguments) add(argument, options);
  choose_layouts();
  if (!options.of_others && errors_.empty()) expect_use(options);
}

void FrameSequence::expect_use(const InputOptions& options) const {
  if (!options.topic.empty() && !bag_seen_) {
    throw std::invalid_argument(say("--topic {}: no input is a bag", options.topic));
  }
  if (!options.source.empty() && !bag_seen_ && !packets_seen_) {
    throw std::invalid_argument(say("--source {}: no input is a bag or a capture of packets", options.source));
  }
  if (!options.packets.metadata.empty() && !packets_seen_) {
    throw std::invalid_argument(say("--metadata {}: no input is a capture of packets", options.packets.metadata));
  }
  if (!options.packets.sensor.empty() && !packets_seen_) {
    throw std::invalid_argument(say("--sensor {}: no input is a capture of packets", options.packets.sensor));
  }
  const auto uses_points = [](const FileSource* source) { return source->uses_points(); };
  if (points_ && std::none_of(file_sources_.begin(), file_sources_.end(), uses_points)) {
    throw std::invalid_argument(say("--layout {}: every input has a header that says how it is read", options.layout));
  }
  if (metres_per_unit_ != 1.0 && packets_seen_) {
    throw std::invalid_argument(
        say("--unit {}: packets tell their unit themselves; of frame files and clouds in bags it can be said",
            options.unit));
  }
}

namespace {

SensorOptions packets_of(const InputOptions& options) {
  SensorOptions packets = options.packets;
  if (packets.source.empty()) packets.source = options.source;
  return packets;
}

}  // namespace

void FrameSequence::choose_layouts() {
  for (FileSource* source : file_sources_) {
    source->choose_layout();
    if (!source->note().empty()) notes_.push_back(source->note());
  }
}

void FrameSequence::add_note(const std::string& argument) {
  const std::string note = sources_.back()->note();
  if (!note.empty()) notes_.push_back(fmt::format("{}: {}", argument, note));
}

void FrameSequence::add(const std::string& argument, const InputOptions& options) {
  try {
    if (is_rosbag2_folder(argument)) return add_bag(argument, rosbag2_files(argument), options);
    if (is_packet_capture(argument)) {
      sources_.push_back(open_packet_capture(argument, packets_of(options)));
      add_note(argument);
      files_.emplace_back(argument);
      packets_seen_ = true;
      open_files_ = nullptr;
      return;
    }
    if (recognise_bag(argument)) return add_bag(argument, {argument}, options);
  } catch (const std::runtime_error& fault) {  // of a reader, or of the file system
    const std::string what = fault.what();     // of a bag it names the file
    errors_.push_back(what.rfind(argument, 0) == 0 ? what : fmt::format("{}: {}", argument, what));
    return;
  }
  const std::string of_planar = planar_input_text(argument);
  if (of_planar.empty()) return add_files(argument);
  errors_.push_back(fmt::format("{}: {}", argument, of_planar));
}

// Files that are named one after the other are one recording, as a folder is.
void FrameSequence::add_files(const std::string& argument) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(argument, ignored);
  FrameInputs inputs = collect_inputs({argument});
  files_.insert(files_.end(), inputs.files.begin(), inputs.files.end());
  errors_.insert(errors_.end(), inputs.errors.begin(), inputs.errors.end());
  notes_.insert(notes_.end(), inputs.notes.begin(), inputs.notes.end());
  if (!is_folder && open_files_ != nullptr) return open_files_->append(inputs.files);
  auto source = std::make_unique<FileSource>(std::move(inputs.files), points_);
  file_sources_.push_back(source.get());
  open_files_ = is_folder ? nullptr : source.get();
  sources_.push_back(std::move(source));
}

void FrameSequence::add_bag(const std::string& argument, const std::vector<std::filesystem::path>& files,
                            const InputOptions& options) {
  files_.insert(files_.end(), files.begin(), files.end());
  open_files_ = nullptr;
  auto bag = std::make_unique<Bag>(files, options.source);
  try {
    const bool fullest = options.fullest_topic && options.topic.empty();
    std::string topic = fullest ? bag->fullest_topic() : bag->choose_topic(options.topic);
    if (bag->has_packets(topic)) {
      sources_.push_back(open_bag_packets(std::move(bag), topic, packets_of(options)));
      add_note(argument);
      packets_seen_ = true;
    } else {
      const std::string note = bag->choose_source(topic);
      if (!note.empty()) notes_.push_back(fmt::format("{}: {}", argument, note));
      const std::string empty = say("topic {} holds no message, so there is no frame", topic);
      sources_.push_back(std::make_unique<BagSource>(std::move(bag), std::move(topic)));
      if (sources_.back()->frames() == 0) errors_.push_back(fmt::format("{}: {}", argument, empty));
    }
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument(fmt::format("{}: {}", argument, fault.what()));
  }
  bag_seen_ = true;
}

std::optional<SourcedFrame> FrameSequence::next() {
  using Clock = std::chrono::steady_clock;
  for (; current_ < sources_.size(); ++current_) {
    const Clock::time_point start = Clock::now();
    if (std::optional<SourcedFrame> sourced = sources_[current_]->next()) {
      if (sourced->frame) {
        if (metres_per_unit_ != 1.0) scale_points(&*sourced->frame, metres_per_unit_);
        sourced->load_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
      }
      return sourced;
    }
  }
  return std::nullopt;
}

std::size_t FrameSequence::frames() const {
  std::size_t frames = 0;
  for (const auto& source : sources_) frames += source->frames();
  return frames;
}

}  // namespace pose_wall::tools
