// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/ouster_metadata.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "io/frames/frame.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

using Json = nlohmann::json;

constexpr double kMetresPerMm = 1e-3;
constexpr std::uint32_t kOusterRingsMost = 128;
// Of firmware 1, which does not tell it (ouster-sdk, data_format.cpp).
constexpr std::uint32_t kColumnsOfEarlyPackets = 16;
// "122201000998": all serial numbers that ouster-sdk's captures hold.
constexpr std::size_t kSerialDigits = 12;
// Beams begin 12 to 28 mm out, the lidar lies 36 to 78 mm above the base: more by far is a wrong unit.
constexpr double kLensMost_m = 0.5;
constexpr std::int64_t kTurn_mdeg = 360'000;
// Metadata has three digits and more.
constexpr double kTurnTolerance = 0.01;

// Firmware 3 groups what earlier ones wrote side by side.
const Json* find(const Json& page, const char* key) {
  if (page.contains(key)) return &page[key];
  for (const char* group :
       {"beam_intrinsics", "lidar_intrinsics", "lidar_data_format", "sensor_info", "config_params"}) {
    if (page.contains(group) && page[group].is_object() && page[group].contains(key)) return &page[group][key];
  }
  return nullptr;
}

const Json& need(const Json& page, const char* key) {
  const Json* found = find(page, key);
  if (found == nullptr) throw FrameError(say("the metadata has no '{}'", key));
  return *found;
}

std::uint32_t count_of(const Json& format, const char* key, std::uint32_t max) {
  const Json& value = need(format, key);
  if (!value.is_number_integer() || value.get<std::int64_t>() < 1 || value.get<std::int64_t>() > max) {
    throw FrameError(say("the metadata's '{}' is {}; 1 to {} is allowed", key, value.dump(), max));
  }
  return value.get<std::uint32_t>();
}

std::vector<double> numbers_of(const Json& value, const char* key, std::size_t count) {
  const bool is_list = value.is_array() && value.size() == count &&
                       std::all_of(value.begin(), value.end(), [](const Json& item) { return item.is_number(); });
  if (!is_list) throw FrameError(say("the metadata's '{}' is no list of {} numbers", key, count));
  return value.get<std::vector<double>>();
}

std::string text_at(const Json& page, const char* key) {
  const Json* const value = find(page, key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : "";
}

OusterProfile profile_of(const Json& format) {
  const std::string told = text_at(format, "udp_profile_lidar"), name = told.empty() ? "LEGACY" : told;
  if (const OusterProfile* const profile = ouster_profile(name)) return *profile;
  std::vector<std::string> known;
  for (const OusterProfile& profile : ouster_profiles()) known.emplace_back(profile.name);
  if (name == "OFF") throw FrameError(tr("udp_profile_lidar is OFF: the sensor sends no points"));
  throw FrameError(say("udp_profile_lidar '{}' is not read; {} are", name, fmt::join(known, ", ")));
}

// Firmware 3.1 has the other head with one profile, and does not tell it; firmware 3.2 has it with all, and does.
OusterHeader header_of(const Json& page, const Json& format, const OusterProfile& profile) {
  if (profile.is_legacy()) return OusterHeader::kNone;
  const std::string of_format = text_at(format, "header_type");
  const std::string told = of_format.empty() ? text_at(page, "header_type") : of_format;
  const bool is_fusa = told == "FUSA" || (told.empty() && std::string(profile.name).rfind("FUSA_", 0) == 0);
  if (!told.empty() && told != "FUSA" && told != "STANDARD") {
    throw FrameError(say("header_type '{}' is not read; STANDARD and FUSA are", told));
  }
  return is_fusa ? OusterHeader::kFusa : OusterHeader::kStandard;
}

// What people write into a file made by hand is not compared.
std::uint64_t serial_of(const Json& page) {
  const std::string text = text_at(page, "prod_sn");
  const bool is_number = std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return is_number && text.size() == kSerialDigits ? std::stoull(text) : 0;
}

std::optional<OusterWindow> window_of(const Json& format, std::uint32_t columns) {
  const Json* const value = find(format, "column_window");
  if (value == nullptr || value->is_null()) return std::nullopt;
  const auto is_column = [&](const Json& item) {
    return item.is_number_integer() && item.get<std::int64_t>() >= 0 && item.get<std::int64_t>() < columns;
  };
  if (!value->is_array() || value->size() != 2 || !std::all_of(value->begin(), value->end(), is_column)) {
    throw FrameError(
        say("the metadata's 'column_window' is {}; two columns of 0 to {} are allowed", value->dump(), columns - 1));
  }
  return OusterWindow{(*value)[0].get<std::uint32_t>(), (*value)[1].get<std::uint32_t>()};
}

// Where the columns are not told: thousandths of a degree, the way the encoder counts, which is against the columns.
// Windows of firmware 2.3 to 3.1 in ouster-sdk's captures are these, but for one that begins a column later.
std::optional<OusterWindow> window_of_azimuth(const Json& page, std::uint32_t columns) {
  const Json* const value = find(page, "azimuth_window");
  const auto is_angle = [](const Json& item) {
    return item.is_number_integer() && item.get<std::int64_t>() >= 0 && item.get<std::int64_t>() <= kTurn_mdeg;
  };
  if (value == nullptr || !value->is_array() || value->size() != 2) return std::nullopt;
  if (!std::all_of(value->begin(), value->end(), is_angle)) return std::nullopt;
  const auto from_mdeg = (*value)[0].get<std::int64_t>(), to_mdeg = (*value)[1].get<std::int64_t>();
  if (to_mdeg - from_mdeg == kTurn_mdeg) return OusterWindow{0, columns - 1};
  const std::int64_t first = ((kTurn_mdeg - to_mdeg) * columns + kTurn_mdeg - 1) / kTurn_mdeg;
  const std::int64_t last = (kTurn_mdeg - from_mdeg) * columns / kTurn_mdeg;
  return OusterWindow{static_cast<std::uint32_t>(first % columns), static_cast<std::uint32_t>(last % columns)};
}

// Firmware 1.13 has rows for the lasers of an OS1-64 in an OS-1-16 and an OS-1-32: 0 and 0 where there is none. One
// such row alone may be a beam.
void drop_rows_without_laser(OusterMetadata* metadata) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < metadata->rings; ++i) {
    if (metadata->altitude_deg[i] == 0.0 && metadata->azimuth_deg[i] == 0.0) rows.push_back(i);
  }
  if (rows.size() < 2 || rows.size() == metadata->rings) return;
  for (const std::size_t row : rows) metadata->altitude_deg[row] = std::numeric_limits<double>::quiet_NaN();
}

