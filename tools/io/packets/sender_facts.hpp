// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a recording tells of those who sent it: address, ports, network card, and what data packets and the packets in
// which a sensor describes itself say.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/frames/frame_source.hpp"
#include "io/frames/source_identity.hpp"
#include "io/packets/datagram_source.hpp"
#include "io/packets/packet_words.hpp"

namespace pose_wall::tools {

class SenderFacts {
 public:
  // `metadata`: as an Ouster is read with; anything else is passed over.
  explicit SenderFacts(const std::string& metadata);

  // Of every datagram of the recording.
  void hear(const Datagram& datagram);

  // Fills in facts and oddities of one whose data were heard. `kind`: what it is read as, where it is the one that is.
  void describe(const SourceIdentity& who, const std::string& kind, SourceSender* sender) const;

 private:
  struct Heard {
    Sender from;
    SourceIdentity who;
    std::string model;  // "" where it is not certain
    std::unique_ptr<PacketWords> words;
    std::size_t looks = 0;  // at packets that told nothing
    bool is_data = false;
  };
  struct Device {
    Sender from;
    std::string bytes;  // the newest packet
  };

  Heard* heard_of(const Sender& from);
  bool hear_device(const Datagram& datagram);
  const Device* device_of(const Heard& heard) const;

  std::string metadata_;
  std::vector<std::unique_ptr<Heard>> heard_;
  std::vector<Device> devices_;
};

}  // namespace pose_wall::tools
