// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/sender_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/language/language.hpp"
#include "io/packets/lslidar_device.hpp"
#include "io/packets/one_sender.hpp"
#include "io/packets/robosense_device.hpp"
#include "io/packets/sensors.hpp"
#include "io/packets/velodyne_models.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kSendersMost = 64;
constexpr std::size_t kLooksMost = 16;
// Velodyne's position packets: their size, and where the sentence of NMEA begins (manual of the VLP-16).
constexpr std::size_t kPositionBytes = 512, kSentenceAt = 206;
constexpr std::size_t kSpeedAt = 8;  // of RoboSense's and LSLidar's device packets, in turns a minute
constexpr std::size_t kViewAt = 32, kTopFirmwareAt = 40, kBottomFirmwareAt = 45, kReturnModeAt = 300;
constexpr std::size_t kFirmwareBytes = 5;
constexpr std::uint64_t kTwoReturnsSince = 0x080209, kReturnModeMost = 6;  // robosense_device.cpp
constexpr std::uint64_t kTurn_cdeg = 36'000;

ByteView view_of(const std::string& bytes) {
  return {reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()};
}

void add(SourceSender* sender, const char* word, std::string found) {
  if (!found.empty()) sender->facts.push_back({word, std::move(found)});
}

std::string firmware_text(ByteView device, std::size_t offset) {
  std::string text;
  bool is_written = false;
  for (std::size_t i = 0; i < kFirmwareBytes; ++i) {
    const std::uint64_t byte = robosense_number(device, offset + i, 1);
    is_written = is_written || (byte != 0x00 && byte != 0xFF);
    text += fmt::format("{}{:02X}", i == 0 ? "" : " ", byte);
  }
  return is_written ? text : "";
}

void describe_robosense(ByteView device, SourceSender* sender) {
  add(sender, translatable("serial"), robosense_serial(device));
  const std::string top = firmware_text(device, kTopFirmwareAt), bottom = firmware_text(device, kBottomFirmwareAt);
  if (!top.empty() && !bottom.empty()) add(sender, translatable("firmware"), top + " / " + bottom);
  // The modes of one return are numbered otherwise by each model. Before that firmware there was but one.
  const std::uint64_t mode = robosense_number(device, kReturnModeAt, 1);
  if (mode == 0 && robosense_number(device, kBottomFirmwareAt, 3) >= kTwoReturnsSince) {
    add(sender, translatable("return mode"), translatable("two returns"));
  } else if (mode > 0 && mode <= kReturnModeMost) {
    add(sender, translatable("return mode"), translatable("one return"));
  }
  add(sender, translatable("turn rate"), fmt::format("{} rpm", robosense_number(device, kSpeedAt, 2)));
  const std::uint64_t from = robosense_number(device, kViewAt, 2), to = robosense_number(device, kViewAt + 2, 2);
  if (from == to || from > kTurn_cdeg || to > kTurn_cdeg) return;
  const bool is_whole = from == 0 && to == kTurn_cdeg;
  add(sender, translatable("field of view"),
      is_whole ? "360°" : fmt::format("{:g}°-{:g}°", 0.01 * static_cast<double>(from), 0.01 * static_cast<double>(to)));
}

// `GPRMC`, its time, and whether the receiver calls it valid.
std::string position_text(const std::string& bytes) {
  const std::string sentence = bytes.substr(kSentenceAt, bytes.find('\0', kSentenceAt) - kSentenceAt);
  const std::size_t time = sentence.find("RMC,"),
                    state = time == std::string::npos ? time : sentence.find(',', time + 4);
  if (state == std::string::npos || state + 1 >= sentence.size()) return "";
  return sentence.substr(state + 1, 1);
}

void describe_position(const std::string& bytes, SourceSender* sender) {
  const std::string state = position_text(bytes);
  add(sender, translatable("time source"), state.empty() ? translatable("no sentence of a GPS receiver") : "GPS");
  if (state == "A") add(sender, translatable("synchronised"), translatable("yes"));
  if (state == "V") {
    add(sender, translatable("synchronised"), translatable("no"));
    sender->oddities.push_back(tr("the GPS receiver at the sensor says that its time is not valid"));
  }
}

}  // namespace

SenderFacts::SenderFacts(const std::string& metadata) : metadata_(is_ouster_metadata(metadata) ? metadata : "") {}

