// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "bags/bag_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "bags/point_cloud2.hpp"
#include "terminal/counted.hpp"
#include "terminal/did_you_mean.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kTopicsShown = 20;

std::string list_of(const std::vector<SourceTopic>& topics, bool with_type) {
  std::string list;
  for (std::size_t i = 0; i < topics.size() && i < kTopicsShown; ++i) {
    list += fmt::format("{}{} ({}{})", i == 0 ? "" : ", ", topics[i].name,
                        with_type ? topics[i].type + ", " : std::string{}, counted(topics[i].messages, "message"));
  }
  return topics.size() > kTopicsShown ? list + ", ..." : list;
}

}  // namespace

Bag::Bag(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) add(file);
}

void Bag::add(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw FrameError(path.string() + ": no such file");
  const std::optional<BagKind> kind = recognise_bag(path);
  if (!kind) throw FrameError(path.string() + ": this is no bag; ROS 1 bags, MCAP and SQLite bags are read");
  kind_ = *kind;
  File file{path, nullptr};
  BagSurvey survey;
  try {
    file.reader = open_bag(path, *kind);
    survey = file.reader->survey();
  } catch (const FrameError& fault) {
    throw FrameError(fmt::format("{}: {}", path.string(), fault.what()));
  }
  faults_ += survey.faults.size();
  const std::vector<BagTopic>& found = file.reader->topics();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto known = std::find_if(topics_.begin(), topics_.end(),
                                    [&](const SourceTopic& topic) { return topic.name == found[i].name; });
    if (known != topics_.end()) {
      known->messages += survey.messages[i];
    } else {
      topics_.push_back({found[i].name, found[i].type, survey.messages[i], found[i].has_clouds()});
    }
  }
  files_.push_back(std::move(file));
}

std::vector<SourceTopic> Bag::cloud_topics() const {
  std::vector<SourceTopic> clouds;
  std::copy_if(topics_.begin(), topics_.end(), std::back_inserter(clouds),
               [](const SourceTopic& topic) { return topic.has_clouds; });
  // Of a bag with faults the reading says what is wrong.
  if (clouds.empty() && faults_ == 0) {
    throw FrameError(fmt::format("no topic of sensor_msgs/PointCloud2; topics: {}",
                                 topics_.empty() ? "none" : list_of(topics_, true)));
  }
  return clouds;
}

std::string Bag::fullest_topic() const {
  const std::vector<SourceTopic> clouds = cloud_topics();
  const auto fullest = std::max_element(
      clouds.begin(), clouds.end(), [](const SourceTopic& a, const SourceTopic& b) { return a.messages < b.messages; });
  return fullest != clouds.end() ? fullest->name : "";
}

std::string Bag::choose_topic(const std::string& wanted) const {
  const std::vector<SourceTopic> clouds = cloud_topics();
  if (clouds.empty()) return wanted;
  if (!wanted.empty()) {
    std::vector<std::string> names;
    for (const SourceTopic& topic : clouds) names.push_back(topic.name);
    if (std::find(names.begin(), names.end(), wanted) != names.end()) return wanted;
    throw std::invalid_argument(fmt::format("--topic {}: no clouds of this name{}; topics with clouds: {}", wanted,
                                            did_you_mean(wanted, names), list_of(clouds, false)));
  }
  std::vector<SourceTopic> filled;
  std::copy_if(clouds.begin(), clouds.end(), std::back_inserter(filled),
               [](const SourceTopic& topic) { return topic.messages > 0; });
  if (filled.size() > 1) {
    throw std::invalid_argument(
        fmt::format("several topics with clouds: {}. Name one with --topic", list_of(filled, false)));
  }
  return filled.empty() ? clouds.front().name : filled.front().name;
}

BagSource::BagSource(std::unique_ptr<Bag> bag, std::string topic) : bag_(std::move(bag)), topic_(std::move(topic)) {
  frames_ = bag_->faults();
  for (const SourceTopic& known : bag_->topics()) {
    if (known.name == topic_) frames_ += static_cast<std::size_t>(known.messages);
  }
}

SourceAbout BagSource::about() const {
  const std::size_t files = bag_->files().size();
  std::string kind(bag_kind_name(bag_->kind()));
  if (files > 1) kind += fmt::format(" of {} files", files);
  return {std::move(kind), bag_->topics(), topic_};
}

SourcedFrame BagSource::frame_of(const Bag::File& file, const BagMessage& message) {
  SourcedFrame sourced;
  sourced.name = fmt::format("{}#{}", file.path.string(), next_message_++);
  sourced.stamp_ns = message.recorded_ns;
  try {
    DecodedCloud cloud =
        decode_point_cloud2(file.reader->topics()[message.topic].encoding, message.data, message.place);
    if (cloud.stamp_ns != 0) sourced.stamp_ns = cloud.stamp_ns;
    sourced.frame = std::move(cloud.frame);
  } catch (const FrameError& fault) {
    sourced.error = fault.what();
  }
  return sourced;
}

std::optional<SourcedFrame> BagSource::next() {
  for (; file_ < bag_->files().size(); ++file_) {
    const Bag::File& file = bag_->files()[file_];
    try {
      while (const std::optional<BagMessage> message = file.reader->next()) {
        const BagTopic& topic = file.reader->topics()[message->topic];
        if (topic.name == topic_ && topic.has_clouds()) return frame_of(file, *message);
      }
    } catch (const FrameError& fault) {
      SourcedFrame sourced;
      sourced.name = file.path.string();
      sourced.error = fault.what();
      return sourced;
    }
  }
  return std::nullopt;
}

}  // namespace pose_wall::tools
