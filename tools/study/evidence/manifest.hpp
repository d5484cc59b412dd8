// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// manifest.json: what lies in the evidence, and what it says of the machine's settings.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pose_wall::tools::evidence {

// Names of members that are no files of the folder.
constexpr const char* kManifestName = "manifest.json";
constexpr const char* kSignatureName = "manifest.json.sig";
constexpr const char* kPublicKeyName = "site.pub.pem";
// In the folder: what the machine runs by.
constexpr const char* kSettingsName = "settings.yaml";

struct PackedFile {
  std::string name;
  std::uint64_t bytes = 0;
  std::string sha256;  // 64 digits, small letters
};

// Of what lies in the folder and was not packed.
struct LeftOut {
  std::string name;
  std::string why;  // "hidden", "link", "folder", "no regular file", "the zip itself"
};

// By which numbers a controller knows the settings.
struct SettingsMark {
  std::uint32_t config_crc32 = 0;
  std::optional<std::uint32_t> planar_stop_crc32;  // where the key planar is on
  std::string extrinsic_from;                      // "tf": then the machine's CRC counts a transform, too
};

struct Manifest {
  std::string made_at;                   // UTC, as 2026-11-30T08:15:02Z, by the clock of the machine that packed
  std::string version;                   // of the pose_wall that packed
  std::optional<std::string> signed_by;  // fingerprint of the key
  std::vector<PackedFile> files;
  std::optional<SettingsMark> settings;
  std::vector<std::string> missing;  // usual parts that are not there
  std::vector<LeftOut> left_out;
};

// As it is written and signed.
std::string manifest_text(const Manifest& manifest);

// Throws std::runtime_error that says what is wrong with it.
Manifest read_manifest(const std::string& text);

// What a member may be called, for every program that unpacks it: UTF-8 without slashes, backslashes and control
// characters, at most 255 bytes, and no dot in front.
bool is_plain_name(const std::string& name);

// For a person's terminal, which obeys control characters: a text that has such, or is no UTF-8, is told with '?' for
// all that is not ASCII. At most 255 bytes.
std::string shown_name(const std::string& name);

}  // namespace pose_wall::tools::evidence
