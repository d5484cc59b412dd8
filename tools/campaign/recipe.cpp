// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/recipe.hpp"

#include <fmt/format.h>

namespace pose_wall::tools::campaign {
namespace {

std::string by_files(const WorstEvent& event, const Manifest& manifest) {
  return fmt::format(
      "pose_wall sim --scene {} --sensor {} --random --seed {} --frames {} --output DIR && pose_wall run --config "
      "DIR/pose_wall.yaml{} --output DIR/out.csv DIR/frames",
      event.run.scene, event.run.sensor, event.run.seed, event.frame + 1, engine_words(manifest.engine));
}

}  // namespace

std::string run_recipe(const Run& run, std::uint32_t frames, const Manifest& manifest) {
  return fmt::format("{} --seed {} --scenes {} --sensors {} --first-draw {} --draws 1 --frames {}{} --output DIR",
                     verb_words(manifest.plan), manifest.plan.seed, run.scene, run.sensor, run.draw, frames,
                     engine_words(manifest.engine));
}

std::string recipe(const WorstEvent& event, const Manifest& manifest) {
  // `run` takes one file of settings, and that is the scene's.
  const bool files_do = event.stamps_are_steady && manifest.engine.config_file.empty();
  return files_do ? by_files(event, manifest) : run_recipe(event.run, event.frame + 1, manifest);
}

}  // namespace pose_wall::tools::campaign
