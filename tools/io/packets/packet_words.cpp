// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/packet_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "io/language/language.hpp"
#include "io/language/retold.hpp"
#include "io/packets/hesai_models.hpp"
#include "io/packets/livox.hpp"
#include "io/packets/lslidar_models.hpp"
#include "io/packets/ouster_metadata.hpp"
#include "io/packets/robosense_m1.hpp"
#include "io/packets/robosense_models.hpp"
#include "io/packets/turn_assembler.hpp"
#include "io/packets/velodyne_models.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kNumbersKept = 64;  // packets that a network may put out of order
constexpr double kJump = 10'000.0;        // packets; more are not missing, the sensor began anew
constexpr double kSpanLeast_s = 1.0;
// Clocks of sensors and computers differ by a ten-thousandth; what arrives is late by milliseconds.
constexpr double kClockShare = 0.02, kClockApart_s = 0.1;
constexpr std::uint64_t kStandingLeast = 10;  // packets

constexpr const char* kFewerShots =
    translatable("the sensor is too hot and sends up to {} % fewer shots, so that dark walls may be missing: cool it");
constexpr std::uint32_t kLimitingSoon = 1, kLimitingStep_percent = 10;
constexpr std::uint64_t kClockMost = 0x7FFFFFFFFFFFFFFFU;  // of an int64

// A turn takes 50 ms at least: within this an azimuth is not passed twice.
constexpr double kTurnGapMost_us = 30'000.0;
constexpr std::size_t kSectors = 72, kSector_deg = 5;
constexpr std::size_t kSectorsOfHole = 3;
constexpr double kTurnsForView = 2.0;

void add_fact(SourceSender* sender, const char* word, std::string found) {
  sender->facts.push_back({word, std::move(found)});
}

void add_missing(SourceSender* sender, const MissingPackets& packets) {
  if (!packets.is_told()) return;
  const std::uint64_t missing = packets.missing();
  add_fact(sender, translatable("packets lost"), fmt::format("{:.2f} % ({})", 100.0 * packets.share(), missing));
  if (missing > 0) {
    sender->oddities.push_back(
        say("{} of its packets are not in the recording, {:.2f} % of those that it sent: the network or the "
            "computer lost them, or the recording left them out",
            missing, 100.0 * packets.share()));
  }
  if (packets.repeated() > 0) {
    sender->oddities.push_back(
        say("{} of its packets came twice: a bridge, or a capture of all network cards? Each is "
            "read once",
            packets.repeated()));
  }
  if (packets.late() > 0) {
    sender->oddities.push_back(
        say("{} of its packets came behind later ones: the network put them out of order", packets.late()));
  }
}

std::optional<std::uint64_t> missing_of(const MissingPackets& packets) {
  return packets.is_told() ? std::optional<std::uint64_t>(packets.missing()) : std::nullopt;
}

// Alerts of a recording: each with the packets that had it.
class AlertsHeard {
 public:
  void hear(const std::string& alert) {
    ++packets_;
    if (!alert.empty()) ++heard_[alert];
  }

  void describe(SourceSender* sender) const {
    for (const auto& [alert, packets] : heard_) {
      sender->oddities.push_back(say("{} of {} packets: {}", packets, packets_, retold(language(), alert)));
    }
  }

 private:
  std::map<std::string, std::uint64_t> heard_;
  std::uint64_t packets_ = 0;
};

void add_oddity(SourceSender* sender, std::string oddity) {
  if (!oddity.empty()) sender->oddities.push_back(std::move(oddity));
}

std::string rpm_text(double turns_per_s) {
  return fmt::format("{:.0f} rpm", 60.0 * turns_per_s);
}

// As Velodyne and Hesai number them alike, as far as both have them: their manuals.
const char* return_mode(std::uint32_t mode) {
  switch (mode) {
    case 0x37:
      return translatable("strongest");
    case 0x38:
      return translatable("last");
    case 0x39:
      return translatable("two returns: last and strongest");
    default:
      return nullptr;
  }
}

// Those that Hesai has beside them: return modes of tier4/nebula (hesai_packet.hpp).
const char* hesai_return_mode(std::uint32_t mode) {
  switch (mode) {
    case 0x33:
      return translatable("first");
    case 0x34:
      return translatable("second");
    case 0x3A:
      return translatable("two returns: first and second");
    case 0x3B:
      return translatable("two returns: first and last");
    case 0x3C:
      return translatable("two returns: first and strongest");
    case 0x3D:
      return translatable("three returns: first, last and strongest");
    case 0x3E:
      return translatable("two returns: strongest and second strongest");
    default:
      return return_mode(mode);
  }
}

