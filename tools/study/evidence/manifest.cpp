// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/evidence/manifest.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/json/json_words.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools::evidence {
namespace {

constexpr int kSchema = 1;
constexpr std::size_t kNameBytesMost = 255;  // NAME_MAX of Linux and Windows
constexpr std::size_t kDigestDigits = 64;    // of SHA-256

Json settings_json(const std::optional<SettingsMark>& settings) {
  if (!settings) return nullptr;
  Json json;
  json["file"] = kSettingsName;
  json["config_crc32"] = settings->config_crc32;
  json["planar_stop_crc32"] = settings->planar_stop_crc32 ? Json(*settings->planar_stop_crc32) : Json(nullptr);
  json["extrinsic_from"] = settings->extrinsic_from;
  return json;
}

std::optional<SettingsMark> settings_of(const Json& json) {
  if (json.is_null()) return std::nullopt;
  SettingsMark settings;
  settings.config_crc32 = json.at("config_crc32").get<std::uint32_t>();
  const Json& stop = json.at("planar_stop_crc32");
  if (!stop.is_null()) settings.planar_stop_crc32 = stop.get<std::uint32_t>();
  settings.extrinsic_from = json.at("extrinsic_from").get<std::string>();
  return settings;
}

bool is_digest(const std::string& text) {
  return text.size() == kDigestDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

PackedFile file_of(const Json& json) {
  const Json& bytes = json.at("bytes");
  PackedFile file{json.at("name").get<std::string>(), 0, json.at("sha256").get<std::string>()};
  if (!bytes.is_number_unsigned() || !is_digest(file.sha256) || !is_plain_name(file.name)) {
    throw std::runtime_error(say("{}: the row of '{}' is none of a file", kManifestName, shown_name(file.name)));
  }
  file.bytes = bytes.get<std::uint64_t>();
  return file;
}

Manifest manifest_of(const Json& json) {
  const Json& schema = json.at("schema");
  if (schema != kSchema) {
    throw std::runtime_error(
        say("{}: schema {} is of another version of pose_wall; this one reads {}", kManifestName, schema.dump(), 1));
  }
  Manifest manifest;
  manifest.made_at = json.at("made_at").get<std::string>();
  manifest.version = json.at("pose_wall").get<std::string>();
  if (!json.at("signed_by").is_null()) manifest.signed_by = json.at("signed_by").get<std::string>();
  for (const Json& file : json.at("files")) manifest.files.push_back(file_of(file));
  manifest.settings = settings_of(json.at("settings"));
  manifest.missing = json.at("missing").get<std::vector<std::string>>();
  for (const Json& row : json.at("left_out")) {
    manifest.left_out.push_back({row.at("name").get<std::string>(), row.at("why").get<std::string>()});
  }
  return manifest;
}

// Also C1, which terminals obey: 0xC2 and a byte below 0xA0.
bool has_control(const std::string& name) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto byte = static_cast<unsigned char>(name[i]);
    if (byte < 0x20 || byte == 0x7F) return true;
    if (byte == 0xC2 && i + 1 < name.size() && static_cast<unsigned char>(name[i + 1]) < 0xA0) return true;
  }
  return false;
}

bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(Json(text).dump());  // which refuses what is none
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

}  // namespace

std::string manifest_text(const Manifest& manifest) {
  Json json;
  json["schema"] = kSchema;
  json["made_at"] = manifest.made_at;
  json["pose_wall"] = manifest.version;
  json["signed_by"] = manifest.signed_by ? Json(*manifest.signed_by) : Json(nullptr);
  json["files"] = Json::array();
  for (const PackedFile& file : manifest.files) {
    json["files"].push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  }
  json["settings"] = settings_json(manifest.settings);
  json["missing"] = manifest.missing;
  json["left_out"] = Json::array();
  for (const LeftOut& left : manifest.left_out) {
    json["left_out"].push_back({{"name", left.name}, {"why", left.why}});
  }
  return json_text(json, 2) + "\n";
}

Manifest read_manifest(const std::string& text) {
  try {
    return manifest_of(Json::parse(text));
  } catch (const Json::exception& error) {
    // What it quotes may be as long as the manifest.
    throw std::runtime_error(fmt::format("{}: {}", kManifestName, shown_name(error.what())));
  }
}

bool is_plain_name(const std::string& name) {
  if (name.empty() || name.size() > kNameBytesMost || name.front() == '.') return false;
  return name.find_first_of("/\\") == std::string::npos && !has_control(name) && is_utf8(name);
}

std::string shown_name(const std::string& name) {
  std::string shown = name.substr(0, kNameBytesMost);
  if (!has_control(shown) && is_utf8(shown)) return shown;
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < 0x20 || c >= 0x7F; }, '?');
  return shown;
}

}  // namespace pose_wall::tools::evidence
