// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "study/doctor/diagnosis.hpp"
#include "study/doctor/statistics.hpp"
#include "study/results/usability.hpp"

namespace pose_wall::tools::doctor {
namespace {

using Reasons = std::vector<std::string>;

// The rule, as rule_text() states it.
constexpr double kValidAll = kUsableShare, kValidSome = kInPartShare;
constexpr double kDurationAsked_s = 30.0;
constexpr double kDurationRounding_s = 0.1;  // 300 stamps at 10 Hz need not add up to 30 s
constexpr std::size_t kFramesMin = 3;
constexpr double kFaultShareMax = 0.2;
// What a machine that stands with its motors running may move, beyond what one frame scatters.
constexpr double kTiltMoved_deg = 1.0, kAzimuthMoved_deg = 1.5, kDistanceMoved_m = 0.1, kSigmas = 4.0;
constexpr double kOffLineMax_deg = 35.0, kOffLineTold_deg = 5.0;
constexpr double kNoiseMax_m = 0.03;
constexpr double kPassingMax = 0.03;
constexpr std::size_t kReasonsShown = 4;
// A parked vehicle of 5 m has left its place for half of such a drive, which is more than a body's cells may miss.
constexpr double kDrive_m = 10.0;

bool has_moved(double spread, double sigma, double allowed) {
  return spread > std::max(allowed, kSigmas * sigma);
}

void check_frames(const Diagnosis& d, Reasons& against) {
  const StampHealth& s = d.stamps;
  const std::size_t steps = std::max<std::size_t>(s.frames, 1);
  if (s.frames < kFramesMin) {
    against.push_back(
        say("the recording has too few frames ({}; at least {} are needed, 30 s are asked)", s.frames, kFramesMin));
  } else if (share(s.back + s.still, steps) > kFaultShareMax) {
    against.push_back(say("{} stamps repeat and {} go back", s.still, s.back));
  } else if (share(s.repeated, steps) > kFaultShareMax) {
    against.push_back(say("{} frames repeat the points before them: the sensor is frozen", s.repeated));
  } else if (share(s.empty, steps) > kFaultShareMax) {
    against.push_back(say("{} of {} frames have no return", s.empty, s.frames));
  }
  std::string unit = unit_doubt(d.sensor.ranges);
  if (!unit.empty()) against.push_back(std::move(unit));
}

void check_mount(const Diagnosis& d, Reasons& against) {
  if (!d.mount) {
    if (against.empty()) against.push_back(tr("no frame has enough returns"));
    return;
  }
  const FloorSeen& floor = d.mount->likely.floor;
  if (!floor.is_found()) {
    against.push_back(say("the floor is seen in {:.0f} % of the frames", 100.0 * floor.measured));
    return;
  }
  if (d.mount->contradicts_height) {
    against.push_back(say("{}; it is seen {:.2f} m below", d.mount->reason, floor.height_m));
    return;
  }
  // Upright is how sensors are mounted; the other way round somebody has to say it.
  if (d.mount->likely.is_flipped && !d.mount->is_sure) {
    against.push_back(say("{}: a roof, or the floor under a sensor upside down? --height M or extrinsic_roll decides",
                          d.mount->reason));
  }
}

// Once, by the clearest sign.
void check_standing(const Diagnosis& d, Reasons& against) {
  const SupposedMount& supposed = d.mount->likely;
  const FloorSeen& floor = supposed.floor;
  const RoadAxis& road = supposed.road;
  if (has_moved(floor.tilt_spread_rad * kDegPerRad, floor.tilt_sigma_rad * kDegPerRad, kTiltMoved_deg)) {
    against.push_back(say("the sensor moved during the recording (its tilt by {:.1f} deg): let it stand",
                          floor.tilt_spread_rad * kDegPerRad));
    return;
  }
  if (!road.is_found || d.mount->contradicts_height) return;
  const bool turned =
      has_moved(road.azimuth_spread_rad * kDegPerRad, road.azimuth_sigma_rad * kDegPerRad, kAzimuthMoved_deg);
  if (turned || has_moved(road.distance_spread_m, road.distance_sigma_m, kDistanceMoved_m)) {
    against.push_back(
        say("the sensor moved during the recording (the road by {:.1f} deg, the walls by {:.2f} m): let it stand",
            road.azimuth_spread_rad * kDegPerRad, road.distance_spread_m));
  }
}

void check_road(const Diagnosis& d, Reasons& against) {
  const RoadAxis& road = d.mount->likely.road;
  if (!road.is_found) {
    against.push_back(tr("no side walls are seen along any axis"));
  } else if (road.is_ambiguous) {
    against.push_back(tr("the walls across make as good a road as those along: a room or a crossing"));
  } else if (std::fabs(road.off_line_rad) * kDegPerRad > kOffLineMax_deg) {
    against.push_back(
        say("the road lies {:.0f} deg off the nearest axis ({}): turn the machine along it, or set "
            "extrinsic_yaw",
            road.off_line_rad * kDegPerRad, road.line));
  }
}

// "roll 97 %, pitch 97 %": those whose share is at least `least` and below `most`.
std::string shares_between(const Preview::Numbers& shares, double least, double most) {
  std::vector<std::string> parts;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    if (shares[q] < least || shares[q] >= most) continue;
    parts.push_back(fmt::format("{} {:.0f} %", pose_wall_quantity_name(q), std::floor(100.0 * shares[q])));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void grade(const Diagnosis& d, RecordingVerdict& v) {
  if (!d.preview) return;
  const Preview::Numbers& valid = d.preview->valid;
  constexpr double kNoLimit = 2.0;
  const double least = *std::min_element(valid.begin(), valid.end());
  const double most = *std::max_element(valid.begin(), valid.end());
  const bool is_long = d.stamps.duration_s >= kDurationAsked_s - kDurationRounding_s;
  if (most < kValidSome) {
    v.reason = say("no value is valid in half of the frames ({})", shares_between(valid, 0.0, kNoLimit));
  } else if (least >= kValidAll) {
    v.reason = say("every value is valid in {:.0f} % of the frames or more ({})", 100.0 * kValidAll,
                   shares_between(valid, 0.0, kNoLimit));
  } else if (least >= kValidSome) {
    v.reason = say("every value is valid in half of the frames or more ({})", shares_between(valid, 0.0, kNoLimit));
  } else {
    v.reason = say("valid in half of the frames or more: {}; in less: {}", shares_between(valid, kValidSome, kNoLimit),
                   shares_between(valid, 0.0, kValidSome));
  }
  if (most < kValidSome) return;
  v.grade = least >= kValidAll && is_long ? Grade::kUsable : Grade::kUsableInPart;
}

void doubt_recording(const Diagnosis& d, Reasons& buts) {
  const StampHealth& s = d.stamps;
  if (s.duration_s < kDurationAsked_s - kDurationRounding_s) {
    buts.push_back(say("the recording has {:.1f} s; 30 s of a standing machine are asked", s.duration_s));
  }
  if (d.preview && !d.preview->reasons_text(1).empty()) {
    buts.push_back(say("most frequent reasons: {}", d.preview->reasons_text(kReasonsShown)));
  }
  if (s.unreadable > 0) buts.push_back(say("unreadable frames: {}", s.unreadable));
  if (s.empty > 0) buts.push_back(say("frames without a return: {}", s.empty));
  if (s.cut > 0) buts.push_back(say("frames cut short: {}", s.cut));
  if (s.repeated > 0) buts.push_back(say("frames that repeat the one before: {}", s.repeated));
  if (s.still + s.back > 0) buts.push_back(say("repeated stamps: {}, backward steps: {}", s.still, s.back));
  if (s.gaps > 0) buts.push_back(say("gaps between frames: {}, the longest {:.2f} s", s.gaps, s.longest_s));
  if (const std::string doubt = times_doubt(d.times); !doubt.empty()) {
    const std::string advice = times_advice(d.times);
    buts.push_back(advice.empty() ? say("times: {}", doubt) : say("times: {}. {}", doubt, advice));
  }
  if (d.sensor.config.empty() && d.sensor.returns > 0.0) {
    buts.push_back(tr("no file of config/ is made for this sensor, so its gates are the defaults"));
  }
}

void doubt_mount(const Diagnosis& d, Reasons& buts) {
  const SupposedMount& supposed = d.mount->likely;
  if (!d.mount->is_sure && !supposed.is_flipped) {
    buts.push_back(say("upright or upside down is not certain ({}): --height M decides", d.mount->reason));
  }
  if (supposed.floor.tilt_level_rad * kDegPerRad > 1.0) {
    buts.push_back(
        say("the tilt of the mounting is known within {:.1f} deg only", supposed.floor.tilt_level_rad * kDegPerRad));
  }
  const double noise_m = supposed.noise.best_m();
  if (noise_m > kNoiseMax_m) buts.push_back(say("ranges scatter by {:.0f} mm", 1e3 * noise_m));
  for (const Change& change : d.proposal.changes()) {
    const bool is_mount = change.key == "forward_axis" || change.key.rfind("extrinsic_", 0) == 0;
    if (!is_mount || !d.proposal.is_told(change.key)) continue;
    buts.push_back(say("{} was given as {} and found as {}", change.key, change.before, change.value));
  }
  if (!d.ahead.axis.empty() && !d.ahead.is_known) {
    buts.push_back(say("{} is a guess: the frames do not show which end of the road is ahead", d.ahead.axis));
  }
  if (supposed.road.is_found && std::fabs(supposed.road.off_line_rad) * kDegPerRad > kOffLineTold_deg) {
    buts.push_back(
        say("the road lies {:.1f} deg off {}: does the machine stand so, or the sensor on it "
            "(extrinsic_yaw)?",
            supposed.road.off_line_rad * kDegPerRad, supposed.road.line));
  }
}

// What stands ahead of a standing machine looks like the machine. On the way it would have gone.
void ask_about_body(const Diagnosis& d, Reasons& confirm) {
  const BodySeen& body = d.mount->likely.body;
  const double travel_m = d.preview ? d.preview->travel_m : 0.0;
  if (!body.boxes_base.empty() && travel_m >= kDrive_m) {
    confirm.push_back(
        say("the body boxes hold what stayed in place while the machine moved {:.0f} m: the machine", travel_m));
  } else if (!body.boxes_base.empty()) {
    confirm.push_back(
        say("the body boxes hold the machine and nothing else. A standing machine cannot be told from what stood close "
            "ahead or behind it: examine a drive of {:.0f} m, too. Only the machine stays in place then",
            kDrive_m));
  }
  if (!body.left_out.empty()) {
    confirm.push_back(
        say("things near the sensor without a box: {}. Engine and stop see them. Give one that belongs to the machine "
            "a box by hand (body_box_1 to body_box_4)",
            body.left_out.size()));
  }
}

void ask_to_confirm(const Diagnosis& d, Reasons& confirm) {
  if (!d.stamps.has_stamps()) confirm.push_back(tr("the frames carry no stamps: rate and gaps are those of --rate"));
  if (!d.mount || !d.mount->likely.floor.is_found()) return;
  const SupposedMount& supposed = d.mount->likely;
  if (!d.mount->is_sure) {
    const char* const way = supposed.is_flipped ? tr("upside down") : tr("upright");
    std::string question = say("is the sensor mounted {}, {:.2f} m above the floor?", way, supposed.floor.height_m);
    if (d.mount->other) question += say(" The other plane is {:.2f} m away.", d.mount->other->floor.height_m);
    confirm.push_back(std::move(question));
  }
  if (!d.proposal.is_told("extrinsic_x") && !d.proposal.is_told("extrinsic_y")) {
    confirm.push_back(
        tr("the sensor sits at the origin of base, from which distances are measured; frames cannot show it "
           "(extrinsic_x, extrinsic_y, extrinsic_z)"));
  }
  if (d.ahead.is_known) confirm.push_back(say("{} is ahead: {}", d.ahead.axis, d.ahead.reason));
  ask_about_body(d, confirm);
  if (supposed.body.passing_share > kPassingMax) {
    confirm.push_back(
        say("{:.0f} % of the near returns moved: no box holds a boom or people", 100.0 * supposed.body.passing_share));
  }
}

}  // namespace

const char* grade_name(Grade grade) {
  return grade == Grade::kUsable ? "usable" : grade == Grade::kUsableInPart ? "in_part" : "not";
}

std::string rule_text() {
  return say(
      "Rule: usable if every value is valid in {:.0f} % of at least {:.0f} s; usable in part if some value is valid in "
      "{:.0f} %; else not usable. A recording that does not fit (a machine that moved, no floor, no road) is not "
      "usable "
      "either.",
      100.0 * kValidAll, kDurationAsked_s, 100.0 * kValidSome);
}

std::string RecordingVerdict::headline() const {
  if (grade == Grade::kUsable) return say("usable: {}", reason);
  return grade == Grade::kUsableInPart ? say("usable in part: {}", reason) : say("not usable because {}", reason);
}

std::string RecordingVerdict::line() const {
  return buts.empty() ? headline() : say("{}. But {}", headline(), fmt::join(buts, "; "));
}

RecordingVerdict judge(const Diagnosis& d) {
  RecordingVerdict v;
  Reasons against;
  check_frames(d, against);
  check_mount(d, against);
  const bool has_floor = d.mount && d.mount->likely.floor.is_found();
  if (has_floor) {
    check_standing(d, against);
    check_road(d, against);
  }
  if (against.empty()) {
    grade(d, v);
  } else {
    v.reason = fmt::format("{}", fmt::join(against, "; "));
  }
  doubt_recording(d, v.buts);
  if (has_floor) doubt_mount(d, v.buts);
  ask_to_confirm(d, v.confirm);
  return v;
}

}  // namespace pose_wall::tools::doctor
