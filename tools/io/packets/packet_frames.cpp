// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/packet_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>

#include "io/language/language.hpp"
#include "io/packets/one_sender.hpp"
#include "io/packets/ouster_profiles.hpp"
#include "io/packets/sender_facts.hpp"
#include "io/packets/velodyne_models.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kKindsKept = 4;  // as many as one line holds

}  // namespace

// Datagrams that are no data of the sensor: what is there instead.
class PacketFrames::Others {
 public:
  void add(const Datagram& datagram) {
    may_be_ousters_ = may_be_ousters_ || may_be_ouster_packet(datagram.payload.size);
    are_positions_ = are_positions_ || datagram.from.to_port == kVelodynePositionPort;
    const auto is_same = [&](const Kind& kind) {
      return kind.to_port == datagram.from.to_port && kind.bytes == datagram.payload.size;
    };
    const auto known = std::find_if(kinds_.begin(), kinds_.end(), is_same);
    if (known != kinds_.end()) {
      ++known->count;
    } else if (kinds_.size() < kKindsKept) {
      kinds_.push_back({datagram.from.to_port, datagram.payload.size, 1});
    } else {
      ++more_;
    }
  }

  std::string text() const {
    if (kinds_.empty()) return tr("; it holds no UDP packet");
    std::string text;
    for (const Kind& kind : kinds_) {
      text += text.empty() ? "; " : ", ";
      text += kind.to_port != 0 ? say("{} packets of {} bytes to port {}", kind.count, kind.bytes, kind.to_port)
                                : say("{} packets of {} bytes", kind.count, kind.bytes);
    }
    return more_ > 0 ? text + say(", and {} others", more_) : text;
  }

  bool may_be_ousters() const { return may_be_ousters_; }
  bool are_positions() const { return are_positions_; }

 private:
  struct Kind {
    std::uint16_t to_port;
    std::size_t bytes, count;
  };
  std::vector<Kind> kinds_;
  std::size_t more_ = 0;
  bool may_be_ousters_ = false, are_positions_ = false;
};

// Scans of a recording one by one, the incomplete ones at its ends left out.
class PacketFrames::ScanWalk {
 public:
  // `facts`: is told of each datagram; may be none.
  ScanWalk(std::unique_ptr<DatagramSource> datagrams, const SensorChoice& choice, SenderFacts* facts)
      : datagrams_(std::move(datagrams)),
        assembler_([choice] { return make_assembler(choice); }, choice.source),
        facts_(facts) {}

  // Throws FrameError where packets of the only sender contradict themselves or the sensor that was chosen. What cannot
  // be read is a fault.
  std::optional<Scan> next() {
    while (true) {
      if (!ahead_) ahead_ = assembled_next();
      if (!ahead_ && given_ == 0 && !refusal_.empty()) throw FrameError(refusal_);
      if (!ahead_) return std::nullopt;
      Scan scan = std::move(*ahead_);
      ahead_ = assembled_next();
      const bool at_an_end = given_ == 0 || !ahead_;
      const bool is_only = given_ == 0 && !ahead_;
      if (!ahead_ && !refusal_.empty()) faults_.push_back(std::exchange(refusal_, ""));
      if (scan.is_complete || !at_an_end || is_only) {
        ++given_;
        return scan;
      }
    }
  }

  std::optional<std::string> take_fault() {
    if (faults_.empty()) return std::nullopt;
    std::optional<std::string> fault = std::move(faults_.front());
    faults_.pop_front();
    return fault;
  }

  const OneSender& assembler() const { return assembler_; }
  const char* other() const { return other_; }
  const std::string& unread() const { return unread_; }
  const Others& others() const { return others_; }

 private:
  std::optional<Scan> assembled_next() {
    while (true) {
      if (std::optional<Scan> scan = assembler_.take()) return scan;
      if (ended_) return std::nullopt;
      std::optional<Datagram> datagram;
      try {
        datagram = datagrams_->next();
      } catch (const FrameError& fault) {
        faults_.emplace_back(fault.what());
        continue;
      }
      try {
        add_or_finish(datagram);
      } catch (const FrameError& fault) {
        refuse(fault.what());
      }
    }
  }

  void add_or_finish(const std::optional<Datagram>& datagram) {
    if (!datagram) {
      ended_ = true;
      assembler_.finish();
      return;
    }
    if (facts_ != nullptr) facts_->hear(*datagram);
    if (!assembler_.add(*datagram)) {
      others_.add(*datagram);
      if (other_ == nullptr) other_ = recognised_title(*datagram);
      if (unread_.empty()) unread_ = unread_sensor(datagram->payload);
    }
  }

