// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/bag_packets.hpp"

#include <algorithm>
#include <utility>

#include "io/bags/message_cursor.hpp"
#include "io/bags/packet_message.hpp"
#include "io/language/language.hpp"
#include "io/packets/packet_frames.hpp"

namespace pose_wall::tools {
namespace {

class BagPackets : public DatagramSource {
 public:
  BagPackets(std::shared_ptr<Bag> bag, std::string topic) : bag_(std::move(bag)), topic_(std::move(topic)) {
    find_device();
    for (Bag::File& file : bag_->files()) file.reader->rewind();
  }

  std::optional<Datagram> next() override {
    while (next_ == message_.packets.size()) {
      if (!read_message()) return std::nullopt;
    }
    const MessagePacket& packet = message_.packets[next_++];
    Sender from;
    from.frame_id = message_.frame_id;  // an Ouster's message has none
    return Datagram{packet.stamp_ns != 0 ? packet.stamp_ns : recorded_ns_, from, packet.payload};
  }

 private:
  void find_device() {
    std::vector<std::string> topics;
    for (const SourceTopic& topic : bag_->topics()) {
      if (topic.has_packets) topics.push_back(topic.name);
    }
    device_ = device_topic(topics, topic_);
  }

  // Of the topic, and of what describes its device.
  std::optional<BagMessage> next_message() {
    for (; file_ < bag_->files().size(); ++file_) {
      BagReader& reader = *bag_->files()[file_].reader;
      while (std::optional<BagMessage> message = reader.next()) {
        const BagTopic& topic = reader.topics()[message->topic];
        if ((topic.name == topic_ || topic.name == device_) && is_packet_type(topic.type)) return message;
      }
    }
    return std::nullopt;
  }

  // What it gives lasts until the next call: the packets of a message are views of it.
  bool read_message() {
    next_ = 0;
    message_ = {};
    const std::optional<BagMessage> message = next_message();
    if (!message) return false;
    const BagTopic& topic = bag_->files()[file_].reader->topics()[message->topic];
    message_ = decode_packets(topic.type, topic.encoding, message->data, message->place);
    recorded_ns_ = message->recorded_ns;
    return true;
  }

  std::shared_ptr<Bag> bag_;
  std::string topic_, device_;
  DecodedPackets message_;
  std::int64_t recorded_ns_ = 0;
  std::size_t file_ = 0;
  std::size_t next_ = 0;
};

// "/ouster/lidar_packets": "/ouster/metadata".
std::string topic_beside(const std::string& topic) {
  return topic.substr(0, topic.find_last_of('/') + 1) + "metadata";
}

bool is_metadata(const BagTopic& topic, const std::string& name) {
  return topic.name == name && (topic.type == "std_msgs/String" || topic.type == "std_msgs/msg/String");
}

// The text of the first message of a topic; "" where there is none.
std::string first_text(Bag& bag, const std::string& name) {
  for (Bag::File& file : bag.files()) {
    const auto& topics = file.reader->topics();
    if (std::none_of(topics.begin(), topics.end(), [&](const BagTopic& topic) { return is_metadata(topic, name); })) {
      continue;
    }
    file.reader->rewind();
    for (bool goes_on = true; goes_on;) {
      try {
        const std::optional<BagMessage> message = file.reader->next();
        goes_on = message.has_value();
        if (!message || !is_metadata(file.reader->topics()[message->topic], name)) continue;
        const BagTopic& topic = file.reader->topics()[message->topic];
        return std::string(MessageCursor(topic.encoding, message->data, message->place).text("text"));
      } catch (const FrameError&) {
        continue;  // said when the packets are read
      }
    }
  }
  return "";
}

// Its driver records what an Ouster tells of itself beside its packets. Nebula records packets of any sensor.
bool may_be_ousters(const Bag& bag, const std::string& topic, const SensorOptions& options) {
  const bool is_allowed = options.sensor.empty() || options.sensor == known_sensor(SensorKind::kAutomatic).name ||
                          options.sensor == known_sensor(SensorKind::kOuster).name;
  return is_allowed && std::any_of(bag.topics().begin(), bag.topics().end(), [&](const SourceTopic& known) {
           return known.name == topic && (known.type.rfind("ouster_", 0) == 0 || known.type.rfind("nebula_", 0) == 0);
         });
}

SensorChoice choose_with_metadata(const SensorOptions& options, const std::string& text, const std::string& place) {
  SensorChoice choice = choose_sensor(options);
  choice.metadata = text;
  try {
    make_assembler(choice);
  } catch (const FrameError& fault) {
    throw FrameError(say("metadata of topic {}: {}", place, fault.what()));
  }
  return choice;
}

}  // namespace

std::unique_ptr<FrameSource> open_bag_packets(std::unique_ptr<Bag> bag, const std::string& topic,
                                              const SensorOptions& options) {
  PacketRecording recording;
  recording.name = bag->files().front().path.string();
  recording.about = bag->about(topic);
  const std::string beside = topic_beside(topic);
  recording.may_be_ousters = may_be_ousters(*bag, topic, options);
  const bool is_looked_for = options.metadata.empty() && recording.may_be_ousters;
  const std::string metadata = is_looked_for ? first_text(*bag, beside) : "";
  if (is_looked_for && metadata.empty()) {
    recording.ouster_hint = "its metadata is what --metadata names, or a text on the topic " + beside + " of the bag";
  } else if (options.metadata.empty() && metadata.empty()) {
    recording.ouster_hint = "its metadata is what --metadata names";
  }
  const std::shared_ptr<Bag> shared = std::move(bag);
  recording.open = [shared, topic] { return std::make_unique<BagPackets>(shared, topic); };
  return std::make_unique<PacketFrames>(std::move(recording), metadata.empty()
                                                                  ? choose_sensor(options)
                                                                  : choose_with_metadata(options, metadata, beside));
}

}  // namespace pose_wall::tools
