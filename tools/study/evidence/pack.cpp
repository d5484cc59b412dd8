// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <ctime>
#include <optional>
#include <stdexcept>

#include "io/config_file/load_config.hpp"
#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/numbers/utc_text.hpp"
#include "io/outputs/output_file.hpp"
#include "io/terminal/interrupt.hpp"
#include "pose_wall_planar_stop.h"
#include "study/evidence/evidence.hpp"
#include "study/evidence/folder_listing.hpp"
#include "study/evidence/sha256.hpp"
#include "study/evidence/site_key.hpp"
#include "study/evidence/zip_file.hpp"

namespace pose_wall::tools::evidence {
namespace {

namespace fs = std::filesystem;

// As the daemon's log tells them.
SettingsMark settings_mark(const fs::path& file) {
  const LoadedConfig loaded = load_config(file.string(), {});
  SettingsMark mark;
  mark.extrinsic_from = loaded.live.extrinsic_from;
  std::int32_t status = pose_wall_config_crc(loaded.config.get(), &mark.config_crc32);
  if (status == POSE_WALL_OK && loaded.planar.is_on()) {
    const pose_wall_planar_stop_settings stop = stop_settings_of(loaded.planar);
    mark.planar_stop_crc32 = 0;
    status = pose_wall_planar_stop_settings_crc(loaded.config.get(), &stop, &*mark.planar_stop_crc32);
  }
  if (status != POSE_WALL_OK) throw ConfigError(say("the engine: {}", pose_wall_status_text(status)));
  return mark;
}

std::uint64_t chunks_of(std::uint64_t bytes) {
  return bytes / kChunkBytes + 1;
}

std::uint64_t chunks_of(const fs::path& folder, const Listing& listing) {
  std::uint64_t chunks = 0;
  std::error_code ignored;
  for (const std::string& name : listing.files) {
    const std::uintmax_t bytes = fs::file_size(folder / name, ignored);
    chunks += ignored ? 1 : chunks_of(bytes);
  }
  return chunks;
}

Manifest manifest_of_folder(const fs::path& folder, const Listing& listing, const std::optional<SiteKey>& key,
                            const Step& step) {
  Manifest manifest;
  manifest.made_at = utc_text(std::time(nullptr));
  manifest.version = pose_wall_version();
  if (key) manifest.signed_by = key->fingerprint();
  for (const std::string& name : listing.files) {
    if (name == kSettingsName) manifest.settings = settings_mark(folder / name);
  }
  for (const std::string& name : listing.files) manifest.files.push_back(hashed_file(folder / name, step));
  manifest.missing = listing.missing;
  manifest.left_out = listing.left_out;
  return manifest;
}

std::vector<NewMember> members_of(const fs::path& folder, const Manifest& manifest, const std::optional<SiteKey>& key) {
  const std::string text = manifest_text(manifest);
  std::vector<NewMember> members;
  members.push_back({kManifestName, "", text, true});
  if (key) {
    members.push_back({kSignatureName, "", key->sign(text), false});
    members.push_back({kPublicKeyName, "", key->public_pem(), false});
  }
  for (const PackedFile& file : manifest.files) {
    members.push_back({file.name, folder / file.name, "", is_text(folder / file.name)});
  }
  return members;
}

// Before it gets its name: a file that was written meanwhile has another hash by now, and a disk may err.
void expect_whole(const fs::path& part, const Step& step) {
  const Verdict verdict = verify(part, "", [&step](std::uint64_t) { return step; });
  if (!verdict.is_whole()) {
    throw std::runtime_error(say("a file changed while it was packed, or the disk errs: {}", verdict.faults.front()));
  }
}

}  // namespace

Manifest pack(const PackRequest& request, const std::function<Step(std::uint64_t chunks)>& begin) {
  std::optional<SiteKey> key;
  if (!request.key_file.empty()) key = SiteKey::to_sign(request.key_file);
  std::error_code ignored;
  if (!request.overwrites && fs::exists(request.zip, ignored)) {
    throw std::invalid_argument(
        say("--output {}: this file exists already; --force overwrites it", request.zip.string()));
  }
  const Listing listing = list_folder(request.folder, request.zip);
  OutputFile output(request.zip.string(), {});
  // Each file is read, packed, and checked.
  const std::uint64_t chunks = chunks_of(request.folder, listing);
  const Step step = begin(3 * chunks);
  const Manifest manifest = manifest_of_folder(request.folder, listing, key, step);
  std::uint64_t told = 0;
  write_zip(output.part(), members_of(request.folder, manifest, key), [&](double share) {
    for (; static_cast<double>(told) < share * static_cast<double>(chunks); ++told) step(request.zip.string());
  });
  stop_if_interrupted();
  expect_whole(output.part(), step);
  output.take_part();
  return manifest;
}

}  // namespace pose_wall::tools::evidence