// Its manual: a clock that counts microseconds of the hour, then the return mode.
class VelodyneWords : public PacketWords {
 public:
  void hear(const Datagram& datagram) override {
    const ByteView payload = datagram.payload;
    if (!is_velodyne_data(payload)) return;
    mode_ = little_endian_at(payload, kVelodyneBytes - 2, 1);
    const std::int64_t clock_us = velodyne_clock_us(payload);
    const double azimuth_deg = azimuth_at_block(payload, 0);
    if (last_us_) {
      const double gap_us = static_cast<double>((clock_us - *last_us_ + kVelodyneHour_us) % kVelodyneHour_us);
      if (gap_us > 0.0 && gap_us < kTurnGapMost_us) {
        turned_us_ += gap_us;
        turned_deg_ += turned_deg(last_deg_, azimuth_deg);
      }
    }
    last_us_ = clock_us;
    last_deg_ = azimuth_deg;
    for (std::size_t block = 0; block < kVelodyneBlocks; ++block) {
      const auto sector = static_cast<std::size_t>(azimuth_at_block(payload, block)) / kSector_deg;
      if (sector < kSectors) seen_[sector] = true;
    }
    clock_.hear(1000 * clock_us, datagram.captured_ns, 1000 * kVelodyneHour_us);
    if (const double packet_us = packet_us_of(payload); packet_us > 0.0) {
      packets_.hear(clock_us, packet_us, kVelodyneHour_us);
    }
  }

  void describe(SourceSender* sender) const override {
    if (const char* const mode = return_mode(mode_)) add_fact(sender, "return mode", mode);
    if (turned_us_ > 0.0) add_fact(sender, "turn rate", rpm_text(turned_deg_ / 360.0 / (1e-6 * turned_us_)));
    add_fact(sender, translatable("clock"), translatable("microseconds of the hour"));
    if (turned_deg_ >= kTurnsForView * 360.0) {
      const auto [begin, sectors] = hole();
      const bool is_whole = sectors < kSectorsOfHole;
      const std::size_t first = (begin + sectors) % kSectors;
      add_fact(sender, "field of view",
               is_whole ? "360°" : fmt::format("{}°-{}°", kSector_deg * first, kSector_deg * (begin % kSectors)));
      // Outside of it nothing is sent: then what is missing cannot be told.
      if (is_whole) add_missing(sender, packets_);
    }
    add_oddity(sender, clock_.oddity());
  }

  std::optional<ClockReading> clock() const override {
    return last_us_ ? std::optional<ClockReading>({1000 * *last_us_, 1000 * kVelodyneHour_us}) : std::nullopt;
  }
  SensorState state() const override {
    SensorState state;
    state.clock = clock();
    if (turned_deg_ >= kTurnsForView * 360.0 && hole().second < kSectorsOfHole) state.missing = missing_of(packets_);
    return state;
  }

 private:
  static double azimuth_at_block(ByteView payload, std::size_t block) {
    return 0.01 * little_endian_at(payload, block * kVelodyneBlockBytes + 2, 2);
  }

  static double packet_us_of(ByteView payload) {
    for (const VelodyneModel model :
         {VelodyneModel::kVlp16, VelodyneModel::kVlp16HiRes, VelodyneModel::kHdl32e, VelodyneModel::kVlp32c}) {
      const VelodyneTraits& traits = velodyne_traits(model);
      if (traits.product == velodyne_product(payload)) return traits.packet_us(is_velodyne_dual(payload));
    }
    return 0.0;
  }

  // Most sectors in a row in which nothing was sent: the first, and how many.
  std::pair<std::size_t, std::size_t> hole() const {
    std::size_t begin = 0, longest = 0, row = 0;
    for (std::size_t i = 0; i < 2 * kSectors; ++i) {
      row = seen_[i % kSectors] ? 0 : row + 1;
      if (row <= longest) continue;
      longest = row;
      begin = i + 1 - row;
    }
    return {begin, longest};
  }

  std::uint32_t mode_ = 0;
  std::optional<std::int64_t> last_us_;
  double last_deg_ = 0.0, turned_deg_ = 0.0, turned_us_ = 0.0;
  std::array<bool, kSectors> seen_{};
  ClockBesideArrival clock_;
  MissingPackets packets_;
};

