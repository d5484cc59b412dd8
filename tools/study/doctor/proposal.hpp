// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The settings as the doctor would have them: each changed key with its reason. No gate is ever loosened, but for those
// that the file of a sensor's class under config/ names, with the values that the campaign was run on.

#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::doctor {

struct Change {
  std::string key;
  std::string before;
  std::string value;  // as it is written in pose_wall.yaml
  std::string reason;
};

class Proposal {
 public:
  explicit Proposal(LoadedConfig told) : told_(std::move(told)), config_(told_.config) {}

  // A key of the mounting or of the machine. Nothing where it has this value already. Throws std::logic_error when the
  // engine refuses it.
  void set(const std::string& key, const std::string& value, const std::string& reason);
  // Writes a key with this reason even where it keeps its value: one that nobody should leave unread.
  void state(const std::string& key, const std::string& reason) { stated_[key] = reason; }
  // Only a smaller ground_height_max, a larger ground_height_min: nothing otherwise.
  void raise(const std::string& key, double value, const std::string& reason);
  void lower(const std::string& key, double value, const std::string& reason);
  // What config/ says for the class of sensor. A key that was told by file or --set is left alone. `config`: its file;
  // where there is none, the file says that range_bias_max is an assumption.
  void take_class(const std::string& model, const std::string& title, const std::string& config);

  bool is_told(const std::string& key) const { return told_.origins.count(key) != 0; }
  const LoadedConfig& told() const { return told_; }
  const api::Config& config() const { return config_; }
  // All of it: what was told for motion and pose_walld, too.
  LoadedConfig settings() const;
  const std::vector<Change>& changes() const { return changes_; }

  // pose_wall.yaml: what was told and what was changed, in the order of the table; `head` lines become comments.
  std::string yaml(const std::vector<std::string>& head) const;

 private:
  // Why a key is in the file; empty: it is not.
  std::string comment_of(const std::string& key) const;

  LoadedConfig told_;
  api::Config config_;
  std::vector<Change> changes_;
  std::map<std::string, std::string> stated_;
};

}  // namespace pose_wall::tools::doctor
