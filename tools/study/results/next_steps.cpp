// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/results/next_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/config_file/config_place.hpp"
#include "io/language/language.hpp"
#include "io/numbers/quantities.hpp"
#include "io/terminal/program_word.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kWellShare = 0.9;    // valid in so many frames: no advice
constexpr double kMostlyShare = 0.9;  // of frames without a floor, or without walls
constexpr double kWrongAxesShare = 0.5;

double share(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

// What is said of levels only says again that they are large.
bool tells_little(std::uint32_t bit) {
  return 1U << bit == POSE_WALL_R_ALERT_LIMIT || 1U << bit == POSE_WALL_R_LEVEL_MISSING;
}

}  // namespace

NextSteps::NextSteps(const api::Config& config, std::string config_word, std::string shell_words)
    : range_max_m_(config.number("range_max")),
      config_word_(std::move(config_word)),
      shell_words_(std::move(shell_words)) {}

void NextSteps::look(const pose_wall_cloud& cloud, const pose_wall_result& result) {
  if (2 * std::uint64_t{result.dropped_far} > result.points_in) {
    ++far_;
    if (!question_) question_ = unit_question(cloud, range_max_m_);
  }
  if (sensor_seen_ || result.points_in == 0) return;
  sensor_seen_ = true;
  Frame seen;
  seen.cloud = cloud;
  if (cloud.ring.type != POSE_WALL_FIELD_NONE) seen.fields.push_back({"ring", cloud.ring});
  SensorLook sensor;
  sensor.add(returns_of(seen.cloud), told_rings(seen));
  fitting_ = sensor.facts();
}

void NextSteps::add(const FrameOutcome& outcome) {
  if (!outcome.result) return;
  const pose_wall_result& result = *outcome.result;
  ++measured_;
  // A floor may be found and refused: what counts is whether it measured anything.
  const bool has_floor = result.quantity[POSE_WALL_ROLL].raw_state != POSE_WALL_INVALID;
  if (!has_floor) ++no_floor_;
  if (has_floor && result.left.found == 0 && result.right.found == 0) ++no_walls_;
  const std::uint32_t all = all_reasons(result);
  if ((all & (POSE_WALL_R_CROSS_ROAD | POSE_WALL_R_YAW_OUT_OF_RANGE)) != 0) ++wrong_axes_;
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const pose_wall_value& value = result.quantity[q];
    if (value.state == POSE_WALL_VALID) {
      ++quantities_[q].valid;
      continue;
    }
    if (value.cause < POSE_WALL_PARTS) ++quantities_[q].causes[value.cause];
    const bool has_level = value.state != POSE_WALL_INVALID && std::isfinite(value.protection_level);
    const double level = has_level ? value.protection_level : std::numeric_limits<double>::max();
    for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
      if ((value.reasons >> bit & 1U) == 0) continue;
      Reason& reason = quantities_[q].reasons[bit];
      ++reason.frames;
      if (level <= reason.worst_level) continue;
      reason.worst_level = level;
      reason.worst_frame = outcome.frame;
    }
  }
}

bool NextSteps::is_well() const {
  return std::all_of(quantities_.begin(), quantities_.end(),
                     [this](const Quantity& q) { return share(q.valid, measured_) >= kWellShare; });
}

std::string NextSteps::unit_line() const {
  if (!question_ || share(far_, measured_) < kMostlyShare) return "";
  return unit_question_text(*question_, range_max_m_);
}

std::string NextSteps::config_line() const {
  if (fitting_.config.empty()) return "";
  const std::vector<ConfigPlace> given = find_configs(config_word_);
  for (const ConfigPlace& place : given) {
    const std::string name = shipped_config_name(place);
    const bool is_own = name.empty();
    if (is_own || name == fitting_.config) return "";
  }
  if (fitting_.has_defaults()) {
    return given.empty() ? ""
                         : say("The sensor looks like a {}, for which the defaults are made: try without --config.",
                               fitting_.title);
  }
  return say("The sensor looks like a {}: try --config {}.", fitting_.title, fitting_.config);
}

std::string NextSteps::doctor_line() const {
  const std::string command = program_word() + " doctor " + shell_words_;
  if (share(no_floor_, measured_) >= kMostlyShare) {
    return say("The floor was measured in {} of {} frames. Mounting and axes are found by: {}", measured_ - no_floor_,
               measured_, command);
  }
  if (share(no_walls_, measured_) >= kMostlyShare || share(wrong_axes_, measured_) >= kWrongAxesShare) {
    return say("No walls run along forward_axis in most frames. Mounting and axes are found by: {}", command);
  }
  return "";
}

// That a level is above its limit says nothing; what it is made of does: "alert_limit (mostly rival)".
std::string NextSteps::reason_text(const Quantity& quantity, std::uint32_t bit) {
  const auto most = std::max_element(quantity.causes.begin(), quantity.causes.end());
  if (1U << bit != POSE_WALL_R_ALERT_LIMIT || *most == 0) return pose_wall_reason_name(bit);
  const std::string part = part_words(static_cast<std::uint32_t>(most - quantity.causes.begin()));
  return say("{} (mostly {})", pose_wall_reason_name(bit), tr(part.c_str()));
}

std::string NextSteps::explain_line() const {
  const auto worst = std::min_element(quantities_.begin(), quantities_.end(),
                                      [](const Quantity& a, const Quantity& b) { return a.valid < b.valid; });
  const auto by_weight = [](const Quantity& q, std::uint32_t bit) {
    return std::make_pair(!tells_little(bit) && q.reasons[bit].frames > 0, q.reasons[bit].frames);
  };
  std::uint32_t bit = 0;
  for (std::uint32_t other = 1; other < POSE_WALL_REASON_COUNT; ++other) {
    if (by_weight(*worst, other) > by_weight(*worst, bit)) bit = other;
  }
  const Reason& reason = worst->reasons[bit];
  if (reason.frames == 0) return "";
  const auto quantity = static_cast<std::uint32_t>(worst - quantities_.begin());
  return say("{} was valid in {:.1f} % of the frames. A frequent reason: {}. The worst frame with it: {}",
             pose_wall_quantity_name(quantity), 100.0 * share(worst->valid, measured_), reason_text(*worst, bit),
             fmt::format("{} explain --frame {} {}", program_word(), reason.worst_frame, shell_words_));
}

std::string NextSteps::text() const {
  if (measured_ == 0 || is_well()) return "";
  std::string lines;
  const auto add_line = [&lines](const std::string& line) {
    if (!line.empty()) lines += line + '\n';
  };
  add_line(unit_line());
  if (!lines.empty()) return lines;  // in another unit everything else looks wrong, too
  add_line(config_line());
  if (lines.empty()) add_line(doctor_line());  // the gates of another sensor explain a floor that is not measured
  add_line(explain_line());
  return lines;
}

}  // namespace pose_wall::tools