// Its manuals: the return mode and the speed in turns a minute in the tail, a number behind it.
class HesaiWords : public PacketWords {
 public:
  void hear(const Datagram& datagram) override {
    const ByteView payload = datagram.payload;
    const std::optional<HesaiModel> model = hesai_model_of(payload);
    if (!model) return;
    const HesaiTraits& traits = hesai_traits(*model);
    mode_ = little_endian_at(payload, traits.tail_at() + traits.mode_offset, 1);
    speed_rpm_ = little_endian_at(payload, traits.tail_at() + traits.speed_offset, 2);
    if (const std::optional<std::uint32_t> number = hesai_number(traits, payload)) {
      packets_.hear(*number, 1.0, std::int64_t{1} << 32);
    }
    clock_ns_ = hesai_clock_ns(traits, payload);
    tells_heat_ = traits.heat_offset != kHesaiNowhere;
    is_overheated_ = is_hesai_overheated(traits, payload);
    alerts_.hear(alert());
  }

  void describe(SourceSender* sender) const override {
    if (const char* const mode = hesai_return_mode(mode_)) add_fact(sender, "return mode", mode);
    if (speed_rpm_ > 0) add_fact(sender, "turn rate", rpm_text(speed_rpm_ / 60.0));
    add_missing(sender, packets_);
    alerts_.describe(sender);
  }

  std::optional<ClockReading> clock() const override {
    return clock_ns_ ? std::optional<ClockReading>({*clock_ns_}) : std::nullopt;
  }
  SensorState state() const override {
    SensorState state;
    if (tells_heat_) state.alert = alert();
    state.clock = clock();
    state.missing = missing_of(packets_);
    return state;
  }

 private:
  std::string alert() const { return is_overheated_ ? translatable("the sensor is too hot and pauses: cool it") : ""; }

  std::uint32_t mode_ = 0, speed_rpm_ = 0;
  std::optional<std::int64_t> clock_ns_;
  bool tells_heat_ = false, is_overheated_ = false;
  AlertsHeard alerts_;
  MissingPackets packets_;
};

// Livox-SDK2, packet of livox_lidar_def.h: a number, and the kind of time. A Mid-360's number begins anew with each
// frame; a HAP's and a Mid-360S' counts on to 65535 (issue 1 of Livox-SDK2).
class LivoxWords : public PacketWords {
 public:
  void hear(const Datagram& datagram) override {
    const ByteView payload = datagram.payload;
    if (!is_livox_data(payload)) return;
    constexpr std::size_t kCounterAt = 7, kTimeTypeAt = 11, kClockAt = 28;
    constexpr std::uint32_t kNumbers = 1U << 16U;
    is_dual_ = is_livox_dual(payload);
    time_type_ = little_endian_at(payload, kTimeTypeAt, 1);
    const std::uint32_t number = little_endian_at(payload, kCounterAt, 2);
    const bool is_counting_on = last_number_ >= kNumbers - kNumbersKept;
    if (number != 0 || is_counting_on) packets_.hear(number, 1.0, kNumbers);
    last_number_ = number;
    const std::uint64_t high = little_endian_at(payload, kClockAt + 4, 4);
    const std::uint64_t clock_ns = high << 32U | little_endian_at(payload, kClockAt, 4);
    clock_ns_ = static_cast<std::int64_t>(clock_ns & kClockMost);
    clock_.hear(clock_ns_, datagram.captured_ns, 0);
  }

  std::optional<ClockReading> clock() const override { return ClockReading{clock_ns_}; }
  SensorState state() const override {
    SensorState state;
    if (time_type_ < kTimeSources.size()) state.is_synchronised = time_type_ > 0;
    state.clock = clock();
    state.missing = missing_of(packets_);
    return state;
  }

  void describe(SourceSender* sender) const override {
    add_fact(sender, "return mode", is_dual_ ? translatable("two returns") : translatable("one return"));
    if (time_type_ < kTimeSources.size()) {
      add_fact(sender, "time source", kTimeSources[time_type_]);
      add_fact(sender, translatable("synchronised"), time_type_ > 0 ? translatable("yes") : translatable("no"));
    }
    add_missing(sender, packets_);
    add_oddity(sender, clock_.oddity());
  }

 private:
  static constexpr std::array<const char*, 3> kTimeSources = {translatable("none: since its start"), "PTP", "GPS"};

  bool is_dual_ = false;
  std::uint32_t time_type_ = 0, last_number_ = 0;
  std::int64_t clock_ns_ = 0;
  MissingPackets packets_;
  ClockBesideArrival clock_;
};

// Most of it stands in the metadata.
class OusterWords : public PacketWords {
 public:
  OusterWords(OusterMetadata metadata, const std::string& text)
      : metadata_(std::move(metadata)), page_(nlohmann::json::parse(text, nullptr, false)) {}

  bool is_data(ByteView payload) const {
    if (payload.size != ouster_packet_bytes(metadata_.profile, metadata_.rings, metadata_.columns_per_packet))
      return false;
    return metadata_.header == OusterHeader::kNone || ouster_head(metadata_.header, payload).is_lidar;
  }

