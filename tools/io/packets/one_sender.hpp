// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One rule for whose packets are read, in captures, bags and live alike: of several senders the one whose turn is whole
// first. No scan is ever a mixture.

#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/frames/source_identity.hpp"
#include "io/packets/scan.hpp"

namespace pose_wall::tools {

// As senders are told apart and named.
SourceIdentity identity_of_sender(const Sender& from);

// Each sender has an assembler of its own until one is decided for. A packet that came twice (a bridge, a capture of
// all interfaces) is one. What a sensor says of itself by another port reaches the assembler of its data.
class OneSender : public ScanAssembler {
 public:
  using Make = std::function<std::unique_ptr<ScanAssembler>()>;

  // `make` may give nothing as long as its metadata is not known. `wanted`: a name of the sender to read; "": any.
  explicit OneSender(Make make, std::string wanted = "");

  // Throws FrameError where all that is heard contradicts itself or what was chosen.
  bool add(const Datagram& datagram) override;
  void finish() override;

  const char* kind() const override;
  bool stamps_are_of_arrival() const override;
  std::string hint() const override;

  // Whose data were heard, which one is read, and how many packets each sent.
  const SourceGate& senders() const { return gate_; }

 private:
  struct Packet {
    std::int64_t captured_ns = 0;
    std::vector<std::byte> payload;
  };
  struct Candidate {
    Sender from;
    std::unique_ptr<ScanAssembler> inner;
    std::deque<Scan> scans;
    bool is_whole = false;       // one of them
    std::string fault;           // why none of its packets can be read
    std::size_t data_bytes = 0;  // of its first packet
    std::deque<Packet> last_ones = {};
  };
  struct Known {
    Sender from;
    SourceIdentity who;
  };
  struct Told {
    Sender from;
    std::vector<std::byte> payload;
  };

  static bool is_repeated(Candidate* candidate, const Datagram& datagram);
  bool add_data(const Datagram& datagram);
  bool add_device(const Datagram& datagram);
  bool add_to(Candidate* candidate, const Datagram& datagram);
  bool begin(const Datagram& datagram);
  Candidate* candidate_of(const Sender& from);
  void tell(Candidate* candidate, const Told& told) const;
  bool belongs(const Told& told, const Candidate& candidate) const;
  static void gather(Candidate* candidate);
  void push_scans(Candidate* candidate);
  void decide_for(Candidate* candidate);
  bool is_data_of_sensor(const Datagram& datagram) const;
  const SourceIdentity& identity_of(const Sender& from);

  Make make_;
  SourceGate gate_;
  std::deque<Known> known_;
  std::vector<std::unique_ptr<Candidate>> candidates_;
  Candidate* chosen_ = nullptr;
  std::unique_ptr<ScanAssembler> spare_;  // for the next sender; what is no data has left it as it was
  std::vector<Told> told_;
  std::size_t data_bytes_ = 0;  // of the packets of one that was begun
};

}  // namespace pose_wall::tools