SenderFacts::Heard* SenderFacts::heard_of(const Sender& from) {
  const auto found = std::find_if(heard_.begin(), heard_.end(), [&](const auto& h) { return h->from == from; });
  if (found != heard_.end()) return found->get();
  if (heard_.size() == kSendersMost) return nullptr;
  heard_.push_back(std::make_unique<Heard>());
  heard_.back()->from = from;
  heard_.back()->who = identity_of_sender(from);
  return heard_.back().get();
}

bool SenderFacts::hear_device(const Datagram& datagram) {
  const ByteView payload = datagram.payload;
  const bool is_position = payload.size == kPositionBytes && datagram.from.to_port == kVelodynePositionPort;
  if (!is_position && !is_robosense_device(payload) && !is_lslidar_device(lslidar_packet(payload))) return false;
  const auto is_same = [&](const Device& d) {
    return d.from.address == datagram.from.address && d.from.card == datagram.from.card &&
           d.from.frame_id == datagram.from.frame_id && d.from.to_port == datagram.from.to_port;
  };
  const auto same = std::find_if(devices_.begin(), devices_.end(), is_same);
  std::string bytes(reinterpret_cast<const char*>(payload.data), payload.size);
  if (same != devices_.end()) {
    same->bytes = std::move(bytes);
  } else if (devices_.size() < kSendersMost) {
    devices_.push_back({datagram.from, std::move(bytes)});
  }
  return true;
}

void SenderFacts::hear(const Datagram& datagram) {
  if (hear_device(datagram)) return;
  Heard* const heard = heard_of(datagram.from);
  if (heard == nullptr) return;
  if (heard->words == nullptr && !heard->is_data && heard->looks < kLooksMost) {
    ++heard->looks;
    heard->words = packet_words_for(datagram.payload, metadata_);
    if (const char* const title = recognised_title(datagram)) {
      heard->model = title;
    } else {
      heard->model = unread_sensor(datagram.payload);
    }
    heard->is_data = heard->words != nullptr || !heard->model.empty() || robosense_layout_of(datagram.payload);
  }
  if (heard->words) heard->words->hear(datagram);
}

// Of two sensors of one address it is not known whose it is.
const SenderFacts::Device* SenderFacts::device_of(const Heard& heard) const {
  const auto is_same = [&](const Sender& other) { return may_be_one_device(other, heard.from); };
  const auto senders =
      std::count_if(heard_.begin(), heard_.end(), [&](const auto& h) { return h->is_data && is_same(h->from); });
  const auto devices =
      std::count_if(devices_.begin(), devices_.end(), [&](const Device& d) { return is_same(d.from); });
  if (senders != 1 || devices != 1) return nullptr;
  return &*std::find_if(devices_.begin(), devices_.end(), [&](const Device& d) { return is_same(d.from); });
}

void SenderFacts::describe(const SourceIdentity& who, const std::string& kind, SourceSender* sender) const {
  add(sender, translatable("address"), who.address);
  if (who.from_port != 0) add(sender, translatable("sends from port"), std::to_string(who.from_port));
  if (who.port != 0) add(sender, translatable("sends to port"), std::to_string(who.port));
  add(sender, translatable("network card"), who.mac);
  if (who.frame_id) add(sender, "frame_id", *who.frame_id);
  const auto found = std::find_if(heard_.begin(), heard_.end(), [&](const auto& h) { return h->who == who; });
  if (found == heard_.end()) return;
  const Heard& heard = **found;
  // What it is read as was found out by more than one packet.
  if (!sender->is_read || kind.find(heard.model) != std::string::npos) add(sender, translatable("model"), heard.model);
  const Device* const device = device_of(heard);
  if (device != nullptr) {
    const ByteView bytes = view_of(device->bytes);
    if (device->bytes.size() == kPositionBytes) {
      describe_position(device->bytes, sender);
    } else if (is_robosense_device(bytes)) {
      describe_robosense(bytes, sender);
    } else {
      add(sender, "turn rate", fmt::format("{} rpm", robosense_number(bytes, kSpeedAt, 2)));
    }
  }
  if (heard.words) heard.words->describe(sender);
  if (devices_.empty() && heard.model.rfind("LSLidar", 0) == 0) {
    sender->oddities.push_back(
        tr("no packet in which it describes itself is in the recording (port 2369): whether its filters of rain, fog "
           "and dust are on is not known"));
  }
}

}  // namespace pose_wall::tools
