// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What commissioning works out and writes, step by step: record, examine, check, save, prove. All of it lies in one
// folder (key `commissioned`):
//
//   settings.yaml   What was saved. It stands over the settings file.
//   recording/      The clouds of the standing machine, MCAP.
//   trial/          The settings that were checked last, with results.csv and report.html.
//   evidence.zip    What proves how the machine was commissioned. It is signed where site.pem is there.

#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::live {

using Json = nlohmann::json;

// Keys of the engine and their values, as a settings file has them.
using Changes = std::map<std::string, std::string>;

class CommissioningSteps {
 public:
  // Makes the folder. Throws std::system_error where it cannot.
  explicit CommissioningSteps(const LoadedConfig& loaded);

  std::filesystem::path recording_folder() const { return folder_ / "recording"; }
  std::filesystem::path report_file() const { return folder_ / "trial" / "report.html"; }
  std::filesystem::path evidence_file() const { return folder_ / "evidence.zip"; }

  // Keys that a person draws or measures, with their present values: axes, mounting, boxes of the body.
  Json mounting() const;

  // Before a new recording: the last one and what came of it.
  void forget_recording() const;
  std::vector<std::string> recordings() const;

  // All of these wait for the command `pose_wall`, and throw std::runtime_error in words for a person. language: "en",
  // "zh", of what it prints.
  //
  // What `doctor --json` says of the recording.
  Json examine(const std::string& language, const std::atomic<bool>& given_up) const;
  // The recording measured with these changes: `config_crc32`, `forward_axis`, and what `run` told, line by line.
  Json check(const Changes& changes, const std::string& language, const std::atomic<bool>& given_up) const;
  // What was checked last stands over the settings file from the next start on. who: what the evidence tells of the
  // person; examined, checked: as above. Returns what `evidence` said, as lines.
  Json save(const Json& who, const Json& examined, const Json& checked, const std::string& language,
            const std::atomic<bool>& given_up) const;

 private:
  std::vector<std::string> words_with(const std::string& settings_folder) const;
  LoadedConfig trial_of(const Changes& changes) const;

  LoadedConfig loaded_;
  std::filesystem::path folder_;
};

}  // namespace pose_wall::tools::live