  void hear(const Datagram& datagram) override {
    const ByteView payload = datagram.payload;
    if (!is_data(payload)) return;
    const bool has_head = metadata_.header != OusterHeader::kNone;
    const std::size_t column_at = has_head ? kOusterHeadBytes : 0;
    std::int64_t frame = 0;
    if (has_head) {
      const OusterHead head = ouster_head(metadata_.header, payload);
      frame = head.frame;
      serial_ = head.serial;
      head_ = head;
    } else {
      frame = little_endian_at(payload, column_at + 10, 2);
    }
    const std::uint64_t high = little_endian_at(payload, column_at + 4, 4);
    const std::uint64_t clock_ns = high << 32U | little_endian_at(payload, column_at, 4);
    clock_ns_ = static_cast<std::int64_t>(clock_ns & kClockMost);
    clock_.hear(clock_ns_, datagram.captured_ns, 0);
    alerts_.hear(alert());
    const std::int64_t columns = metadata_.columns_per_frame, of_packet = metadata_.columns_per_packet;
    // Within a window not all packets come, and which ones depends on the firmware.
    const bool is_all = !metadata_.window || metadata_.window->columns(metadata_.columns_per_frame) == columns;
    if (!is_all || columns % of_packet != 0) return;
    const std::int64_t packets = columns / of_packet;
    const std::int64_t frames = std::int64_t{1} << (metadata_.header == OusterHeader::kFusa ? 32 : 16);
    const std::int64_t index = little_endian_at(payload, column_at + 8, 2);
    packets_.hear(frame * packets + index / of_packet, 1.0, frames * packets);
  }

  void describe(SourceSender* sender) const override {
    if (!metadata_.product.empty()) add_fact(sender, "model", "Ouster " + metadata_.product);
    const std::uint64_t serial = serial_ != 0 ? serial_ : metadata_.serial;
    if (serial != 0) add_fact(sender, "serial", std::to_string(serial));
    add_told(sender, "firmware", "build_rev");
    add_fact(sender, translatable("profile"), metadata_.profile.name);
    add_told(sender, translatable("lidar mode"), "lidar_mode");
    add_told(sender, "time source", "timestamp_mode");
    if (metadata_.window) {
      add_fact(sender, translatable("column window"),
               fmt::format("{}-{} / {}", metadata_.window->first, metadata_.window->last, metadata_.columns_per_frame));
    }
    add_missing(sender, packets_);
    add_oddity(sender, clock_.oddity());
    alerts_.describe(sender);
  }

  std::optional<ClockReading> clock() const override { return ClockReading{clock_ns_}; }
  SensorState state() const override {
    SensorState state;
    if (metadata_.header != OusterHeader::kNone) state.alert = alert();
    state.clock = clock();
    state.missing = missing_of(packets_);
    return state;
  }

 private:
  // The steps as ouster-sdk names them (sensor_info.h, 46b7bcee).
  std::string alert() const {
    if (head_.is_shutting_down) return translatable("the sensor is too hot and will switch itself off: cool it");
    if (head_.limiting == kLimitingSoon)
      return translatable("the sensor is hot and will soon send fewer shots: cool it");
    if (head_.limiting > kLimitingSoon) {
      return fmt::format(kFewerShots, kLimitingStep_percent * (head_.limiting - kLimitingSoon));
    }
    return "";
  }

  void add_told(SourceSender* sender, const char* word, const char* key) const {
    for (const char* const group : {"", "sensor_info", "config_params"}) {
      const nlohmann::json* page = &page_;
      if (*group != '\0') page = page_.contains(group) ? &page_[group] : nullptr;
      if (page == nullptr || !page->is_object() || !page->contains(key) || !(*page)[key].is_string()) continue;
      const std::string told = (*page)[key].get<std::string>();
      if (!told.empty()) return add_fact(sender, word, told);
    }
  }

  OusterMetadata metadata_;
  nlohmann::json page_;
  std::uint64_t serial_ = 0;  // of the packets
  OusterHead head_;
  std::int64_t clock_ns_ = 0;
  AlertsHeard alerts_;
  MissingPackets packets_;
  ClockBesideArrival clock_;
};

// rs_driver 4eeadace: a number that begins anew with each frame. What is lost between two frames does not show.
class RoboSenseM1Words : public PacketWords {
 public:
  void hear(const Datagram& datagram) override {
    constexpr std::size_t kCounterAt = 4;
    if (!is_robosense_m1_data(datagram.payload)) return;
    packets_.hear(static_cast<std::int64_t>(robosense_number(datagram.payload, kCounterAt, 2)), 1.0,
                  std::int64_t{1} << 16);
  }

