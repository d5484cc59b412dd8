// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What an input holds, gathered frame by frame.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frames/frame_source.hpp"

namespace pose_wall::tools {

struct FieldFacts {
  std::string name;
  std::uint32_t offset = 0;
  std::uint32_t type = 0;
  std::string role;  // what it is understood as; empty: passed over
  std::string note;  // of times: unit and spread
};

struct StampFacts {
  std::size_t count = 0;  // frames that carry one
  std::int64_t first_ns = 0, last_ns = 0;
  double interval_s = 0.0;  // median of the steps forwards; 0 where there is none
  std::size_t gaps = 0;     // longer than 1.5 intervals
  double longest_s = 0.0;
  std::size_t backwards = 0;  // steps that do not go forwards
};

struct RangeFacts {
  double min_m = 0.0, median_m = 0.0, max_m = 0.0;
};

// How the points of one frame lie around the sensor.
struct SensorFacts {
  std::size_t rings = 0;  // 0: none found
  std::string rings_by;   // "field ring", "rows", "elevations"
  double elevation_min_deg = 0.0, elevation_max_deg = 0.0;
  double azimuth_span_deg = 0.0;
  std::string guess;
};

class InputFacts {
 public:
  void add(const SourcedFrame& sourced);

  std::size_t frames() const { return frames_; }
  const std::vector<std::string>& errors() const { return errors_; }  // the first few
  std::size_t unreadable() const { return unreadable_; }
  const std::vector<std::uint32_t>& points() const { return points_; }  // of each frame
  const std::vector<FieldFacts>& fields() const { return fields_; }     // of the first frame
  const std::string& layout() const { return layout_; }                 // "1 x 28217, 32 bytes a point"
  std::size_t other_layouts() const { return other_layouts_; }          // frames with other fields than the first
  StampFacts stamps() const;
  std::optional<RangeFacts> ranges() const;
  double zero_share() const;
  double not_finite_share() const;
  const SensorFacts& sensor() const { return sensor_; }  // by the first frame with points

 private:
  void add_ranges(const pose_wall_cloud& cloud);
  void describe(const Frame& frame);

  static constexpr double kBinsPerMetre = 100.0;
  static constexpr std::size_t kBins = 50'000;

  std::size_t frames_ = 0;
  std::size_t unreadable_ = 0;
  std::vector<std::string> errors_;
  std::vector<std::uint32_t> points_;
  std::vector<FieldFacts> fields_;
  std::vector<FrameField> layout_fields_;
  std::string layout_;
  std::size_t other_layouts_ = 0;
  std::vector<std::int64_t> stamps_;
  std::vector<std::uint64_t> range_counts_ = std::vector<std::uint64_t>(kBins, 0);
  std::uint64_t all_points_ = 0, zero_ = 0, not_finite_ = 0, returns_ = 0;
  double range_min_m_ = 0.0, range_max_m_ = 0.0;
  SensorFacts sensor_;
};

// Of one frame.
SensorFacts sensor_facts(const Frame& frame);

// For people, and for programs.
std::string facts_text(const SourceAbout& about, const InputFacts& facts);
std::string facts_json(const std::string& input, const SourceAbout& about, const InputFacts& facts);

}  // namespace pose_wall::tools
