// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/all_settings.hpp"

#include <utility>

#include "io/config_file/key_table.hpp"

namespace pose_wall::tools {

std::vector<SettingText> all_settings(const LoadedConfig& loaded) {
  using Reader = SettingText::Reader;
  std::vector<SettingText> all;
  for (const pose_wall_key_info& key : config_keys()) {
    all.push_back({key.name, Reader::kEngine, config_value_text(*loaded.config.get(), key),
                   key.type == POSE_WALL_KEY_TEXT, key.type == POSE_WALL_KEY_BOX ? "[]" : "''"});
  }
  const auto add = [&all](Reader reader, const OutsideKey& key, std::string value) {
    all.push_back({key.name, reader, std::move(value), key.type == OutsideKey::Type::kText, "''"});
  };
  for (const OutsideKey& key : motion_keys()) add(Reader::kMotion, key, motion_value_text(loaded.motion, key));
  for (const OutsideKey& key : live_keys()) add(Reader::kLive, key, live_value_text(loaded.live, key));
  for (const OutsideKey& key : planar_keys()) add(Reader::kPlanar, key, planar_value_text(loaded.planar, key));
  return all;
}

}  // namespace pose_wall::tools