// Beams come from the top, as rows of an image; those of a sensor differ by a seventh of a degree or more.
void check_beams(const OusterMetadata& metadata) {
  const std::vector<double>& altitude_deg = metadata.altitude_deg;
  double above_deg = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < altitude_deg.size(); ++i) {
    if (!metadata.has_laser(i)) continue;
    if (std::abs(altitude_deg[i]) > 90.0 || std::abs(metadata.azimuth_deg[i]) > 360.0) {
      throw FrameError(
          say("the metadata's beam {} has the altitude {} and the azimuth {} degrees; -90 to 90 and -360 "
              "to 360 are allowed",
              i, altitude_deg[i], metadata.azimuth_deg[i]));
    }
    if (altitude_deg[i] < above_deg) {
      above_deg = altitude_deg[i];
      continue;
    }
    throw FrameError(
        say("the metadata's 'beam_altitude_angles' do not fall from beam to beam ({} degrees, then {}): "
            "they are not those of a sensor; read the metadata from it again",
            above_deg, altitude_deg[i]));
  }
}

// Where beams begin by the design: firmware before 2.0 does not tell (ouster-sdk, sensor_info.cpp).
double designed_origin_mm(const std::string& product) {
  constexpr std::array<std::pair<const char*, double>, 3> kOrigins_mm = {
      {{"OS-0-", 27.67}, {"OS-1-", 15.806}, {"OS-2-", 13.762}}};
  for (const auto& [kind, origin_mm] : kOrigins_mm) {
    if (product.rfind(kind, 0) == 0) return origin_mm;
  }
  throw FrameError(
      say("the metadata has no 'lidar_origin_to_beam_origin_mm', and '{}' names no product whose design is known",
          product));
}

void check_lens(const OusterMetadata& metadata) {
  const double lens_m = std::hypot(metadata.beam_origin_out_m, metadata.beam_origin_up_m);
  if (!(lens_m <= kLensMost_m)) {
    throw FrameError(
        say("the metadata's beams begin {} mm from the centre; up to {} are allowed", lens_m * 1e3, kLensMost_m * 1e3));
  }
}

// It turns and shifts; anything else would stretch distances.
void check_turn(const std::array<double, 16>& turn) {
  const auto is_near = [](double value, double wanted) { return std::abs(value - wanted) < kTurnTolerance; };
  bool is_turn = is_near(turn[12], 0.0) && is_near(turn[13], 0.0) && is_near(turn[14], 0.0) && is_near(turn[15], 1.0);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t other = row; other < 3; ++other) {
      double product = 0.0;
      for (std::size_t i = 0; i < 3; ++i) product += turn[4 * row + i] * turn[4 * other + i];
      is_turn = is_turn && is_near(product, row == other ? 1.0 : 0.0);
    }
    is_turn = is_turn && std::abs(turn[4 * row + 3]) <= kLensMost_m;
  }
  const double volume = turn[0] * (turn[5] * turn[10] - turn[6] * turn[9]) -
                        turn[1] * (turn[4] * turn[10] - turn[6] * turn[8]) +
                        turn[2] * (turn[4] * turn[9] - turn[5] * turn[8]);
  if (is_turn && volume > 0.0) return;
  throw FrameError(
      say("the metadata's 'lidar_to_sensor_transform' is no rotation with a shift of up to {} mm", kLensMost_m * 1e3));
}

