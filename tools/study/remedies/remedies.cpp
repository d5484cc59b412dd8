// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/remedies/remedies.hpp"

#include <fmt/format.h>

#include "io/language/both_languages.hpp"
#include "pose_wall.h"
#include "pose_wall_trace.h"
#include "study/remedies/gate_table.hpp"

namespace pose_wall::tools {
namespace {

// What lowers a level, by its largest part. Never the limit: a wider one lowers no error.
constexpr const char* kHelpOfPart[POSE_WALL_PARTS] = {
    translatable("show more of the surface: mount the sensor where it sees more of it, keep body boxes to the machine "
                 "itself, or take a sensor of more beams"),
    translatable("set range_bias_max to the sensor's data sheet"),
    translatable("a bent surface is no plane: look at a straighter piece"),
    translatable("clear the view to the surface, or show more of it"),
    translatable(
        "mount the sensor where nothing hides the wall at the sampling point, or set s_front and s_back to where it is "
        "seen"),
    translatable("wait until the value has followed"),
    translatable("see why frames are missing or late"),
};

}  // namespace

std::string help_of_gate(Language language, std::uint32_t gate) {
  pose_wall_trace_info info{};
  pose_wall_trace_gate_info(gate, &info);
  const explain::GateWords* words = explain::find_gate_words(info.name);
  if (words == nullptr || *words->help == '\0') return "";
  return fmt::format(fmt::runtime(tr(language, words->help)), fmt::arg("key", info.key));
}

std::string help_of_part(Language language, std::uint32_t part) {
  return tr(language, kHelpOfPart[part]);
}

}  // namespace pose_wall::tools
