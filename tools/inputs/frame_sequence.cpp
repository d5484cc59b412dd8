// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "inputs/frame_sequence.hpp"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <utility>

#include "bags/bag_source.hpp"
#include "bags/rosbag2_folder.hpp"
#include "frames/file_source.hpp"
#include "frames/input_list.hpp"
#include "packets/bag_packets.hpp"
#include "packets/packet_source.hpp"

namespace pose_wall::tools {

FrameSequence::FrameSequence(const std::vector<std::string>& arguments, const InputOptions& options) {
  for (const std::string& argument : arguments) add(argument, options);
  if (options.of_others || !errors_.empty()) return;
  if (!options.topic.empty() && !bag_seen_) {
    throw std::invalid_argument(fmt::format("--topic {}: no input is a bag", options.topic));
  }
  if (!options.packets.metadata.empty() && !packets_seen_) {
    throw std::invalid_argument(
        fmt::format("--metadata {}: no input is a capture of packets", options.packets.metadata));
  }
  if (!options.packets.sensor.empty() && !packets_seen_) {
    throw std::invalid_argument(fmt::format("--sensor {}: no input is a capture of packets", options.packets.sensor));
  }
}

void FrameSequence::add(const std::string& argument, const InputOptions& options) {
  try {
    if (is_rosbag2_folder(argument)) return add_bag(argument, rosbag2_files(argument), options);
    if (is_packet_capture(argument)) {
      sources_.push_back(open_packet_capture(argument, options.packets));
      files_.emplace_back(argument);
      packets_seen_ = true;
      return;
    }
    if (recognise_bag(argument)) return add_bag(argument, {argument}, options);
  } catch (const std::runtime_error& fault) {  // of a reader, or of the file system
    const std::string what = fault.what();     // of a bag it names the file
    errors_.push_back(what.rfind(argument, 0) == 0 ? what : fmt::format("{}: {}", argument, what));
    return;
  }
  FrameInputs inputs = collect_inputs({argument});
  files_.insert(files_.end(), inputs.files.begin(), inputs.files.end());
  errors_.insert(errors_.end(), inputs.errors.begin(), inputs.errors.end());
  sources_.push_back(std::make_unique<FileSource>(std::move(inputs.files)));
}

void FrameSequence::add_bag(const std::string& argument, const std::vector<std::filesystem::path>& files,
                            const InputOptions& options) {
  files_.insert(files_.end(), files.begin(), files.end());
  auto bag = std::make_unique<Bag>(files);
  try {
    const bool fullest = options.fullest_topic && options.topic.empty();
    std::string topic = fullest ? bag->fullest_topic() : bag->choose_topic(options.topic);
    if (bag->has_packets(topic)) {
      sources_.push_back(open_bag_packets(std::move(bag), topic, options.packets));
      packets_seen_ = true;
    } else {
      sources_.push_back(std::make_unique<BagSource>(std::move(bag), std::move(topic)));
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
