// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/recipe.hpp"

#include <fmt/format.h>

namespace pose_wall::tools::campaign {
namespace {

std::string by_files(const WorstEvent& event, const Manifest& manifest) {
  return fmt::format(
      "pose_wall sim --scene {} --sensor {} --random --seed {}{} --frames {} --output DIR && pose_wall run --config "
      "DIR/pose_wall.yaml{} --output DIR/out.csv DIR/frames",
      event.run.scene, event.run.sensor, event.run.seed, set_words(event.run.settings), event.frame + 1,
      engine_words(manifest.engine));
}

// Of the run itself, so many frames of it.
std::string by_run(const Run& run, std::uint32_t frames, const Manifest& manifest) {
  return fmt::format("{} --seed {} --scenes {} --sensors {} --first-draw {} --draws 1 --frames {}{}{} --output DIR",
                     verb_words(manifest.plan), manifest.plan.seed, run.scene, run.sensor, run.draw, frames,
                     drive_in_words(run.drive_in_m) + (manifest.plan.motion ? "" : scans_words(manifest.plan.scans)),
                     engine_words(manifest.engine));
}

}  // namespace

std::string recipe(const WorstEvent& event, const Manifest& manifest) {
  // The command of files gives `run` the scene's settings alone.
  const std::uint32_t driven = event.run.drive_in_frames;
  const bool files_do = event.stamps_are_steady && manifest.engine.config_file.empty() && driven == 0;
  if (files_do) return by_files(event, manifest);
  // A campaign has at least one frame of the scene, so it shows an event of the way in as well.
  return by_run(event.run, event.frame < driven ? 1 : event.frame + 1 - driven, manifest);
}

std::string recipe(const MotionEvent& event, const Manifest& manifest) {
  return by_run(event.run, static_cast<std::uint32_t>(event.frame + 1), manifest);
}

}  // namespace pose_wall::tools::campaign
