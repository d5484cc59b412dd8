// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A key of pose_wall.yaml that the engine does not read: what its table says of it, and which values it takes.

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pose_wall::tools {

// One row of a table of such keys.
struct OutsideKey {
  enum class Type { kText, kChoice, kNumber, kInteger, kSwitch, kHostPort, kIpv4, kIpv4OrNone };

  const char* name;
  const char* group;
  Type type;
  const char* unit;
  double minimum, maximum;  // of numbers
  const char* choices;      // of kChoice: "udp, ros1, ros2"
  const char* help;
};

// Of kChoice, each for itself.
std::vector<std::string> choices_of(const OutsideKey& key);

// "one of udp, ros1, ros2", "a number from 0 to 65535", ...
std::string allowed_text(const OutsideKey& key);

// Of kNumber and kInteger; nothing where the text is none that the key takes.
std::optional<double> number_of(const OutsideKey& key, const std::string& text);

}  // namespace pose_wall::tools
