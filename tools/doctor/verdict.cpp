// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "angles.hpp"
#include "doctor/diagnosis.hpp"
#include "doctor/statistics.hpp"
#include "terminal/counted.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr std::size_t kFramesMin = 3;
constexpr double kDurationMin_s = 20.0;
constexpr double kFaultShareMax = 0.2;
// What a machine that stands with its motors running may move, beyond what one frame scatters.
constexpr double kTiltMoved_deg = 1.0, kAzimuthMoved_deg = 1.5, kDistanceMoved_m = 0.1, kSigmas = 4.0;
constexpr double kOffLineMax_deg = 35.0, kOffLineTold_deg = 5.0;
constexpr double kMeasuredMin = 0.8, kSideMin = 0.5, kValidMin = 0.5;
constexpr double kNoiseMax_m = 0.03;
constexpr double kPassingMax = 0.03;

bool has_moved(double spread, double sigma, double allowed) {
  return spread > std::max(allowed, kSigmas * sigma);
}

void judge_frames(const Diagnosis& d, Verdict& v) {
  const StampHealth& s = d.stamps;
  const std::size_t steps = std::max<std::size_t>(s.frames, 1);
  if (s.frames < kFramesMin) {
    v.against.push_back(counted(s.frames, "frame") +
                        ": what stays and what moves needs 3 at least, and 30 s are asked");
  } else if (share(s.back + s.still, steps) > kFaultShareMax) {
    v.against.push_back(fmt::format("the stamps stand still {} times and go back {} times", s.still, s.back));
  } else if (share(s.repeated, steps) > kFaultShareMax) {
    v.against.push_back(
        fmt::format("{} repeat the points before them: the sensor is frozen", counted(s.repeated, "frame")));
  } else if (share(s.empty, steps) > kFaultShareMax) {
    v.against.push_back(fmt::format("{} of {} hold no return", s.empty, counted(s.frames, "frame")));
  }
  if (d.sensor.range_median_m > 200.0) {
    v.against.push_back(fmt::format("half of the points lie beyond {:.0f} m: millimetres?", d.sensor.range_median_m));
  }
}

void judge_mount(const Diagnosis& d, Verdict& v) {
  if (!d.mount) {
    if (v.against.empty()) v.against.push_back("no frame holds enough returns");
    return;
  }
  const FloorSeen& floor = d.mount->story.floor;
  if (!floor.is_found()) {
    v.against.push_back(fmt::format("the floor is seen in {:.0f} % of the frames", 100.0 * floor.measured));
    return;
  }
  if (d.mount->contradicts_height) {
    v.against.push_back(fmt::format("{}, it is seen {:.2f} m below", d.mount->reason, floor.height_m));
    return;
  }
  // Upright is how sensors are mounted; the other way round somebody has to say it.
  if (d.mount->story.is_flipped && !d.mount->is_sure) {
    v.against.push_back(
        fmt::format("{}: a roof, or the floor under a sensor upside down? --height M or extrinsic_roll "
                    "decides",
                    d.mount->reason));
  }
  if (has_moved(floor.tilt_spread_rad * kDegPerRad, floor.tilt_sigma_rad * kDegPerRad, kTiltMoved_deg)) {
    v.against.push_back(fmt::format("the sensor moved while it was recorded (its tilt by {:.1f} deg): let it stand",
                                    floor.tilt_spread_rad * kDegPerRad));
  }
}

void judge_road(const Diagnosis& d, Verdict& v) {
  if (!d.mount || !d.mount->story.floor.is_found()) return;
  const RoadAxis& road = d.mount->story.road;
  if (!road.is_found) {
    v.against.push_back("no side walls are seen along any axis");
    return;
  }
  if (road.is_ambiguous) {
    v.against.push_back("the walls across make as good a road as those along: a room or a crossing");
  } else if (std::fabs(road.off_line_rad) * kDegPerRad > kOffLineMax_deg) {
    v.against.push_back(
        fmt::format("the road lies {:.0f} deg off the nearest axis ({}): turn the machine along it, or "
                    "tell extrinsic_yaw",
                    road.off_line_rad * kDegPerRad, road.line));
  }
  const bool turned =
      has_moved(road.azimuth_spread_rad * kDegPerRad, road.azimuth_sigma_rad * kDegPerRad, kAzimuthMoved_deg);
  const bool told = !v.against.empty() && v.against.back().find("moved") != std::string::npos;
  if (!told && (turned || has_moved(road.distance_spread_m, road.distance_sigma_m, kDistanceMoved_m))) {
    v.against.push_back(
        fmt::format("the sensor moved while it was recorded (the road by {:.1f} deg, walls by {:.2f} m)",
                    road.azimuth_spread_rad * kDegPerRad, road.distance_spread_m));
  }
}

double side(const std::array<double, POSE_WALL_QUANTITIES>& shares, bool left) {
  const std::uint32_t front = left ? POSE_WALL_D_LF : POSE_WALL_D_RF;
  return std::max(shares[front], shares[front + 1]);
}

