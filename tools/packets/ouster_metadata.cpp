// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/ouster_metadata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "frames/frame.hpp"
#include "language/language.hpp"

namespace pose_wall::tools {
namespace {

using Json = nlohmann::json;

constexpr double kMetresPerMm = 1e-3;

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

OusterProfile profile_of(const Json& format) {
  const Json* const value = find(format, "udp_profile_lidar");
  const std::string name = value != nullptr && value->is_string() ? value->get<std::string>() : "LEGACY";
  if (name == "LEGACY") return OusterProfile::kLegacy;
  if (name == "RNG19_RFL8_SIG16_NIR16") return OusterProfile::kSingle;
  if (name == "RNG19_RFL8_SIG16_NIR16_DUAL") return OusterProfile::kDual;
  if (name == "RNG15_RFL8_NIR8") return OusterProfile::kLowRate;
  throw FrameError(
      say("udp_profile_lidar '{}' is not read; LEGACY, RNG19_RFL8_SIG16_NIR16, its _DUAL and "
          "RNG15_RFL8_NIR8 are",
          name));
}

void read_geometry(const Json& page, OusterMetadata& metadata) {
  metadata.altitude_deg = numbers_of(need(page, "beam_altitude_angles"), "beam_altitude_angles", metadata.rings);
  metadata.azimuth_deg = numbers_of(need(page, "beam_azimuth_angles"), "beam_azimuth_angles", metadata.rings);
  if (const Json* const beam = find(page, "beam_to_lidar_transform")) {
    const std::vector<double> transform = numbers_of(*beam, "beam_to_lidar_transform", 16);
    metadata.beam_origin_out_m = transform[3] * kMetresPerMm;
    metadata.beam_origin_up_m = transform[11] * kMetresPerMm;
  } else {
    const Json& origin = need(page, "lidar_origin_to_beam_origin_mm");
    if (!origin.is_number()) throw FrameError(tr("the metadata's 'lidar_origin_to_beam_origin_mm' is no number"));
    metadata.beam_origin_out_m = origin.get<double>() * kMetresPerMm;
  }
  const std::vector<double> transform =
      numbers_of(need(page, "lidar_to_sensor_transform"), "lidar_to_sensor_transform", 16);
  std::copy(transform.begin(), transform.end(), metadata.sensor_from_lidar.begin());
  for (const std::size_t shift : {3U, 7U, 11U}) metadata.sensor_from_lidar[shift] *= kMetresPerMm;
}

}  // namespace

OusterMetadata parse_ouster_metadata(const std::string& text) {
  const Json page = Json::parse(text, nullptr, false);
  if (page.is_discarded() || !page.is_object()) throw FrameError(tr("the metadata is no JSON object"));
  const Json* grouped = find(page, "data_format");
  if (grouped == nullptr && page.contains("lidar_data_format")) grouped = &page["lidar_data_format"];
  if (grouped == nullptr || !grouped->is_object()) throw FrameError(tr("the metadata has no 'data_format'"));
  OusterMetadata metadata;
  metadata.profile = profile_of(*grouped);
  metadata.rings = count_of(*grouped, "pixels_per_column", 128);
  metadata.columns_per_frame = count_of(*grouped, "columns_per_frame", 4096);
  metadata.columns_per_packet = count_of(*grouped, "columns_per_packet", 64);
  const Json* const product = find(page, "prod_line");
  if (product != nullptr && product->is_string()) metadata.product = product->get<std::string>();
  read_geometry(page, metadata);
  return metadata;
}

}  // namespace pose_wall::tools
