// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "doctor/diagnosis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "angles.hpp"
#include "doctor/statistics.hpp"
#include "doctor/trial.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr std::size_t kCheckFrames = 24;
// Ruts, tracks that sink in and a machine that tilts move the sensor by less.
constexpr double kHeightRoom_m = 0.5;

Ahead look_ahead(const MountStory& story, const Proposal& proposal) {
  Ahead ahead;
  if (!story.road.is_found) return ahead;
  const std::string line(1, story.road.line);
  char now[POSE_WALL_TEXT_MAX] = {};
  pose_wall_config_get_text(proposal.config().get(), "forward_axis", now, sizeof now);
  const bool fits = now[1] == story.road.line;
  if (story.ends.tells_ahead()) {
    const bool plus = story.ends.face_plus_m.has_value();
    ahead.axis = (plus ? "+" : "-") + line;
    ahead.is_known = true;
    ahead.reason = fmt::format("a face closes the road {:.1f} m along {}, nothing does behind",
                               plus ? *story.ends.face_plus_m : *story.ends.face_minus_m, ahead.axis);
    return ahead;
  }
  ahead.axis = fits ? std::string(now) : "+" + line;
  ahead.is_known = fits && proposal.is_told("forward_axis");
  const bool closed = story.ends.face_plus_m.has_value();
  ahead.reason = ahead.is_known ? "as the config says; the road lies along it"
                                : fmt::format("the road lies along {}; which end is ahead cannot be seen: {}", line,
                                              closed ? "both are closed" : "no face within 20 m");
  return ahead;
}

std::string turn_text(const api::Config& config, const char* key) {
  return fmt::format("{:.4f}", config.number(key));
}

void propose_mount(const MountChoice& mount, Proposal& proposal) {
  const MountStory& story = mount.story;
  const std::string tilt = fmt::format("the floor is seen {:.1f} deg off{}", story.tilt_rad * kDegPerRad,
                                       story.is_flipped ? ", with the sensor upside down" : "");
  const std::string reason = fmt::format("{} ({}); this levels it for the machine as it stood, within {:.1f} deg", tilt,
                                         mount.reason, story.floor.tilt_level_rad * kDegPerRad);
  for (const char* key : {"extrinsic_roll", "extrinsic_pitch"}) {
    // Equal ones stay as they were written.
    if (std::fabs(std::remainder(story.config.number(key) - proposal.config().number(key), 2.0 * M_PI)) < 5e-5)
      continue;
    proposal.set(key, turn_text(story.config, key), reason);
  }
  const double height_m = story.floor.height_m;
  const std::string height = fmt::format(
      "the sensor is {:.2f} m above the floor: narrower, so that the roof or a "
      "reflection is not taken for it",
      height_m);
  proposal.raise("ground_height_min", std::floor(20.0 * (height_m - kHeightRoom_m)) / 20.0, height);
  proposal.lower("ground_height_max", std::ceil(20.0 * (height_m + kHeightRoom_m)) / 20.0, height);
}

// Boxes that were told stay, and what they hold is no longer there to be found.
void propose_boxes(const BodySeen& body, Proposal& proposal) {
  int slot = 1;
  for (const Box& box : body.boxes_base) {
    while (slot <= 4 && proposal.is_told(fmt::format("body_box_{}", slot))) ++slot;
    if (slot > 4) return;
    proposal.set(fmt::format("body_box_{}", slot), box_text(box),
                 "returns that stayed in one place near the sensor, neither floor nor wall: the machine's own body, "
                 "if nothing else stood there; 0.1 m around them");
    ++slot;
  }
}

Check check(const api::Config& config, const std::vector<KeptFrame>& frames) {
  const Trial trial(config, frames, kCheckFrames);
  Check out;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    out.measured[q] = trial.measured(q);
    out.valid[q] = trial.valid(q);
    std::vector<double> levels;
    for (const pose_wall_result& r : trial.results()) {
      if (is_measured(r.quantity[q])) levels.push_back(r.quantity[q].protection_level);
    }
    out.level[q] = median(levels);
  }
  out.reasons = trial.reasons(4);
  return out;
}

}  // namespace

Diagnosis diagnose(const Recording& recording, const LoadedConfig& told, std::optional<double> height_m) {
  Diagnosis d{look_at_sensor(recording), look_at_stamps(recording), {}, {}, {}, Proposal(told), {}};
  d.proposal.take_class(d.sensor.model, d.sensor.title);
  if (!recording.kept.empty()) {
    const bool is_told = d.proposal.is_told("extrinsic_roll") || d.proposal.is_told("extrinsic_pitch");
    d.mount = choose_mount(d.proposal.config(), is_told, height_m, recording.kept);
    const MountStory& story = d.mount->story;
    if (story.floor.is_found()) propose_mount(*d.mount, d.proposal);
    if (story.floor.is_found()) propose_boxes(story.body, d.proposal);
    d.ahead = look_ahead(story, d.proposal);
    if (!d.ahead.axis.empty()) {
      d.proposal.set("forward_axis", d.ahead.axis, d.ahead.reason);
      d.proposal.state("forward_axis", d.ahead.reason);
      d.check = check(d.proposal.config(), recording.kept);
    }
  }
  d.verdict = judge(d);
  return d;
}

}  // namespace pose_wall::tools::doctor