  // It stands for all packets of its sender, so it is said once. Another sender's may follow.
  void refuse(const std::string& why) {
    if (refusal_.empty()) refusal_ = why;
  }

  std::unique_ptr<DatagramSource> datagrams_;
  OneSender assembler_;
  SenderFacts* facts_;
  std::optional<Scan> ahead_;
  std::deque<std::string> faults_;
  const char* other_ = nullptr;  // whose packets the assembler did not take
  std::string unread_;
  Others others_;
  std::string refusal_;  // of a sender's packets
  std::size_t given_ = 0;
  bool ended_ = false;
};

PacketFrames::PacketFrames(PacketRecording recording, const SensorChoice& choice) : recording_(std::move(recording)) {
  if (choice.kind == SensorKind::kOuster && choice.metadata.empty()) refuse_without_metadata();
  {
    SenderFacts facts(choice.metadata);
    ScanWalk survey(recording_.open(), choice, &facts);
    while (survey.next()) ++frames_;
    const std::size_t scans = frames_;
    while (survey.take_fault()) ++frames_;
    const SourceGate& senders = survey.assembler().senders();
    if (scans == 0 && !senders.heard().empty() && !senders.fault("", "packet").empty()) {
      throw FrameError(senders.fault("", "packet"));
    }
    if (scans == 0 && frames_ == 0) refuse_empty(survey, choice);
    note_ = senders.note("", "packet");
    for (const HeardSource& heard : senders.heard()) {
      SourceSender sender{senders.name_of(heard.who), heard.count, heard.who == senders.chosen()};
      facts.describe(heard.who, survey.assembler().kind(), &sender);
      recording_.about.senders.push_back(std::move(sender));
    }
    recording_.about.kind += (recording_.about.kind.empty() ? "" : ", ") + std::string(survey.assembler().kind());
  }
  walk_ = std::make_unique<ScanWalk>(recording_.open(), choice, nullptr);
}

PacketFrames::~PacketFrames() = default;

void PacketFrames::refuse_empty(const ScanWalk& survey, const SensorChoice& choice) const {
  std::string wanted;
  if (choice.kind != SensorKind::kAutomatic) {
    wanted = say("of a {} ({})", known_sensor(choice.kind).title, known_sensor(choice.kind).name);
  } else if (!choice.metadata.empty() && recording_.ouster_hint.empty()) {
    wanted = tr("of an Ouster as its metadata says");
  } else {
    wanted = tr("of a sensor that is read (--help lists them)");
  }
  std::string there;
  if (survey.other() != nullptr) there = say("; there are packets of a {}", survey.other());
  if (!survey.unread().empty()) there += say("; there is data of {}, which is not read", survey.unread());
  const bool is_unknown = there.empty();
  if (is_unknown) there = survey.others().text();
  const bool may_be_ousters = survey.others().may_be_ousters() || (is_unknown && recording_.may_be_ousters);
  if (may_be_ousters && !recording_.ouster_hint.empty()) {
    there += say("; they may be an Ouster's: {}", recording_.ouster_hint);
  }
  if (survey.others().are_positions()) {
    there += tr("; at port 8308 a Velodyne tells its position: record its data, port 2368, too");
  }
  const std::string hint = survey.assembler().hint();
  if (!hint.empty()) there += "; " + hint;
  throw FrameError(say("no data packets {}{}", wanted, there));
}

// Where the name is a mistake no metadata would help.
void PacketFrames::refuse_without_metadata() const {
  const KnownSensor& ouster = known_sensor(SensorKind::kOuster);
  ScanWalk survey(recording_.open(), SensorChoice{}, nullptr);
  bool is_another = false;
  try {
    is_another = survey.next().has_value();
  } catch (const FrameError&) {
    is_another = true;  // of another sensor, which contradicts itself
  }
  if (is_another) {
    throw FrameError(say("no data packets {}{}", say("of an {} ({})", ouster.title, ouster.name),
                         say("; there are {}", survey.assembler().kind())));
  }
  throw FrameError(say("packets of an {} are read with its metadata: {}", ouster.title, recording_.ouster_hint));
}

std::optional<SourcedFrame> PacketFrames::next() {
  SourcedFrame sourced;
  sourced.name = fmt::format("{}#{}", recording_.name, next_);
  if (const std::optional<Scan> scan = walk_->next()) {
    ++next_;
    sourced.stamp_ns = scan->stamp_ns;
    sourced.frame = frame_of(*scan);
    return sourced;
  }
  const std::optional<std::string> fault = walk_->take_fault();
  if (!fault) return std::nullopt;
  sourced.name = recording_.name;
  sourced.error = *fault;
  return sourced;
}

}  // namespace pose_wall::tools
