// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/bag_packets.hpp"

#include <utility>

#include "bags/packet_message.hpp"
#include "packets/packet_frames.hpp"

namespace pose_wall::tools {
namespace {

class BagPackets : public DatagramSource {
 public:
  BagPackets(std::shared_ptr<Bag> bag, std::string topic) : bag_(std::move(bag)), topic_(std::move(topic)) {
    for (Bag::File& file : bag_->files()) file.reader->rewind();
  }

  std::optional<Datagram> next() override {
    while (next_ == message_.packets.size()) {
      if (!read_message()) return std::nullopt;
    }
    const MessagePacket& packet = message_.packets[next_++];
    return Datagram{packet.stamp_ns != 0 ? packet.stamp_ns : recorded_ns_, 0, packet.payload};
  }

 private:
  // What it gives lasts until the next call: the packets of a message are views of it.
  bool read_message() {
    next_ = 0;
    message_ = {};
    for (; file_ < bag_->files().size(); ++file_) {
      BagReader& reader = *bag_->files()[file_].reader;
      while (const std::optional<BagMessage> message = reader.next()) {
        const BagTopic& topic = reader.topics()[message->topic];
        if (topic.name != topic_ || !is_packet_type(topic.type)) continue;
        message_ = decode_packets(topic.type, topic.encoding, message->data, message->place);
        recorded_ns_ = message->recorded_ns;
        return true;
      }
    }
    return false;
  }

  std::shared_ptr<Bag> bag_;
  std::string topic_;
  DecodedPackets message_;
  std::int64_t recorded_ns_ = 0;
  std::size_t file_ = 0;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> open_bag_packets(std::unique_ptr<Bag> bag, const std::string& topic,
                                              const SensorOptions& options) {
  PacketRecording recording;
  recording.name = bag->files().front().path.string();
  recording.about = bag->about(topic);
  if (options.metadata.empty()) recording.ouster_hint = "its metadata is what --metadata names";
  const std::shared_ptr<Bag> shared = std::move(bag);
  recording.open = [shared, topic] { return std::make_unique<BagPackets>(shared, topic); };
  return std::make_unique<PacketFrames>(std::move(recording), choose_sensor(options));
}

}  // namespace pose_wall::tools
