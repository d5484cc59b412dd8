// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What to do after a run whose values were not good: other settings, a look at one frame, the doctor.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "io/frames/length_unit.hpp"
#include "pose_wall.hpp"
#include "study/info/sensor_look.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools {

class NextSteps {
 public:
  // `config_word`: what --config was given; `shell_words`: options and inputs, for the commands that are proposed.
  NextSteps(const api::Config& config, std::string config_word, std::string shell_words);

  // A measured frame, as FrameRunner shows it.
  void look(const pose_wall_cloud& cloud, const pose_wall_result& result);

  void add(const FrameOutcome& outcome);

  // At most four lines, each a sentence and mostly a command; empty when nearly every value was valid.
  std::string text() const;

 private:
  // The frames in which a quantity was not valid for one reason.
  struct Reason {
    std::size_t frames = 0;
    std::uint64_t worst_frame = 0;
    double worst_level = -1.0;
  };
  struct Quantity {
    std::size_t valid = 0;
    std::array<Reason, POSE_WALL_REASON_COUNT> reasons{};
    std::array<std::size_t, POSE_WALL_PARTS> causes{};  // how often each part of its level was the largest
  };

  static std::string reason_text(const Quantity& quantity, std::uint32_t bit);
  bool is_well() const;
  std::string unit_line() const;
  std::string config_line() const;
  std::string doctor_line() const;
  std::string explain_line() const;

  double range_max_m_;
  std::string config_word_, shell_words_;
  std::size_t measured_ = 0, no_floor_ = 0, no_walls_ = 0, wrong_axes_ = 0, far_ = 0;
  std::array<Quantity, POSE_WALL_QUANTITIES> quantities_{};
  std::optional<UnitQuestion> question_;
  SensorFacts fitting_;  // of the first frame with points
  bool sensor_seen_ = false;
};

}  // namespace pose_wall::tools
