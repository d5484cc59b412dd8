// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/hesai_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "csv/csv_table.hpp"
#include "language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uint16_t kHesaiPacketFlag = 0xFFEE;  // bytes EE FF
constexpr std::uint16_t kHesaiBlockFlag = 0xEEFF;   // bytes FF EE
constexpr std::size_t kHesaiHeadBytes = 12;
constexpr std::uint8_t kDistanceUnit_mm = 4;
constexpr std::size_t kSequenceBytes = 4;
constexpr double kElevationMax_deg = 90.0, kAzimuthMax_deg = 180.0;

// PandarXT-32 user manual: appendix I (design values) and II (times).
HesaiTraits xt32() {
  HesaiTraits traits{
      HesaiModel::kXt32, "Hesai PandarXT-32", 32, 8, kHesaiHeadBytes, 2, 4, 24, 10, 50'000.0, 5'632.0, true, {}, {}};
  for (int i = 0; i < 32; ++i) {
    traits.firing_ns.push_back(368 + 1'512 * i);
    traits.design_angles.push_back({15.0 - i, 0.0});
  }
  return traits;
}

// Pandar40P user manual: appendix I (design values; the same table as of the Pandar40) and II (times).
HesaiTraits pandar40p() {
  HesaiTraits traits{
      HesaiModel::kPandar40p, "Hesai Pandar40P", 40, 10, 0, 4, 3, 22, 14, 55'560.0, -28'580.0, true, {}, {}};
  traits.firing_ns = {-42220, -28470, -16040, -3620,  -45490, -31740, -47460, -54670, -20620, -33710,
                      -40910, -8190,  -20620, -27160, -50730, -8190,  -14740, -36980, -45490, -52700,
                      -23890, -31740, -38950, -11470, -18650, -25190, -48760, -6230,  -12770, -35010,
                      -21920, -9500,  -43520, -29770, -17350, -4920,  -42220, -28470, -16040, -3620};
  for (const double top_deg : {15.0, 11.0, 8.0, 5.0, 3.0, 2.0}) traits.design_angles.push_back({top_deg, -1.042});
  // A third of a degree apart, three columns of lasers in turn.
  constexpr std::array<double, 3> kColumns_deg = {3.125, -5.208, -1.042};
  for (int i = 0; i < 24; ++i) {
    const double elevation_deg = std::round(100.0 * (5 - i) / 3.0) / 100.0;
    traits.design_angles.push_back({elevation_deg, kColumns_deg[static_cast<std::size_t>(i % 3)]});
  }
  for (const double low_deg : {-7.0, -8.0, -9.0, -10.0, -11.0, -12.0, -13.0, -14.0, -19.0, -25.0}) {
    traits.design_angles.push_back({low_deg, -1.042});
  }
  return traits;
}

// PandarQT user manual: appendix I (design values) and II (times). The maker's table of angles is also PandarQT64.csv
// of tier4/nebula.
HesaiTraits qt64() {
  HesaiTraits traits{HesaiModel::kQt64,
                     "Hesai PandarQT",
                     64,
                     4,
                     kHesaiHeadBytes,
                     2,
                     4,
                     24,
                     16,
                     500'000.0 / 3.0,
                     25'710.0,
                     false,
                     {},
                     {}};
  traits.firing_ns = {12310,  14370,  16430,  18490,  20540,  22600,  24660,  26710,  29160,  31220,  33280,
                      35340,  37390,  39450,  41500,  43560,  46610,  48670,  50730,  52780,  54840,  56900,
                      58950,  61010,  63450,  65520,  67580,  69630,  71690,  73740,  75800,  77860,  80900,
                      82970,  85020,  87080,  89140,  91190,  93250,  95300,  97750,  99820,  101870, 103930,
                      105980, 108040, 110100, 112150, 115200, 117260, 119320, 121380, 123430, 125490, 127540,
                      129600, 132050, 134110, 136170, 138220, 140280, 142340, 144390, 146450};
  traits.design_angles = {
      {-52.121, 8.736},  {-49.785, 8.314},  {-47.577, 7.964},  {-45.477, 7.669},  {-43.465, 7.417},  {-41.528, 7.198},
      {-39.653, 7.007},  {-37.831, 6.838},  {-36.055, 6.688},  {-34.320, 6.554},  {-32.619, 6.434},  {-30.950, 6.326},
      {-29.308, 6.228},  {-27.690, 6.140},  {-26.094, 6.059},  {-24.517, 5.987},  {-22.964, -5.270}, {-21.420, -5.216},
      {-19.889, -5.167}, {-18.372, -5.123}, {-16.865, -5.083}, {-15.368, -5.047}, {-13.880, -5.016}, {-12.399, -4.988},
      {-10.925, -4.963}, {-9.457, -4.942},  {-7.994, -4.924},  {-6.535, -4.910},  {-5.079, -4.898},  {-3.626, -4.889},
      {-2.175, -4.884},  {-0.725, -4.881},  {0.725, 5.493},    {2.175, 5.496},    {3.626, 5.502},    {5.079, 5.512},
      {6.534, 5.525},    {7.993, 5.541},    {9.456, 5.561},    {10.923, 5.584},   {12.397, 5.611},   {13.877, 5.642},
      {15.365, 5.676},   {16.861, 5.716},   {18.368, 5.759},   {19.885, 5.808},   {21.415, 5.862},   {22.959, 5.921},
      {24.524, -5.330},  {26.101, -5.396},  {27.697, -5.469},  {29.315, -5.550},  {30.957, -5.640},  {32.627, -5.740},
      {34.328, -5.850},  {36.064, -5.974},  {37.840, -6.113},  {39.662, -6.269},  {41.537, -6.447},  {43.475, -6.651},
      {45.487, -6.887},  {47.587, -7.163},  {49.795, -7.493},  {52.133, -7.892}};
  return traits;
}

std::uint8_t byte_at(ByteView payload, std::size_t offset) {
  return std::to_integer<std::uint8_t>(payload.data[offset]);
}

std::uint8_t mode_of(const HesaiTraits& traits, ByteView payload) {
  return byte_at(payload, traits.bytes() - traits.tail_bytes + traits.mode_offset);
}

// Return modes as all of them number them: one return, two returns.
bool is_single(std::uint8_t mode) {
  return mode == 0x33 || mode == 0x34 || mode == 0x37 || mode == 0x38;
}

bool is_dual(std::uint8_t mode) {
  return mode == 0x39 || mode == 0x3A || mode == 0x3B || mode == 0x3C || mode == 0x3E;
}

bool has_head(ByteView payload) {
  return payload.size >= kHesaiHeadBytes && little_endian_at(payload, 0, 2) == kHesaiPacketFlag;
}

// What says in its head how many lasers and blocks it has, and that a number ends it.
bool fits_head(const HesaiTraits& traits, ByteView payload) {
  if (!has_head(payload)) return false;
  const bool has_sequence = (byte_at(payload, 11) & 1U) != 0;
  return byte_at(payload, 6) == traits.lasers && byte_at(payload, 7) == traits.blocks &&
         byte_at(payload, 9) == kDistanceUnit_mm &&
         payload.size >= traits.bytes() + (has_sequence ? kSequenceBytes : 0U);
}

bool fits(const HesaiTraits& traits, ByteView payload) {
  if (traits.head_bytes > 0 && !fits_head(traits, payload)) return false;
  if (traits.head_bytes == 0 && payload.size != traits.bytes() && payload.size != traits.bytes() + kSequenceBytes) {
    return false;
  }
  for (std::size_t block = 0; block < traits.blocks; ++block) {
    const std::size_t start = traits.head_bytes + block * traits.block_bytes();
    if (traits.block_head_bytes == 4 && little_endian_at(payload, start, 2) != kHesaiBlockFlag) return false;
    if (little_endian_at(payload, start + traits.block_head_bytes - 2, 2) >= 36000) return false;
  }
  const std::uint8_t mode = mode_of(traits, payload);
  return is_single(mode) || is_dual(mode);
}

}  // namespace

