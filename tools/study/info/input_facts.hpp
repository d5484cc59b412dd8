// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What an input holds, gathered frame by frame.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/frames/frame_source.hpp"
#include "study/info/scan_times.hpp"
#include "study/info/sensor_look.hpp"
#include "study/info/stamp_steps.hpp"

namespace pose_wall::tools {

// Of a field of times: its unit by how far the times of one frame lie apart.
struct TimeFacts {
  std::string unit;  // "s", "ms", "us", "ns"; empty: none fits
  double spread = 0.0;
  double spread_s = 0.0;  // where the unit is known
  bool is_absolute = false;
};

struct FieldFacts {
  std::string name;
  std::uint32_t offset = 0;
  std::uint32_t type = 0;
  std::string role;  // what it is understood as; empty: passed over
  std::optional<TimeFacts> times;
};

struct LayoutFacts {
  std::uint32_t rows = 0, columns = 0, point_step = 0;
  bool is_big_endian = false;
};

struct StampFacts {
  std::size_t count = 0;  // frames that carry one
  std::int64_t first_ns = 0, last_ns = 0;
  StampSteps steps;
};

class InputFacts {
 public:
  void add(const SourcedFrame& sourced);

  std::size_t frames() const { return frames_; }
  const std::vector<std::string>& errors() const { return errors_; }  // the first few
  std::size_t unreadable() const { return unreadable_; }
  const std::vector<std::uint32_t>& points() const { return points_; }  // of each frame
  const std::vector<FieldFacts>& fields() const { return fields_; }     // of the first frame
  const std::optional<LayoutFacts>& layout() const { return layout_; }  // of the first frame
  std::size_t other_layouts() const { return other_layouts_; }          // frames with other fields than the first
  StampFacts stamps() const;
  double zero_share() const;
  double not_finite_share() const;
  SensorFacts sensor() const { return sensor_.facts(); }  // by all frames
  ScanTimeFacts scan_times() const { return times_.facts(sensor(), stamps_); }
  bool has_returns() const { return !sensor_.is_empty(); }

 private:
  void count_points(const pose_wall_cloud& cloud);
  void describe(const Frame& frame);

  std::size_t frames_ = 0;
  std::size_t unreadable_ = 0;
  std::vector<std::string> errors_;
  std::vector<std::uint32_t> points_;
  std::vector<FieldFacts> fields_;
  std::vector<FrameField> layout_fields_;
  std::optional<LayoutFacts> layout_;
  std::size_t other_layouts_ = 0;
  std::vector<std::int64_t> stamps_;
  std::uint64_t all_points_ = 0, zero_ = 0, not_finite_ = 0;
  SensorLook sensor_;
  ScanTimeLook times_;
};

// For people, and for programs.
std::string facts_text(const SourceAbout& about, const InputFacts& facts);
std::string facts_json(const std::string& input, const SourceAbout& about, const InputFacts& facts);

}  // namespace pose_wall::tools
