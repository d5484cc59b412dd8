// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/hesai_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <sstream>

#include "io/csv/csv_table.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uint16_t kHesaiPacketFlag = 0xFFEE;  // bytes EE FF
constexpr std::uint16_t kHesaiBlockFlag = 0xEEFF;   // bytes FF EE
constexpr std::size_t kHesaiHeadBytes = 12;
constexpr std::size_t kFlagsAt = 11;  // in the longer head
constexpr std::uint8_t kHasSequence = 0x01, kHasSafety = 0x04, kHasConfidence = 0x10, kHasOwnChannels = 0x40;
constexpr std::size_t kSequenceBytes = 4;
constexpr std::uint16_t kXtProtocol = 0x0106;  // 6.1, as HesaiLidar_SDK_2.0 tells an XT from others
constexpr std::uint16_t kQt64Protocol = 0x0103, kQt128Protocol = 0x0203;  // 3.1, 3.2
// Of a tail's date: years since 1900, or a first byte of 0 and the seconds since 1970 in the last four, the highest
// byte first. Bit 0 of the byte of heat.
constexpr std::uint8_t kCentury = 100, kPauses = 0x01;
constexpr std::size_t kDateBytes = 6;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kElevationMax_deg = 90.0, kAzimuthMax_deg = 180.0;

std::uint8_t byte_at(ByteView payload, std::size_t offset) {
  return std::to_integer<std::uint8_t>(payload.data[offset]);
}

std::uint8_t mode_of(const HesaiTraits& traits, ByteView payload) {
  return byte_at(payload, traits.tail_at() + traits.mode_offset);
}

// Return modes as all of them number them; 0: none of these.
std::size_t returns_of_mode(std::uint8_t mode) {
  switch (mode) {
    case 0x33:
    case 0x34:
    case 0x37:
    case 0x38:
      return 1;
    case 0x39:
    case 0x3A:
    case 0x3B:
    case 0x3C:
    case 0x3E:
      return 2;
    case 0x3D:
      return 3;
    default:
      return 0;
  }
}

bool has_head(ByteView payload) {
  return payload.size >= kHesaiHeadBytes && little_endian_at(payload, 0, 2) == kHesaiPacketFlag;
}

// Those that HesaiLidar_SDK_2.0 (ea7f86f) tells apart so and that are not read (udp_parser.cc); "": none of these.
std::string name_by_protocol(ByteView payload) {
  constexpr std::uint8_t kFirstOt128 = 128, kFirstJt128 = 137;  // byte 4
  switch (little_endian_at(payload, 2, 2)) {
    case 0x0401: {
      const std::uint8_t kind = byte_at(payload, 4);
      return kind >= kFirstJt128 ? "a Hesai JT128" : kind >= kFirstOt128 ? "a Hesai OT128" : "a Hesai Pandar128";
    }
    case 0x0801:
      return "a Hesai JT16";
    case 0x0104:
    case 0x0304:
      return "a Hesai AT128";
    case 0x0704:
      return "a Hesai ATX";
    default:
      return "";
  }
}

// Where a head tells lasers and unit; the number of blocks follows that of lasers.
struct HeadPlaces {
  std::size_t lasers, unit;
};

HeadPlaces head_places(std::size_t head_bytes) {
  return head_bytes == kHesaiShortHeadBytes ? HeadPlaces{2, 5} : HeadPlaces{6, 9};
}

// Whose packets have such a head, apart from the unit of ranges and what else they hold.
bool is_shaped(const HesaiTraits& traits, ByteView payload) {
  if (traits.head_bytes == 0 || !has_head(payload)) return false;
  if (traits.protocol != 0 && little_endian_at(payload, 2, 2) != traits.protocol) return false;
  const std::size_t lasers_at = head_places(traits.head_bytes).lasers;
  return byte_at(payload, lasers_at) == traits.lasers() && byte_at(payload, lasers_at + 1) == traits.blocks;
}

long unit_mm(const HesaiTraits& traits) {
  return std::lround(1e3 * traits.beams.ranges.unit_m);
}

std::uint8_t told_unit_mm(const HesaiTraits& traits, ByteView payload) {
  return byte_at(payload, head_places(traits.head_bytes).unit);
}

bool has_flags(const HesaiTraits& traits, ByteView payload) {
  return (byte_at(payload, kFlagsAt) & traits.flags_looked_at) == traits.flags;
}

// Those with the longer head say there whether a number ends a packet; of the others its length does.
bool has_length(const HesaiTraits& traits, ByteView payload) {
  if (traits.head_bytes == kHesaiHeadBytes) {
    const bool has_sequence = (byte_at(payload, kFlagsAt) & kHasSequence) != 0;
    return payload.size >= traits.bytes() + (has_sequence ? kSequenceBytes : 0U);
  }
  return payload.size == traits.bytes() || payload.size == traits.bytes() + kSequenceBytes;
}