void read_geometry(const Json& page, OusterMetadata& metadata) {
  metadata.altitude_deg = numbers_of(need(page, "beam_altitude_angles"), "beam_altitude_angles", metadata.rings);
  metadata.azimuth_deg = numbers_of(need(page, "beam_azimuth_angles"), "beam_azimuth_angles", metadata.rings);
  if (const Json* const beam = find(page, "beam_to_lidar_transform")) {
    const std::vector<double> transform = numbers_of(*beam, "beam_to_lidar_transform", 16);
    metadata.beam_origin_out_m = transform[3] * kMetresPerMm;
    metadata.beam_origin_up_m = transform[11] * kMetresPerMm;
  } else if (const Json* const origin = find(page, "lidar_origin_to_beam_origin_mm")) {
    if (!origin->is_number()) throw FrameError(tr("the metadata's 'lidar_origin_to_beam_origin_mm' is no number"));
    metadata.beam_origin_out_m = origin->get<double>() * kMetresPerMm;
  } else if (text_at(page, "build_rev").rfind("v1.", 0) == 0) {
    metadata.beam_origin_out_m = designed_origin_mm(metadata.product) * kMetresPerMm;
  } else {
    need(page, "lidar_origin_to_beam_origin_mm");
  }
  const std::vector<double> transform =
      numbers_of(need(page, "lidar_to_sensor_transform"), "lidar_to_sensor_transform", 16);
  std::copy(transform.begin(), transform.end(), metadata.sensor_from_lidar.begin());
  for (const std::size_t shift : {3U, 7U, 11U}) metadata.sensor_from_lidar[shift] *= kMetresPerMm;
  drop_rows_without_laser(&metadata);
  check_beams(metadata);
  check_lens(metadata);
  check_turn(metadata.sensor_from_lidar);
}

// Firmware 1 tells the mode alone: "1024x10" is 1,024 columns.
void read_early_format(const Json& page, OusterMetadata& metadata) {
  const std::string mode = text_at(page, "lidar_mode");
  const Json* const altitudes = find(page, "beam_altitude_angles");
  for (const std::uint32_t columns : kOusterColumns) {
    if (mode.rfind(fmt::format("{}x", columns), 0) == 0) metadata.columns_per_frame = columns;
  }
  if (metadata.columns_per_frame == 0 || altitudes == nullptr || !altitudes->is_array() || altitudes->empty() ||
      altitudes->size() > kOusterRingsMost) {
    throw FrameError(tr("the metadata has no 'data_format'"));
  }
  metadata.rings = static_cast<std::uint32_t>(altitudes->size());
  metadata.columns_per_packet = kColumnsOfEarlyPackets;
}

void read_format(const Json& page, const Json& format, OusterMetadata& metadata) {
  metadata.profile = profile_of(format);
  metadata.header = header_of(page, format, metadata.profile);
  metadata.rings = count_of(format, "pixels_per_column", kOusterRingsMost);
  metadata.columns_per_frame = count_of(format, "columns_per_frame", 4096);
  metadata.columns_per_packet = count_of(format, "columns_per_packet", 64);
  metadata.window = window_of(format, metadata.columns_per_frame);
  if (!metadata.window) metadata.window = window_of_azimuth(page, metadata.columns_per_frame);
  metadata.takes_farther = text_at(page, "return_order") == "NEAREST_TO_FARTHEST";
}

}  // namespace

OusterMetadata parse_ouster_metadata(const std::string& text) {
  const Json page = Json::parse(text, nullptr, false);
  if (page.is_discarded() || !page.is_object()) throw FrameError(tr("the metadata is no JSON object"));
  const Json* grouped = find(page, "data_format");
  if (grouped == nullptr && page.contains("lidar_data_format")) grouped = &page["lidar_data_format"];
  // Firmware before 1.14 knows no such group: its client wrote the sensor's "error: Command not recognized."
  if (grouped != nullptr && grouped->is_string()) grouped = nullptr;
  if (grouped != nullptr && !grouped->is_object()) throw FrameError(tr("the metadata has no 'data_format'"));
  OusterMetadata metadata;
  if (grouped != nullptr) {
    read_format(page, *grouped, metadata);
  } else {
    read_early_format(page, metadata);
  }
  metadata.product = text_at(page, "prod_line");
  metadata.serial = serial_of(page);
  read_geometry(page, metadata);
  return metadata;
}

std::filesystem::path ouster_metadata_beside(const std::filesystem::path& capture) {
  std::filesystem::path plain = capture, numbered = capture;
  plain.replace_extension(".json");
  numbered.replace_filename(capture.stem().string() + "_0.json");
  std::error_code ignored;
  const bool is_numbered = !std::filesystem::exists(plain, ignored) && std::filesystem::exists(numbered, ignored);
  return is_numbered ? numbered : plain;
}

}  // namespace pose_wall::tools
