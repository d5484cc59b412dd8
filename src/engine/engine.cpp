// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/engine.hpp"

#include <cmath>
#include <cstring>

#include "base/math/fnv1a.hpp"
#include "base/math/rotation.hpp"
#include "base/simd/four_floats.hpp"
#include "engine/cloud/outliers.hpp"
#include "engine/cloud/voxels.hpp"
#include "engine/floor/floor.hpp"
#include "engine/floor/levelling.hpp"
#include "engine/floor/region.hpp"
#include "engine/floor/rivals.hpp"
#include "engine/gates/gate.hpp"
#include "engine/output/labels.hpp"
#include "engine/output/quality.hpp"
#include "engine/report.hpp"
#include "engine/walls/region.hpp"
#include "lidar/mount.hpp"

namespace pose_wall {
namespace {

Axes axes_of(std::int32_t forward_choice) {
  const Eigen::Vector2d f = forward_of(forward_choice);
  return {Eigen::Vector3d(f.x(), f.y(), 0.0), Eigen::Vector3d(-f.y(), f.x(), 0.0)};
}

Extrinsic extrinsic_of(const Settings& s) {
  return {rotation_zyx(s.extrinsic_roll, s.extrinsic_pitch, s.extrinsic_yaw),
          Eigen::Vector3d(s.extrinsic_x, s.extrinsic_y, s.extrinsic_z)};
}

// Refuses floor and walls, since all depend on it.
void refuse_all(const Verdict& verdict, FrameFindings* found) {
  found->floor.fit.add(verdict);
  for (JudgedWall& wall : found->walls.side) wall.fit.add(verdict);
}

// Checked before any search.
bool is_work_left(Work* work, FrameFindings* found) {
  if (!work->stops()) return true;
  demand_work_left(*work, &found->floor.fit);
  for (int side = 0; side < 2; ++side) {
    POSE_WALL_NOTE(const trace::About about(trace::side_subject(side)));
    demand_work_left(*work, &found->walls.side[side].fit);
  }
  return false;
}

// The times of the points are read, and they stay where they are.
pose_wall_odometry without_motion(const pose_wall_odometry& odometry) {
  pose_wall_odometry out = odometry;
  for (int k = 0; k < 3; ++k) out.velocity_m_s[k] = out.turn_rate_rad_s[k] = 0.0;
  return out;
}

double least_confidence(const pose_wall_result& result) {
  double least = 1.0;
  for (const pose_wall_value& v : result.quantity) {
    if (v.confidence < least) least = v.confidence;
  }
  return least;
}

}  // namespace

void Scratch::lay_out(Arena& arena, std::uint32_t points_max) {
  marks = arena.take<std::uint8_t>(points_max + kFour);
  returns_lidar.lay_out(arena);
  print = arena.take_one<CloudPrint>();
  cloud_base.lay_out(arena, points_max);
  // The stages run one after the other, so buffers of one lie on top of buffers of another. The grid serves voxels and
  // outliers, and starts anew for the band, which is cut after the floor is found.
  const std::uint64_t before_band = arena.place();
  band_level.lay_out(arena, points_max);
  beyond_level.lay_out(arena, kBeyondMax);
  const std::uint64_t behind_band = arena.place();
  grid.lay_out(arena, points_max);
  arena.go_back(before_band);
  floor.lay_out(arena, points_max);
  arena.go_back(behind_band);
  walls.lay_out(arena, points_max);
  arena.go_behind_all();
}

std::uint64_t Engine::lay_out(void* block, const Settings& settings, Engine** out) {
  Arena arena(block);
  Engine* engine = arena.take_one<Engine>();
  Scratch measured;
  Scratch& scratch = engine != nullptr ? engine->scratch_ : measured;
  scratch.lay_out(arena, settings.points_max);
  if (out != nullptr) *out = engine;
  return arena.bytes();
}

void Engine::open(const Settings& settings, std::uint32_t config_crc32) {
  config_crc32_ = config_crc32;
  settings_ = settings;
  axes_ = axes_of(settings.forward_axis);
  extrinsic_ = extrinsic_of(settings);
  reset();
  door_.open(kMagic, this);
  seal();
}

void Engine::reset() {
  memory_ = Memory{};
  points_ = pose_wall_points{};
  seal();
}

void Engine::set_clock(pose_wall_clock clock, void* user) {
  clock_ = clock;
  clock_user_ = user;
  seal();
}

// Magic and place are written by open() alone, so that two calls at once may read them.
std::int32_t Engine::enter() const {
  const std::int32_t status = door_.enter(kMagic, this);
  if (status != POSE_WALL_OK || is_whole()) return status;
  leave();
  return POSE_WALL_E_ENGINE;
}

void Engine::leave() const {
  door_.leave();
}

bool Engine::is_inside(const void* block) {
  const Engine* const there = static_cast<const Engine*>(block);
  return there->door_.is_entered(kMagic, there);
}

void Engine::set_memory(const Memory& memory) {
  memory_ = memory;
  seal();
}

// Seen clouds are forgotten, since their stamps are of the other clock.
void Engine::set_memory_of_other_clock(const Memory& memory, double elapsed_s, std::int64_t stamp_ns) {
  memory_ = memory;
  rebase(elapsed_s, stamp_ns, settings_, &memory_.temporal);
  memory_.repeat_guard = RepeatGuard{};
  memory_.repeats = 0;
  memory_.odometry.run = OdometryMemory::kNoRun;
  memory_.own.forget();
  seal();
}

// FNV-1a by words: each step maps different sums to different ones, so every change of a single word shows.
std::uint64_t Engine::sum() const {
  static_assert(alignof(Engine) == alignof(Scratch) && (sizeof(Engine) - sizeof(Scratch)) % sizeof(std::uint64_t) == 0,
                "the scratch is the last member, and whole words stand before it");
  const unsigned char* const bytes = reinterpret_cast<const unsigned char*>(this);
  std::uint64_t sum = kFnv1aOfNothing;
  for (std::size_t at = sizeof(seal_) + Door::kChangingBytes; at < guarded_bytes(); at += sizeof(std::uint64_t)) {
    std::uint64_t word;
    std::memcpy(&word, bytes + at, sizeof(word));
    sum = fnv1a_with(sum, word);
  }
  return sum;
}

// True if the motion within the scan was taken out of it.
bool Engine::read_cloud(const pose_wall_cloud& cloud, FrameFindings* found) {
  const pose_wall_odometry* const odometry = odometry_in(cloud.inputs);
  const bool taken_out = MotionInScan(odometry, settings_, axes_).improves(memory_.own);
  const pose_wall_odometry left = odometry != nullptr ? without_motion(*odometry) : pose_wall_odometry{};
  found->voxels =
      build_voxels(cloud, taken_out || odometry == nullptr ? odometry : &left, settings_, extrinsic_, axes_,
                   memory_.leaf, &scratch_.grid, {&scratch_.returns_lidar, scratch_.print}, &scratch_.cloud_base);
  return taken_out && found->voxels.scan.whole_s > 0.0;
}

void Engine::process(const pose_wall_cloud& cloud, pose_wall_result* result) {
  place(&scratch_);
  FrameFindings found;
  found.stamp_ns = cloud.stamp_ns;
  // Each frame draws the same numbers, so that a frame's result does not depend on the number of frames before it.
  Random random(settings_.random_seed);
  std::int64_t at[POSE_WALL_STAGES + 1] = {now()};
  const auto stage_done = [&](pose_wall_stage stage) { at[stage + 1] = now(); };

  const bool taken_out = read_cloud(cloud, &found);
  result->voxels = scratch_.cloud_base.count;
  stage_done(POSE_WALL_STAGE_VOXEL);
  Work work(work_most(settings_, found.voxels.returns, scratch_.cloud_base.count));
  work.add(found.voxels.work);
  found.outliers = remove_outliers(settings_, &scratch_.grid, scratch_.marks, &scratch_.cloud_base, &work);
  stage_done(POSE_WALL_STAGE_OUTLIERS);
  scratch_.floor.work = work;
  find_floor_if_any(&random, &found);
  work = scratch_.floor.work;
  stage_done(POSE_WALL_STAGE_FLOOR);
  level_and_cut(&found);
  work.add(found.floor.fit.refused ? 0 : scratch_.cloud_base.count, steps::kVoxelLevelled);
  scratch_.walls.fit.work = work;
  stage_done(POSE_WALL_STAGE_BAND);
  find_walls_if_level(&random, &found);
  found.work = scratch_.walls.fit.work.done();
  const std::uint32_t of_fits =
      found.floor.fit.reasons | found.walls.side[0].fit.reasons | found.walls.side[1].fit.reasons;
  found.reasons |= of_fits & POSE_WALL_R_WORK_LIMIT;
  stage_done(POSE_WALL_STAGE_WALLS);
  conclude(cloud.inputs, taken_out, &found, result);
  stage_done(POSE_WALL_STAGE_OUTPUT);

  for (int stage = 0; stage < POSE_WALL_STAGES; ++stage) result->stage_ns[stage] = at[stage + 1] - at[stage];
  const PointSet& c = scratch_.cloud_base;
  points_ = {c.x.data(), c.y.data(), c.z.data(), scratch_.marks.data(), c.count, 0};
  seal();
}

// Anew in every frame: a pointer changed since the last one would be used, too.
void Engine::place(Scratch* scratch) const {
  Arena arena(const_cast<Engine*>(this));  // the owner gave this memory to be written to
  arena.take<Engine>(1);
  scratch->lay_out(arena, settings_.points_max);
}

pose_wall_points Engine::points() const {
  Scratch scratch;
  place(&scratch);
  scratch.cloud_base.count = points_.count;
  label_points(scratch.cloud_base, labelled_by_, settings_, scratch.marks);
  return points_;
}

// True if there are enough points, and work left to use them.
bool Engine::can_begin(FrameFindings* found) {
  const VoxelResult& voxels = found->voxels;
  Verdict frame, start;
  demand<gate::LEAF>(&frame, voxels.leaf_m, settings_);
  if (demand<gate::VOXELS_FIT>(&start, voxels.fits)) {
    demand<gate::POINTS>(&start, scratch_.cloud_base.count, settings_);
  }
  found->reasons |= frame.reasons | start.reasons;
  if (start.refused) refuse_all(start, found);
  POSE_WALL_NOTE(const trace::About about(POSE_WALL_TRACE_FLOOR));
  return !start.refused && is_work_left(&scratch_.floor.work, found);
}

void Engine::find_floor_if_any(Random* random, FrameFindings* found) {
  if (!can_begin(found)) return;
  const Plane* const last = memory_.last.has_floor ? &memory_.last.floor_base : nullptr;
  const FloorScene scene{scratch_.cloud_base, settings_, axes_, extrinsic_.sensor_base_m, last};
  found->floor = find_floor(scene, random, &scratch_.floor);
  if (settings_.region == kRegionOn) measure_floor_region(scene, &scratch_.floor, &found->floor);
}

void Engine::level_and_cut(FrameFindings* found) {
  scratch_.band_level.count = 0;
  scratch_.beyond_level.count = 0;
  if (found->floor.fit.refused) return;
  found->levelling = levelling_by(found->floor.fit.plane, axes_);
  cut_wall_band(scratch_.cloud_base, found->levelling, settings_, &scratch_.grid, &scratch_.band_level,
                &scratch_.beyond_level);
  found->wall_points = scratch_.band_level.count;
}

void Engine::find_walls_if_level(Random* random, FrameFindings* found) {
  POSE_WALL_NOTE(trace::subject(POSE_WALL_TRACE_WALLS));
  Verdict level;
  if (!demand<gate::LEVELLED>(&level, !found->floor.fit.refused)) {
    for (JudgedWall& wall : found->walls.side) wall.fit.add(level);
    return;
  }
  const WallScene scene = wall_scene(
      {scratch_.band_level, scratch_.beyond_level, scratch_.cloud_base, scratch_.returns_lidar, found->voxels.counts},
      settings_, found->levelling, axes_, extrinsic_);
  const Surfaces& before = memory_.last;
  const Plane* const last[2] = {before.has_wall[0] ? &before.wall_level[0] : nullptr,
                                before.has_wall[1] ? &before.wall_level[1] : nullptr};
  static_cast<WallsResult&>(found->walls) = find_walls(scene, last, random, &scratch_.walls);
  if (settings_.region == kRegionOn) measure_wall_regions(scene, &scratch_.walls, &found->walls);
  found->floor = doubted_by_walls(found->floor, found->walls.tilt_level_rad, settings_, found->levelling);
}

// An odometry counts if the key allows it and its numbers are sound.
const pose_wall_odometry* Engine::odometry_in(const pose_wall_inputs* inputs) const {
  const bool given = inputs != nullptr && (inputs->given & POSE_WALL_INPUT_ODOMETRY) != 0;
  return given && settings_.motion == kMotionOn && is_sound(inputs->odometry) ? &inputs->odometry : nullptr;
}

// The change since the last frame by the odometry. After that, this frame's place and surfaces are memory. A frame
// without a place ends the run, and only the config bounds the motion since. A repeated cloud shows a standing machine
// and gives no place.
Engine::OdometryStep Engine::follow_odometry(const pose_wall_inputs* inputs, const Change& by_config,
                                             const FrameFindings& found) {
  OdometryStep step;
  step.change = by_config;
  const pose_wall_odometry* const odometry = odometry_in(inputs);
  step.sound = odometry != nullptr || inputs == nullptr || (inputs->given & POSE_WALL_INPUT_ODOMETRY) == 0 ||
               settings_.motion != kMotionOn;
  OdometryMemory& memory = memory_.odometry;
  if (odometry == nullptr || (found.reasons & POSE_WALL_R_FROZEN) != 0) {
    memory.run = OdometryMemory::kNoRun;
    return step;
  }
  if (odometry->run == memory.run) {
    step.follows = change_by_odometry(*odometry, memory, settings_, axes_, &step.change);
    step.sound = step.follows;
    if (!step.follows) memory.run = OdometryMemory::kNoRun;
  }
  remember_place(*odometry, found.floor, found.levelling, found.walls.side, found.measured, settings_, axes_, &memory);
  return step;
}

// A repeated cloud was bent by its first copy's motion, so none was rightly taken out.
void Engine::widen_by_scan_motion(const pose_wall_inputs* inputs, bool taken_out, const ScanStep& step,
                                  FrameFindings* found) {
  const bool repeats = (found->reasons & POSE_WALL_R_FROZEN) != 0;
  MotionInScan(odometry_in(inputs), settings_, axes_)
      .widen(taken_out && !repeats, scan_in_time(found->voxels.scan, step, settings_), found->levelling,
             found->walls.side, &memory_.own, &found->measured);
}

// By the odometry, else by the other inputs, if they are sound and no measurement contradicts them.
Change Engine::change_since_last(const pose_wall_inputs* inputs, const FrameTiming& timing, FrameFindings* found) {
  const double elapsed_s = elapsed_of(memory_.temporal, timing);
  const Change by_config = change_by_config(settings_, elapsed_s);
  const OdometryStep step = follow_odometry(inputs, by_config, *found);
  if (inputs == nullptr) return by_config;
  const auto believed = [&](const Change& change) {
    return !contradict(change, found->measured, timing, memory_.temporal);
  };
  bool boxes = true;
  for (const auto& edges_m : inputs->body_box) boxes = box_of(edges_m).is_sound() && boxes;
  const bool by_odometry = step.follows && believed(step.change);
  // With an odometry, the other inputs only have to make sense.
  Change by_others = by_config;
  const std::uint32_t others = POSE_WALL_INPUT_STANDING | POSE_WALL_INPUT_SPEED | POSE_WALL_INPUT_TURN_RATE;
  bool told = (inputs->given & others) == 0;
  if (!told && boxes) {
    told = change_by_inputs(*inputs, settings_, elapsed_s, &by_others) && (by_odometry || believed(by_others));
    if (!told) by_others = by_config;
  }
  const Change change = by_odometry ? step.change : by_others;
  const bool all_used = boxes && told && step.sound && by_odometry == step.follows;
  POSE_WALL_NOTE(trace::subject(POSE_WALL_TRACE_FRAME));
  Verdict frame;
  demand<gate::INPUTS>(&frame, all_used);
  found->reasons |= frame.reasons;
  return change;
}

void Engine::conclude(const pose_wall_inputs* inputs, bool motion_taken_out, FrameFindings* found,
                      pose_wall_result* result) {
  const FrameTiming timing = time_frame(memory_.temporal, found->stamp_ns, settings_);
  found->reasons |= timing.reasons;
  found->measured = measure_quantities(found->floor, found->levelling, found->walls, settings_);
  doubt_repeats(timing, found);
  widen_by_scan_motion(inputs, motion_taken_out, scan_step_of(memory_.temporal, timing, settings_), found);
  const Change change = change_since_last(inputs, timing, found);
  smooth_and_hold(found->measured, timing, found->stamp_ns, change, settings_, &memory_.temporal, &result->quantity);
  report_findings(*found, result);
  result->frame_index = memory_.frames++;
  finish(result);
  remember(*found);
}

void Engine::finish(pose_wall_result* result) {
  result->confidence = least_confidence(*result);
  result->config_crc32 = config_crc32_;
  result->source_id = settings_.source_id;
  set_senses(settings_.forward_axis, &result->positive_means);
  result->publication = ++memory_.publications;
  result->mark = mark_of(*result);
}

// The very same points under a new stamp, all of them or a part: the driver or the network repeats them, no LiDAR does.
// Under the old stamp it is the same frame once more, with nothing new to measure.
void Engine::doubt_repeats(const FrameTiming& timing, FrameFindings* found) {
  Repeat repeat;
  if (scratch_.cloud_base.count >= limit_of<gate::POINTS>(settings_)) {
    repeat = memory_.repeat_guard.keep(*scratch_.print, found->stamp_ns);
    memory_.repeats = repeat.is_one ? memory_.repeats + 1 : 0;
  }
  constexpr double kAnyNumber = 1e9;  // of repeats, if the clock went back since the first copy
  POSE_WALL_NOTE(trace::subject(POSE_WALL_TRACE_FRAME));
  const double repeats = repeat.is_one && !timing.still ? memory_.repeats : 0.0;
  Verdict verdict;
  const bool frozen = !demand<gate::REPEATED>(&verdict, repeats, settings_);
  const bool too_often =
      !demand<gate::FROZEN>(&verdict, frozen && repeat.age_s < 0.0 ? kAnyNumber : repeats, settings_);
  const std::uint32_t reasons = timing.reasons | verdict.reasons;
  found->reasons |= reasons;
  const Change since_first = change_by_config(settings_, repeat.age_s);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    Measurement& m = found->measured.quantity[q];
    // The cloud is as old as its first copy, and the machine may have moved since.
    if (frozen) m.protection[POSE_WALL_PART_AGE] += since_first.growth[q];
    m.reasons |= reasons;
    m.stale = frozen;
    if (timing.still || too_often) m.measured = false;
  }
}

void Engine::remember(const FrameFindings& found) {
  memory_.leaf = found.voxels.leaf;
  memory_.last.has_floor = !found.floor.fit.refused;
  memory_.last.floor_base = found.floor.fit.plane;
  for (int side = 0; side < 2; ++side) {
    memory_.last.has_wall[side] = !found.walls.side[side].fit.refused;
    memory_.last.wall_level[side] = found.walls.side[side].fit.plane;
  }
  labelled_by_ = memory_.last;
}

void Engine::age(std::int64_t stamp_ns, pose_wall_result* result) {
  FrameFindings nothing;
  nothing.stamp_ns = stamp_ns;
  nothing.reasons = POSE_WALL_R_NO_FRAME;
  // A leap, or a stamp before the last frame, is judged when that frame comes.
  const double elapsed_s = time_frame(memory_.temporal, stamp_ns, settings_).dt_s;
  age_values(elapsed_s, nothing.reasons, settings_, &memory_.temporal, &result->quantity);
  report_findings(nothing, result);
  result->frame_index = memory_.frames - 1;  // before the first frame all ones, which is no frame's number
  finish(result);
  seal();
}

}  // namespace pose_wall