bool fits(const HesaiTraits& traits, ByteView payload) {
  const bool has_its_head = traits.head_bytes == 0 || (is_shaped(traits, payload) && has_flags(traits, payload) &&
                                                       told_unit_mm(traits, payload) == unit_mm(traits));
  if (!has_its_head || !has_length(traits, payload)) return false;
  for (std::size_t block = 0; block < traits.blocks; ++block) {
    const std::size_t start = traits.head_bytes + block * traits.block_bytes();
    if (traits.block_head_bytes == 4 && little_endian_at(payload, start, 2) != kHesaiBlockFlag) return false;
    if (little_endian_at(payload, start + traits.block_head_bytes - 2, 2) >= 36000) return false;
  }
  const std::size_t returns = returns_of_mode(mode_of(traits, payload));
  return returns >= 1 && returns <= traits.returns_most;
}

}  // namespace

double HesaiTraits::firing_start_ns(std::size_t firing, std::size_t firings) const {
  const double from_known = static_cast<double>(firing) - (last_is_known ? static_cast<double>(firings - 1) : 0.0);
  return known_firing_ns + from_known * beams.cycle_ns;
}

const HesaiTraits& hesai_traits(HesaiModel model) {
  // Appendix II of each manual has the times: of a packet, and the first one of a laser. Those of an XT32M count from
  // its last of six blocks, as HesaiLidar_SDK_2.0 does (udp6_1_parser.cc) and as three returns do in Nebula. Where a
  // tail has date, microseconds and heat is as in that SDK (udp_protocol_*.h, ea7f86f).
  static const std::array<HesaiTraits, kHesaiModels.size()> traits = {
      {{HesaiModel::kXt32, hesai_xt32(), 8, kHesaiHeadBytes, 2, 4, 24, 10, 11, 13, 19, 9, 368.0, 5'632.0, true,
        kXtProtocol},
       {HesaiModel::kPandar40p, hesai_pandar40p(), 10, 0, 4, 3, 22, 14, 8, 16, 10, 5, -54'670.0, -28'580.0, true},
       {HesaiModel::kQt64, hesai_qt64(), 4, kHesaiHeadBytes, 2, 4, 24, 16, 10, 18, 12, 6, 12'310.0, 25'710.0, false,
        kQt64Protocol},
       {HesaiModel::kXt16, hesai_xt16(), 8, kHesaiHeadBytes, 2, 4, 24, 10, 11, 13, 19, 9, 368.0, 5'632.0, true,
        kXtProtocol},
       {HesaiModel::kXt32m, hesai_xt32m(), 6, kHesaiHeadBytes, 2, 4, 24, 10, 11, 13, 19, 9, 368.0, 5'632.0, true,
        kXtProtocol, 3},
       // Checksum and state of its safety stand before its tail, as HesaiLidar_SDK_2.0 has it (udp_protocol_v3_2.h).
       {HesaiModel::kQt128, hesai_qt128(), 2, kHesaiHeadBytes, 2, 4, 47, 33, 34, 36, 42, kHesaiNowhere, 1'028.0,
        9'000.0, false, kQt128Protocol, 2, kHasSafety | kHasConfidence | kHasOwnChannels, kHasSafety | kHasConfidence},
       {HesaiModel::kPandar64, hesai_pandar64(), 6, kHesaiShortHeadBytes, 2, 3, 22, 14, 8, 16, 10, 5, -54'668.0,
        -42'580.0, true}}};
  return traits[static_cast<std::size_t>(model)];
}

std::optional<HesaiModel> hesai_model_of(ByteView payload) {
  for (const HesaiModel model : kHesaiModels) {
    if (fits(hesai_traits(model), payload)) return model;
  }
  return std::nullopt;
}

std::string unread_hesai(ByteView payload) {
  if (!has_head(payload) || hesai_model_of(payload)) return "";
  for (const HesaiModel model : kHesaiModels) {
    const HesaiTraits& traits = hesai_traits(model);
    if (!is_shaped(traits, payload)) continue;
    if (const std::uint8_t told_mm = told_unit_mm(traits, payload); told_mm != unit_mm(traits)) {
      return say("a {} that counts ranges in {} mm, and not in {} mm", traits.title(), told_mm, unit_mm(traits));
    }
    if (!has_flags(traits, payload)) {
      return say("a {} whose packets hold something else than usual (byte 11 is {:02x})", traits.title(),
                 byte_at(payload, kFlagsAt));
    }
  }
  // Pandar64 and Pandar20 have a shorter head.
  const bool is_short = byte_at(payload, 2) == 64 || byte_at(payload, 2) == 20;
  const std::size_t lasers = head_places(is_short ? kHesaiShortHeadBytes : kHesaiHeadBytes).lasers;
  std::string name = is_short ? "" : name_by_protocol(payload);
  if (!name.empty()) return name;
  return say("a Hesai of {} lasers in {} blocks", byte_at(payload, lasers), byte_at(payload, lasers + 1));
}

std::optional<std::uint32_t> hesai_number(const HesaiTraits& traits, ByteView payload) {
  const bool tells = traits.head_bytes == kHesaiHeadBytes;
  const bool has_it = !tells || (byte_at(payload, kFlagsAt) & kHasSequence) != 0;
  if (!has_it || payload.size < traits.bytes() + kSequenceBytes) return std::nullopt;
  return little_endian_at(payload, traits.bytes(), kSequenceBytes);
}

std::optional<std::int64_t> hesai_clock_ns(const HesaiTraits& traits, ByteView payload) {
  const std::size_t at = traits.tail_at() + traits.date_offset;
  // A Pandar40P and a Pandar64 leave the century out, and have no other form of a date.
  const bool has_century = traits.head_bytes == kHesaiHeadBytes;
  std::int64_t seconds = 0;
  if (byte_at(payload, at) != 0 || !has_century) {
    std::tm date{};
    date.tm_year = byte_at(payload, at) + (has_century ? 0 : kCentury);
    date.tm_mon = byte_at(payload, at + 1) - 1;
    date.tm_mday = byte_at(payload, at + 2);
    date.tm_hour = byte_at(payload, at + 3);
    date.tm_min = byte_at(payload, at + 4);
    date.tm_sec = byte_at(payload, at + 5);
    const bool is_date = date.tm_mon >= 0 && date.tm_mon < 12 && date.tm_mday >= 1 && date.tm_mday <= 31 &&
                         date.tm_hour < 24 && date.tm_min < 60 && date.tm_sec <= 60;
    if (!is_date) return std::nullopt;
    seconds = timegm(&date);
  } else {
    for (std::size_t i = 2; i < kDateBytes; ++i) seconds = seconds << 8 | byte_at(payload, at + i);
    if (seconds == 0) return std::nullopt;
  }
  return kSecond_ns * seconds + 1000 * hesai_clock_us(traits, payload);
}

std::int64_t hesai_clock_us(const HesaiTraits& traits, ByteView payload) {
  return little_endian_at(payload, traits.tail_at() + traits.micros_offset, 4);
}

bool is_hesai_overheated(const HesaiTraits& traits, ByteView payload) {
  return traits.heat_offset != kHesaiNowhere &&
         (byte_at(payload, traits.tail_at() + traits.heat_offset) & kPauses) != 0;
}

std::size_t hesai_returns(const HesaiTraits& traits, ByteView payload) {
  return returns_of_mode(mode_of(traits, payload));
}

std::vector<HesaiLaser> parse_hesai_angles(const std::string& text, std::size_t lasers) {
  std::istringstream stream(text);
  std::vector<HesaiLaser> angles(lasers);
  std::vector<bool> seen(lasers, false);
  try {
    const CsvTable table = CsvTable::parse(stream);
    if (table.head().size() < 3)
      throw FrameError(tr("the table of angles has no columns of laser, elevation and azimuth"));
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const double number = table.number(row, 0);
      if (!(number >= 1.0 && number <= static_cast<double>(lasers)) || number != std::floor(number)) {
        throw FrameError(say("the table of angles has a laser '{}'; 1 to {} are allowed", table.cell(row, 0), lasers));
      }
      const auto laser = static_cast<std::size_t>(number) - 1;
      if (seen[laser]) throw FrameError(say("the table of angles has laser {} twice", number));
      seen[laser] = true;
      angles[laser] = {table.number(row, 1), table.number(row, 2)};
      if (!(std::fabs(angles[laser].elevation_deg) <= kElevationMax_deg) ||
          !(std::fabs(angles[laser].azimuth_deg) <= kAzimuthMax_deg)) {
        throw FrameError(
            say("the table of angles has elevation '{}' and azimuth '{}' for laser {}; -90 to 90 "
                "and -180 to 180 are allowed",
                table.cell(row, 1), table.cell(row, 2), number));
      }
    }
  } catch (const CsvError& fault) {
    throw FrameError(say("the table of angles: {}", fault.what()));
  }
  const auto missing = std::find(seen.begin(), seen.end(), false);
  if (missing != seen.end()) {
    throw FrameError(say("the table of angles has no laser {}; {} are needed", missing - seen.begin() + 1, lasers));
  }
  return angles;
}

}  // namespace pose_wall::tools