void judge_check(const Diagnosis& d, Verdict& v) {
  if (!d.check) return;
  const Check& c = *d.check;
  const double angles = std::min({c.measured[POSE_WALL_ROLL], c.measured[POSE_WALL_PITCH], c.measured[POSE_WALL_YAW]});
  if (angles < kMeasuredMin) {
    v.against.push_back(fmt::format("with these settings the angles are measured in {:.0f} % of the frames ({})",
                                    100.0 * angles, c.reasons));
    return;
  }
  const double left = side(c.measured, true), right = side(c.measured, false);
  if (std::max(left, right) < kSideMin)
    v.against.push_back("neither wall's distance is measured in half of the frames");
  for (const bool is_left : {true, false}) {
    if (side(c.measured, is_left) >= kMeasuredMin) continue;
    v.buts.push_back(fmt::format("the {} wall is measured in {:.0f} % of the frames", is_left ? "left" : "right",
                                 100.0 * side(c.measured, is_left)));
  }
  std::vector<std::string> weak;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    if (c.measured[q] >= kSideMin && c.valid[q] < kValidMin) weak.emplace_back(pose_wall_quantity_name(q));
  }
  if (!weak.empty()) v.buts.push_back(fmt::format("mostly degraded: {} ({})", fmt::join(weak, ", "), c.reasons));
}

void doubt_recording(const Diagnosis& d, Verdict& v) {
  const StampHealth& s = d.stamps;
  if (s.duration_s < kDurationMin_s) v.buts.push_back(fmt::format("only {:.1f} s were recorded", s.duration_s));
  if (s.unreadable > 0) v.buts.push_back(counted(s.unreadable, "frame") + " could not be read");
  if (s.empty > 0) v.buts.push_back(counted(s.empty, "frame") + " without a return");
  if (s.cut > 0) v.buts.push_back(counted(s.cut, "frame") + " cut short");
  if (s.repeated > 0) v.buts.push_back(counted(s.repeated, "repeated frame"));
  if (s.still + s.back > 0) v.buts.push_back(fmt::format("stamps: {} still, {} back", s.still, s.back));
  if (s.gaps > 0) v.buts.push_back(fmt::format("{}, up to {:.2f} s", counted(s.gaps, "gap"), s.gap_max_s));
  if (!s.has_stamps()) v.confirm.push_back("the frames carry no stamps: rate and gaps are those of --rate");
  if (d.sensor.model == "unknown") {
    v.buts.push_back("the sensor is of no known class: its gates are the defaults");
  }
}

void doubt_mount(const Diagnosis& d, Verdict& v) {
  if (!d.mount || !d.mount->story.floor.is_found()) return;
  const MountStory& story = d.mount->story;
  if (!d.mount->is_sure) {
    const std::string other =
        d.mount->other ? fmt::format("; the other plane is {:.2f} m away", d.mount->other->floor.height_m) : "";
    if (!story.is_flipped) {
      v.buts.push_back(fmt::format("upright or upside down is not certain ({}): --height M decides", d.mount->reason));
    }
    v.confirm.push_back(fmt::format("mounted {}, {:.2f} m above the floor?{}",
                                    story.is_flipped ? "upside down" : "upright", story.floor.height_m, other));
  }
  if (story.floor.tilt_level_rad * kDegPerRad > 1.0) {
    v.buts.push_back(
        fmt::format("the mounting's tilt is known within {:.1f} deg only", story.floor.tilt_level_rad * kDegPerRad));
  }
  const bool place_told = d.proposal.is_told("extrinsic_x") || d.proposal.is_told("extrinsic_y");
  if (!place_told) {
    v.confirm.push_back(
        "the sensor sits at base's origin: no frame tells otherwise, and the distances are measured from there "
        "(extrinsic_x, extrinsic_y, extrinsic_z)");
  }
  const double noise_m = story.noise.best_m();
  if (noise_m > kNoiseMax_m) v.buts.push_back(fmt::format("ranges scatter by {:.0f} mm", 1e3 * noise_m));
  for (const Change& change : d.proposal.changes()) {
    const bool is_mount = change.key == "forward_axis" || change.key.rfind("extrinsic_", 0) == 0;
    if (!is_mount || !d.proposal.is_told(change.key)) continue;
    v.buts.push_back(fmt::format("{} was told as {}, found as {}", change.key, change.before, change.value));
  }
  if (!d.ahead.axis.empty() && !d.ahead.is_known) {
    v.buts.push_back(fmt::format("{} is a guess: which end of the road is ahead cannot be seen", d.ahead.axis));
  }
  if (d.ahead.is_known) v.confirm.push_back(fmt::format("{} is ahead: {}", d.ahead.axis, d.ahead.reason));
  if (story.road.is_found && std::fabs(story.road.off_line_rad) * kDegPerRad > kOffLineTold_deg) {
    v.buts.push_back(
        fmt::format("the road lies {:.1f} deg off {}: does the machine stand so, or the sensor on it "
                    "(extrinsic_yaw)?",
                    story.road.off_line_rad * kDegPerRad, story.road.line));
  }
  if (!story.body.boxes_base.empty()) v.confirm.push_back("the body boxes hold the machine and nothing else");
  if (!story.body.unexplained.empty()) {
    v.confirm.push_back(counted(story.body.unexplained.size(), "thing") + " near the sensor that may be the machine's");
  }
  if (story.body.passing_share > kPassingMax) {
    v.confirm.push_back(fmt::format("{:.0f} % of the near returns moved: a boom or people are in no box",
                                    100.0 * story.body.passing_share));
  }
}

}  // namespace

std::string Verdict::line() const {
  if (!is_usable()) return fmt::format("not usable because {}", fmt::join(against, "; "));
  return buts.empty() ? "ready" : fmt::format("ready, but {}", fmt::join(buts, "; "));
}

Verdict judge(const Diagnosis& d) {
  Verdict v;
  judge_frames(d, v);
  judge_mount(d, v);
  judge_road(d, v);
  if (v.against.empty()) judge_check(d, v);
  doubt_recording(d, v);
  doubt_mount(d, v);
  return v;
}

}  // namespace pose_wall::tools::doctor