  void describe(SourceSender* sender) const override { add_missing(sender, packets_); }
  std::optional<ClockReading> clock() const override { return std::nullopt; }
  SensorState state() const override {
    SensorState state;
    state.missing = missing_of(packets_);
    return state;
  }

 private:
  MissingPackets packets_;
};

class LslidarWords : public PacketWords {
 public:
  void hear(const Datagram& datagram) override {
    const ByteView packet = lslidar_packet(datagram.payload);
    if (const std::optional<LslidarModel> model = lslidar_model_of(packet)) {
      is_dual_ = is_lslidar_dual(packet, lslidar_traits(*model));
    }
  }

  void describe(SourceSender* sender) const override {
    add_fact(sender, "return mode", is_dual_ ? translatable("two returns") : translatable("one return"));
  }

  std::optional<ClockReading> clock() const override { return std::nullopt; }
  SensorState state() const override { return {}; }

 private:
  bool is_dual_ = false;
};

}  // namespace

void MissingPackets::hear(std::int64_t number, double unit, std::int64_t modulus) {
  if (std::find(last_ones_.begin(), last_ones_.end(), number) != last_ones_.end()) {
    ++repeated_;
    return;
  }
  last_ones_.push_back(number);
  if (last_ones_.size() > kNumbersKept) last_ones_.pop_front();
  if (++heard_ == 1) {
    last_ = number;
    return;
  }
  std::int64_t ahead = (number - last_) % modulus;
  if (ahead < 0) ahead += modulus;
  if (ahead > modulus / 2) ahead -= modulus;
  const double packets = std::round(static_cast<double>(ahead) / unit);
  if (packets < 0.0 && packets > -static_cast<double>(kNumbersKept)) {
    ++late_;
    if (missing_ > 0) --missing_;
    return;
  }
  last_ = number;
  if (packets < 0.0 || packets > kJump) {
    last_ones_.assign(1, number);
    return;
  }
  ++steps_;
  if (packets > 1.0) missing_ += static_cast<std::uint64_t>(packets) - 1;
}

double MissingPackets::share() const {
  return missing_ == 0 ? 0.0 : static_cast<double>(missing_) / static_cast<double>(missing_ + heard_);
}

void ClockBesideArrival::hear(std::int64_t clock_ns, std::int64_t arrival_ns, std::int64_t modulus_ns) {
  if (heard_++ == 0) {
    first_arrival_ns_ = arrival_ns;
  } else {
    std::int64_t went_ns = clock_ns - last_ns_;
    if (modulus_ns > 0 && went_ns < -modulus_ns / 2) went_ns += modulus_ns;
    if (modulus_ns > 0 && went_ns > modulus_ns / 2) went_ns -= modulus_ns;
    went_ns_ += went_ns;
  }
  last_ns_ = clock_ns;
  last_arrival_ns_ = arrival_ns;
}

std::string ClockBesideArrival::oddity() const {
  const double went_s = 1e-9 * static_cast<double>(went_ns_);
  const double took_s = 1e-9 * static_cast<double>(last_arrival_ns_ - first_arrival_ns_);
  if (heard_ < kStandingLeast || took_s < kSpanLeast_s) return "";
  if (went_ns_ == 0) return say("its clock stands still while its packets came in {:.2f} s", took_s);
  if (std::abs(went_s - took_s) <= kClockShare * took_s + kClockApart_s) return "";
  return say("its clock went {:.2f} s while its packets came in {:.2f} s: it was set, or the recording has other times",
             went_s, took_s);
}

std::unique_ptr<PacketWords> packet_words_for(ByteView payload, const std::string& metadata) {
  if (!metadata.empty()) {
    try {
      auto ouster = std::make_unique<OusterWords>(parse_ouster_metadata(metadata), metadata);
      if (ouster->is_data(payload)) return ouster;
    } catch (const FrameError&) {
      return nullptr;  // the one who decodes tells
    }
  }
  // Of firmware 2 and 3 it is laid out as a Velodyne's.
  if (lslidar_model_of(lslidar_packet(payload))) return std::make_unique<LslidarWords>();
  if (is_velodyne_data(payload)) return std::make_unique<VelodyneWords>();
  if (hesai_model_of(payload)) return std::make_unique<HesaiWords>();
  if (is_livox_data(payload)) return std::make_unique<LivoxWords>();
  if (is_robosense_m1_data(payload)) return std::make_unique<RoboSenseM1Words>();
  return nullptr;
}

}  // namespace pose_wall::tools
