// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/simulator.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lab/sim/beam_caster.hpp"
#include "lab/sim/check_setup.hpp"
#include "lab/sim/sensors.hpp"
#include "lab/sim/survey_truth.hpp"

namespace pose_wall::tools::sim {
namespace {

constexpr double kFirstStamp_s = 1000.0;

void append(const Return& r, const Beam& beam, std::uint32_t time_ns, double unit_scale, Frame* frame) {
  if (r.label == Label::kNone) return;
  const Vector p = point_of(beam, r.range_m, unit_scale);
  for (int axis = 0; axis < 3; ++axis) frame->xyz_intensity.push_back(static_cast<float>(p[axis]));
  frame->xyz_intensity.push_back(intensity(r));
  frame->labels.push_back(r.label);
  frame->time_ns.push_back(time_ns);
  frame->ring.push_back(beam.ring);
  frame->column.push_back(beam.step);
}

// As they fire. Those that fire at one instant stay as they are.
void sort_as_they_fire(std::vector<Beam>* beams) {
  std::stable_sort(beams->begin(), beams->end(),
                   [](const Beam& a, const Beam& b) { return a.step + a.share < b.step + b.share; });
}

// Which of the sensor's frames is delivered at this place, after what was dropped and sent twice in the scene. While
// the machine drives in, nothing is.
std::uint32_t sensor_frame(const Setup& setup, std::uint32_t frame_index) {
  const Sequence& sequence = setup.sequence;
  const std::uint32_t driven = drive_in_frames(setup);
  if (frame_index < driven) return frame_index;
  std::uint32_t i = frame_index - driven;
  const auto every = [](double count) { return static_cast<std::uint32_t>(count); };
  if (sequence.duplicate_every >= 1.0) i -= (i + 1u) / (every(sequence.duplicate_every) + 1u);
  if (sequence.drop_every >= 1.0) i += every(sequence.drop_length) * (i / every(sequence.drop_every));
  return driven + i;
}

// A frozen sensor repeats the frame at which it froze.
std::uint32_t seen_frame(const Setup& setup, std::uint32_t frame_index) {
  const Sequence& sequence = setup.sequence;
  const double time_s = frame_time_s(setup, frame_index);
  if (time_s < sequence.freeze_from_s || time_s >= sequence.freeze_to_s) return frame_index;
  return drive_in_frames(setup) + static_cast<std::uint32_t>(std::ceil(sequence.freeze_from_s * sequence.rate_hz));
}

}  // namespace

Simulator::Simulator(const Setup& setup, std::uint64_t seed)
    : setup_(checked(setup)),
      seed_(seed),
      world_(setup, mix(seed)),
      mean_rock_(World::mean(setup)),
      beams_(beams_of(setup.sensor, 0)) {
  if (setup.sequence.scan_s > 0.0) sort_as_they_fire(&beams_);
}

Simulator::Simulator(const Setup& setup, std::uint64_t seed, Survey survey)
    : setup_(checked(setup)),
      seed_(seed),
      survey_(std::move(survey)),
      world_(survey_.rock),
      mean_rock_(survey_.rock),
      beams_(beams_of(setup.sensor, 0)) {
  if (setup.sequence.scan_s > 0.0) sort_as_they_fire(&beams_);
}

Moment Simulator::moment_at(double time_s) const {
  if (survey_.rock == nullptr) {
    const MachinePose pose = pose_at(setup_, time_s);
    return {pose, place(setup_, pose)};
  }
  MachinePose of_time;
  of_time.time_s = time_s;
  return {of_time, survey_.at(time_s * setup_.sequence.rate_hz)};
}

MachinePose Simulator::pose(std::uint32_t frame_index) const {
  return pose_at(setup_, frame_time_s(setup_, sensor_frame(setup_, frame_index)));
}

Frame Simulator::render(std::uint32_t frame_index) const {
  const std::uint32_t seen = seen_frame(setup_, sensor_frame(setup_, frame_index));
  const Sequence& sequence = setup_.sequence;
  const bool repeats = setup_.sensor.rings > 0.0;
  std::vector<Beam> own_beams;
  if (!repeats) own_beams = beams_of(setup_.sensor, seen);
  const std::vector<Beam>& beams = repeats ? beams_ : own_beams;

  Frame frame;
  frame.stamp_ns = stamp_ns(frame_index);
  frame.xyz_intensity.reserve(4 * beams.size());
  frame.labels.reserve(beams.size());
  const double begin_s = frame_time_s(setup_, seen), step_s = sequence.scan_s / scan_steps(setup_.sensor);
  BeamCaster caster(setup_, world_, moment_at(begin_s), mix(seed_) ^ mix(seen + 1u));
  std::uint32_t step = 0;
  for (const Beam& beam : beams) {
    if (step_s > 0.0 && beam.step != step) caster.move_to(moment_at(begin_s + beam.step * step_s));
    step = beam.step;
    const auto time_ns = static_cast<std::uint32_t>(std::lround((beam.step + beam.share) * step_s * 1e9));
    const BeamCaster::Returns returns = caster.cast(beam);
    append(returns.first, beam, time_ns, setup_.sensor.unit_scale, &frame);
    append(returns.second, beam, time_ns, setup_.sensor.unit_scale, &frame);
  }
  return frame;
}

Moment Simulator::truth_moment(std::uint32_t frame_index) const {
  return moment_at(frame_time_s(setup_, sensor_frame(setup_, frame_index)));
}

TruthRow Simulator::with_pose(TruthRow row, std::uint32_t frame_index, const Placement& at) const {
  const Eigen::Quaterniond q(at.R_road_base);
  const Vector& p = at.origin_road;
  row.pose = BasePose{p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
  row.frame = frame_index;
  row.stamp_ns = stamp_ns(frame_index);
  return row;
}

TruthRow Simulator::truth(std::uint32_t frame_index, StepRule rule) const {
  if (survey_.rock != nullptr) return surveyed_truth(frame_index);
  const Moment moment = truth_moment(frame_index);
  return with_pose(truth_of(setup_, mean_rock_, moment.pose, rule), frame_index, moment.at);
}

TruthRow Simulator::surveyed_truth(std::uint32_t frame_index) const {
  const Placement at = truth_moment(frame_index).at;
  return with_pose(survey_truth(world_, at, setup_.machine, setup_.sensor), frame_index, at);
}

std::int64_t Simulator::stamp_ns(std::uint32_t frame_index) const {
  const Sequence& q = setup_.sequence;
  const std::uint32_t delivered = sensor_frame(setup_, frame_index);
  const double begin_s = kFirstStamp_s + drive_in_frames(setup_) / q.rate_hz;
  double time_s = frame_time_s(setup_, delivered);
  const bool jumped = q.stamp_jump_s != 0.0 && time_s >= q.stamp_jump_at_s;
  if (time_s >= q.stamp_still_from_s && time_s < q.stamp_still_to_s) {
    time_s = q.stamp_still_from_s;
  } else if (q.stamp_jitter_s > 0.0) {
    time_s += q.stamp_jitter_s * Random(seed_, delivered + 1u).gaussian();
  }
  return std::llround((begin_s + time_s + (jumped ? q.stamp_jump_s : 0.0)) * 1e9);
}

}  // namespace pose_wall::tools::sim
