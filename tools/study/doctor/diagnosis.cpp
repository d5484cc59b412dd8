// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/diagnosis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools::doctor {
namespace {

// Ruts, tracks that sink in and a machine that tilts move the sensor by less.
constexpr double kHeightRoom_m = 0.5;

Ahead look_ahead(const SupposedMount& supposed, const Proposal& proposal) {
  Ahead ahead;
  if (!supposed.road.is_found) return ahead;
  const std::string line(1, supposed.road.line);
  char now[POSE_WALL_TEXT_MAX] = {};
  pose_wall_config_get_text(proposal.config().get(), "forward_axis", now, sizeof now);
  const bool fits = now[1] == supposed.road.line;
  if (supposed.ends.tells_ahead()) {
    const bool plus = supposed.ends.face_plus_m.has_value();
    ahead.axis = (plus ? "+" : "-") + line;
    ahead.is_known = true;
    ahead.reason = say("a face closes the road {:.1f} m along {}; the other end is open",
                       plus ? *supposed.ends.face_plus_m : *supposed.ends.face_minus_m, ahead.axis);
    return ahead;
  }
  ahead.axis = fits ? std::string(now) : "+" + line;
  ahead.is_known = fits && proposal.is_told("forward_axis");
  if (ahead.is_known) {
    ahead.reason = tr("as the config says; the road lies along it");
  } else if (supposed.ends.face_plus_m) {
    ahead.reason = say("the road lies along {}; both ends are closed, so the frames do not show which is ahead", line);
  } else {
    ahead.reason =
        say("the road lies along {}; no face within 20 m, so the frames do not show which end is ahead", line);
  }
  return ahead;
}

std::string turn_text(const api::Config& config, const char* key) {
  return fmt::format("{:.4f}", config.number(key));
}

void propose_mount(const MountChoice& mount, Proposal& proposal) {
  const SupposedMount& supposed = mount.likely;
  const double tilt_deg = supposed.tilt_rad * kDegPerRad, level_deg = supposed.floor.tilt_level_rad * kDegPerRad;
  const std::string reason =
      supposed.is_flipped ? say("the floor is {:.1f} deg off with the sensor upside down ({}); this levels it for the "
                                "machine as it stood, within {:.1f} deg",
                                tilt_deg, mount.reason, level_deg)
                          : say("the floor is {:.1f} deg off ({}); this levels it for the machine as it stood, within "
                                "{:.1f} deg",
                                tilt_deg, mount.reason, level_deg);
  for (const char* key : {"extrinsic_roll", "extrinsic_pitch"}) {
    // Equal ones stay as they were written.
    if (std::fabs(std::remainder(supposed.config.number(key) - proposal.config().number(key), 2.0 * M_PI)) < 5e-5)
      continue;
    proposal.set(key, turn_text(supposed.config, key), reason);
  }
  const double height_m = supposed.floor.height_m;
  const std::string height = say(
      "the sensor is {:.2f} m above the floor; a narrower range keeps the roof and reflections from being taken for it",
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
    proposal.set(
        fmt::format("body_box_{}", slot), box_text(box),
        tr("returns near the sensor that stayed in one place and are neither floor nor wall, with 0.1 m around "
           "them: the machine's own body, if nothing else stood there"));
    ++slot;
  }
}

}  // namespace

std::string guess_text(const std::string& axis) {
  const std::string other = (axis[0] == '-' ? "+" : "-") + axis.substr(1);
  return say(
      "{} is a GUESS: confirm it at the machine. If the other end is ahead, write {}; otherwise left and right, front "
      "and back and all signs of angles are swapped",
      axis, other);
}

Diagnosis diagnose(const Recording& recording, const LoadedConfig& told, std::optional<double> height_m,
                   const MakePreview& make_preview) {
  Diagnosis d{
      recording.sensor.facts(), look_at_stamps(recording), look_at_times(recording), {}, {}, {}, Proposal(told), {}};
  d.proposal.take_class(d.sensor.model, d.sensor.title, d.sensor.config);
  // By times that are wrong otherwise less motion is left in a scan than without any.
  if (d.times.fault == TimeFault::kMoved && !d.proposal.is_told("motion")) {
    d.proposal.set("motion", "off", times_doubt(d.times));
  }
  if (!recording.kept.empty()) {
    const bool is_told = d.proposal.is_told("extrinsic_roll") || d.proposal.is_told("extrinsic_pitch");
    d.mount = choose_mount(d.proposal.config(), is_told, height_m, recording.kept);
    const SupposedMount& supposed = d.mount->likely;
    if (supposed.floor.is_found()) propose_mount(*d.mount, d.proposal);
    if (supposed.floor.is_found()) propose_boxes(supposed.body, d.proposal);
    d.ahead = look_ahead(supposed, d.proposal);
    if (!d.ahead.axis.empty()) {
      const std::string reason = d.ahead.is_known ? d.ahead.reason : d.ahead.reason + ". " + guess_text(d.ahead.axis);
      d.proposal.set("forward_axis", d.ahead.axis, reason);
      d.proposal.state("forward_axis", reason);
    }
    d.preview = make_preview(d.proposal.settings());
  }
  d.verdict = judge(d);
  return d;
}

}  // namespace pose_wall::tools::doctor
