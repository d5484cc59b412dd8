// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/bag_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "io/bags/cloud_message.hpp"
#include "io/bags/packet_message.hpp"
#include "io/language/language.hpp"
#include "io/terminal/counted.hpp"
#include "io/terminal/did_you_mean.hpp"

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

Bag::Bag(const std::vector<std::filesystem::path>& files, std::string source) : source_(std::move(source)) {
  for (const std::filesystem::path& file : files) add(file);
}

void Bag::add(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw FrameError(path.string() + tr(": no such file"));
  const std::optional<BagKind> kind = recognise_bag(path);
  if (!kind) throw FrameError(path.string() + tr(": this is no bag; ROS 1 bags, MCAP and SQLite bags are read"));
  kind_ = *kind;
  File file{path, nullptr};
  BagSurvey survey;
  try {
    file.reader = open_bag(path, *kind);
    survey =
        file.reader->survey([&](const BagMessage& message) { hear(file.reader->topics()[message.topic], message); });
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
      topics_.push_back({found[i].name, found[i].type, survey.messages[i], is_cloud_type(found[i].type),
                         is_packet_type(found[i].type)});
    }
  }
  files_.push_back(std::move(file));
}

void Bag::hear(const BagTopic& topic, const BagMessage& message) {
  if (!is_cloud_type(topic.type)) return;
  const SourceIdentity source = source_of_cloud(topic.type, topic.encoding, message.data, message.place);
  if (!sources_.try_emplace(topic.name, source_).first->second.admits(source)) return;
  const std::optional<ScanSpan> span = span_of_cloud(topic.type, topic.encoding, message.data, message.place);
  if (span) overlaps_[topic.name].add(*span);
}

std::vector<SourceTopic> Bag::frame_topics() const {
  std::vector<SourceTopic> topics;
  std::copy_if(topics_.begin(), topics_.end(), std::back_inserter(topics),
               [](const SourceTopic& topic) { return topic.has_clouds || topic.has_packets; });
  // Of a bag with faults the reading says what is wrong.
  if (topics.empty() && faults_ == 0) {
    throw FrameError(
        say("no topic of sensor_msgs/PointCloud2, of Livox's CustomMsg, or of packets (VelodyneScan, "
            "NebulaPackets, PandarScan, PacketMsg, RslidarPacket, rslidarScan, LslidarPacket); topics: {}",
            topics_.empty() ? tr("none") : list_of(topics_, true)));
  }
  return topics;
}

std::vector<SourceTopic> Bag::preferred_topics() const {
  const std::vector<SourceTopic> topics = frame_topics();
  std::vector<SourceTopic> preferred;
  const auto keep = [&](auto is_wanted) {
    if (preferred.empty()) std::copy_if(topics.begin(), topics.end(), std::back_inserter(preferred), is_wanted);
  };
  // A driver that records both has made the clouds of the packets.
  keep([](const SourceTopic& topic) { return topic.has_clouds && topic.messages > 0; });
  keep([](const SourceTopic& topic) { return topic.messages > 0 && !is_side_topic(topic.name); });
  keep([](const SourceTopic& topic) { return topic.messages > 0; });
  keep([](const SourceTopic&) { return true; });
  return preferred;
}

std::string Bag::fullest_topic() const {
  const std::vector<SourceTopic> topics = preferred_topics();
  const auto fullest = std::max_element(
      topics.begin(), topics.end(), [](const SourceTopic& a, const SourceTopic& b) { return a.messages < b.messages; });
  return fullest != topics.end() ? fullest->name : "";
}

std::string Bag::choose_topic(const std::string& wanted) const {
  const std::vector<SourceTopic> topics = frame_topics();
  if (topics.empty()) return wanted;
  if (!wanted.empty()) {
    std::vector<std::string> names;
    for (const SourceTopic& topic : topics) names.push_back(topic.name);
    if (std::find(names.begin(), names.end(), wanted) != names.end()) return wanted;
    throw std::invalid_argument(say("--topic {}: no clouds of this name{}; topics with clouds: {}", wanted,
                                    did_you_mean(wanted, names), list_of(topics, false)));
  }
  const std::vector<SourceTopic> preferred = preferred_topics();
  if (preferred.size() > 1 && preferred.front().messages > 0) {
    throw std::invalid_argument(
        say("several topics with clouds: {}. Name one with --topic", list_of(preferred, false)));
  }
  return preferred.front().name;
}

bool Bag::has_packets(const std::string& name) const {
  return std::any_of(topics_.begin(), topics_.end(),
                     [&](const SourceTopic& topic) { return topic.name == name && topic.has_packets; });
}

const SourceGate& Bag::sources(const std::string& topic) const {
  static const SourceGate none;
  const auto found = sources_.find(topic);
  return found != sources_.end() ? found->second : none;
}

std::string Bag::choose_source(const std::string& topic) const {
  const SourceGate& gate = sources(topic);
  const std::string where = say("on {}", topic);
  const std::string fault = gate.fault(where, "message");
  if (!fault.empty()) throw std::invalid_argument(fault);
  const auto overlap = overlaps_.find(topic);
  if (overlap != overlaps_.end() && overlap->second.is_of_several()) {
    throw FrameError(
        say("the scans of {} {} overlap in time: they are of several sensors that nothing tells apart. Record a topic "
            "for each (livox_ros_driver2: multi_topic 1)",
            gate.chosen()->text(), where));
  }
  return gate.note(where, "message");
}

SourceAbout Bag::about(const std::string& topic) const {
  std::string kind(bag_kind_name(kind_));
  if (files_.size() > 1) kind += say(" of {} files", files_.size());
  const SourceGate& gate = sources(topic);
  std::vector<SourceSender> senders;
  for (const HeardSource& heard : gate.heard()) {
    senders.push_back({gate.name_of(heard.who), heard.count, heard.who == gate.chosen()});
  }
  return {std::move(kind), topics_, topic, std::move(senders)};
}

BagSource::BagSource(std::unique_ptr<Bag> bag, std::string topic) : bag_(std::move(bag)), topic_(std::move(topic)) {
  frames_ = bag_->faults();
  for (const SourceTopic& known : bag_->topics()) {
    if (known.name == topic_) frames_ += static_cast<std::size_t>(known.messages);
  }
  frames_ -= static_cast<std::size_t>(bag_->sources(topic_).refused());
}

// One whose sender cannot be read is not passed over: it is an unreadable frame.
bool BagSource::is_of_another(const BagTopic& topic, const BagMessage& message) const {
  try {
    return !bag_->sources(topic_).may_be(source_of_cloud(topic.type, topic.encoding, message.data, message.place));
  } catch (const FrameError&) {
    return false;
  }
}

SourcedFrame BagSource::frame_of(const Bag::File& file, const BagMessage& message) {
  SourcedFrame sourced;
  sourced.name = fmt::format("{}#{}", file.path.string(), next_message_++);
  sourced.stamp_ns = message.recorded_ns;
  try {
    const BagTopic& topic = file.reader->topics()[message.topic];
    DecodedCloud cloud = decode_cloud(topic.type, topic.encoding, message.data, message.place);
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
        if (topic.name != topic_ || !is_cloud_type(topic.type)) continue;
        if (!is_of_another(topic, *message)) return frame_of(file, *message);
        ++next_message_;
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