double HesaiTraits::firing_start_ns(std::size_t firing, std::size_t firings) const {
  const double from_known = static_cast<double>(firing) - (last_is_known ? static_cast<double>(firings - 1) : 0.0);
  return known_block_ns + from_known * block_ns;
}

const HesaiTraits& hesai_traits(HesaiModel model) {
  static const std::array<HesaiTraits, 3> traits = {xt32(), pandar40p(), qt64()};
  return traits[static_cast<std::size_t>(model)];
}

std::optional<HesaiModel> hesai_model_of(ByteView payload) {
  for (const HesaiModel model : {HesaiModel::kXt32, HesaiModel::kPandar40p, HesaiModel::kQt64}) {
    if (fits(hesai_traits(model), payload)) return model;
  }
  return std::nullopt;
}

std::string unread_hesai(ByteView payload) {
  if (!has_head(payload) || hesai_model_of(payload)) return "";
  // Pandar64 and Pandar20 have a shorter head.
  const bool is_short = byte_at(payload, 2) == 64 || byte_at(payload, 2) == 20;
  const std::size_t lasers = is_short ? 2 : 6;
  return say("a Hesai of {} lasers in {} blocks", byte_at(payload, lasers), byte_at(payload, lasers + 1));
}

bool is_hesai_dual(const HesaiTraits& traits, ByteView payload) {
  return is_dual(mode_of(traits, payload));
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
