// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The pipeline and its memory.

#pragma once

#include "base/containers/arena.hpp"
#include "engine/cloud/direction_grid.hpp"
#include "engine/cloud/voxel_grid.hpp"
#include "engine/config.hpp"
#include "engine/floor/scene.hpp"
#include "engine/output/motion_in_scan.hpp"
#include "engine/output/temporal.hpp"
#include "engine/output/temporal_odometry.hpp"
#include "engine/report.hpp"
#include "engine/types.hpp"
#include "engine/walls/walls.hpp"
#include "lidar/seen_clouds.hpp"
#include "part/door.hpp"
#include "pose_wall.h"

namespace pose_wall {

// Buffers of one frame. A frame uses only values that it wrote itself. Values behind the last of a row are read with
// it, and masked.
struct Scratch {
  VoxelGrid grid;
  Span<std::uint8_t> marks;  // for each point, and a four behind the last: keep flags, then labels on demand
  ReturnsByDirection returns_lidar;
  CloudPrint* print = nullptr;
  BoundedPoints cloud_base;
  BoundedPoints band_level;
  BoundedPoints beyond_level;
  FloorScratch floor;
  WallsScratch walls;

  void lay_out(Arena& arena, std::uint32_t points_max);
};

// The memory of one frame for the next.
struct Memory {
  TemporalState temporal;
  Surfaces last;
  LeafMemory leaf;
  RepeatGuard repeat_guard;
  OdometryMemory odometry;
  OwnChanges own;
  std::uint32_t repeats = 0;  // number of repeated clouds in a row; clouds without points do not count
  std::uint64_t frames = 0;
  std::uint64_t publications = 0;  // results, including those of age()
};

// The layout of the caller's block:
//
//   | Engine | marks | returns | cloud_base | band_level | beyond_level | grid  |
//                                           | floor                             |
//                                                                     | walls |
//
// Engine is written at open and lives on. The rest is scratch that each frame writes before it reads. Overlapping parts
// are never in use at the same time: the grid starts anew for the band, which is cut once the floor is known.
class Engine {
 public:
  // Measures (block NULL) or places an engine.
  static std::uint64_t lay_out(void* block, const Settings& settings, Engine** out);

  void open(const Settings& settings, std::uint32_t config_crc32);
  void reset();
  void set_clock(pose_wall_clock clock, void* user);
  // One call at a time: after POSE_WALL_OK leave() must follow. POSE_WALL_E_BUSY: another call is inside.
  // POSE_WALL_E_ENGINE: not open, or changed from outside since its last call.
  std::int32_t enter() const;
  void leave() const;
  // True if a call is inside an engine in this block, which may hold anything.
  static bool is_inside(const void* block);
  void process(const pose_wall_cloud& cloud, pose_wall_result* result);
  // The seven values at a time without a frame.
  void age(std::int64_t stamp_ns, pose_wall_result* result);
  // With labels, computed on demand.
  pose_wall_points points() const;
  std::uint32_t config_crc32() const { return config_crc32_; }
  const Memory& memory() const { return memory_; }
  void set_memory(const Memory& memory);
  // elapsed_s: since memory's stamp, for a clock that started anew; negative: unknown.
  void set_memory_of_other_clock(const Memory& memory, double elapsed_s, std::int64_t stamp_ns);

  // Number of bytes under the sum, from the start of the block. The rest may hold anything between two calls.
  static std::uint64_t guarded_bytes() { return sizeof(Engine) - sizeof(Scratch); }

 private:
  static constexpr std::uint64_t kMagic = 0x706F73652D77616CULL;  // 'pose-wal' in ASCII: an engine was placed here

  void place(Scratch* scratch) const;
  bool can_begin(FrameFindings* found);
  void find_floor_if_any(Random* random, FrameFindings* found);
  void level_and_cut(FrameFindings* found);
  void find_walls_if_level(Random* random, FrameFindings* found);
  bool read_cloud(const pose_wall_cloud& cloud, FrameFindings* found);
  void conclude(const pose_wall_inputs* inputs, bool motion_taken_out, FrameFindings* found, pose_wall_result* result);
  void widen_by_scan_motion(const pose_wall_inputs* inputs, bool taken_out, const ScanStep& step, FrameFindings* found);
  void doubt_repeats(const FrameTiming& timing, FrameFindings* found);
  struct OdometryStep {
    bool sound = true;     // or not given
    bool follows = false;  // it follows the last frame's, in one run
    Change change;
  };
  OdometryStep follow_odometry(const pose_wall_inputs* inputs, const Change& by_config, const FrameFindings& found);
  Change change_since_last(const pose_wall_inputs* inputs, const FrameTiming& timing, FrameFindings* found);
  const pose_wall_odometry* odometry_in(const pose_wall_inputs* inputs) const;
  void finish(pose_wall_result* result);
  void remember(const FrameFindings& found);
  std::int64_t now() const { return clock_ != nullptr ? clock_(clock_user_) : 0; }
  std::uint64_t sum() const;
  bool is_whole() const { return seal_ == sum(); }
  void seal() { seal_ = sum(); }

  // The sum of all that follows, except the scratch and the door's word that changes with each call. A bit of settings
  // or memory flipped between two calls would become a wrong value.
  std::uint64_t seal_ = 0;
  Door door_;
  std::uint32_t config_crc32_ = 0;
  Settings settings_{};
  Axes axes_{};
  Extrinsic extrinsic_{};
  pose_wall_clock clock_ = nullptr;
  void* clock_user_ = nullptr;
  Memory memory_;
  pose_wall_points points_{};
  Surfaces labelled_by_;  // the surfaces for the labels of the points
  Scratch scratch_;
};

}  // namespace pose_wall
