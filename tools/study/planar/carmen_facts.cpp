// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/carmen_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "io/json/json_words.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/terminal/text_table.hpp"
#include "study/info/stamp_steps.hpp"
#include "study/info/wide_text.hpp"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools {
namespace {

// In the order of CarmenSkip.
constexpr const char* kSkipWords[] = {translatable("empty lines"),        translatable("comments"),
                                      translatable("parameters (PARAM)"), translatable("other messages"),
                                      translatable("unreadable lines"),   translatable("a pose or time not finite")};
static_assert(std::size(kSkipWords) == static_cast<std::size_t>(CarmenSkip::kCount));

struct LogFacts {
  std::size_t beams_least = 0, beams_most = 0;
  double view_rad = 0.0;  // from the first beam to the last
  StampSteps steps;
  double travel_m = 0.0, turned_rad = 0.0;  // by the odometry
  double nearest_m = INFINITY, farthest_m = 0.0;
  double none_share = 0.0;  // of the beams: nothing came back
};

LogFacts facts_of(const CarmenLog& log) {
  LogFacts out;
  out.beams_least = log.scans.front().range_m.size();
  std::vector<std::int64_t> stamps_ns;
  std::size_t beams = 0, none = 0;
  const CarmenScan* last = nullptr;
  for (const CarmenScan& scan : log.scans) {
    stamps_ns.push_back(scan.stamp_ns);
    const std::size_t count = scan.range_m.size();
    out.beams_least = std::min(out.beams_least, count);
    out.beams_most = std::max(out.beams_most, count);
    out.view_rad = std::max(out.view_rad, std::abs(scan.angle_step_rad) * static_cast<double>(count - 1));
    if (last != nullptr) {
      const pose_wall_planar_pose step = seen_from(last->odometry, scan.odometry);
      out.travel_m += std::hypot(step.x_m, step.y_m);
      out.turned_rad += std::abs(step.yaw_rad);
    }
    last = &scan;
    beams += count;
    for (const float range : scan.range_m) {
      const auto range_m = static_cast<double>(range);
      if (!(range_m > 0.0 && range_m < scan.range_max_m)) {
        ++none;
        continue;
      }
      out.nearest_m = std::min(out.nearest_m, range_m);
      out.farthest_m = std::max(out.farthest_m, range_m);
    }
  }
  out.steps = look_at_steps(stamps_ns);
  out.none_share = beams == 0 ? 0.0 : static_cast<double>(none) / static_cast<double>(beams);
  return out;
}

std::string beams_text(const LogFacts& facts, const CarmenScan& first) {
  const std::string count = facts.beams_least == facts.beams_most
                                ? std::to_string(facts.beams_most)
                                : say("{} to {}", facts.beams_least, facts.beams_most);
  return say("{} a scan, from {:.1f}° in steps of {:.2f}°: {:.0f}° of view", count, first.angle_min_rad * kDegPerRad,
             first.angle_step_rad * kDegPerRad, facts.view_rad * kDegPerRad);
}

std::string skip_text(const CarmenLog& log, CarmenSkip reason) {
  const CarmenSkipped& skipped = log.skip(reason);
  std::string text = say("{}, the first in line {}", skipped.lines, skipped.first_line);
  if (!skipped.first_fault.empty()) text += ": " + skipped.first_fault;
  if (reason != CarmenSkip::kOtherMessage) return text;
  std::string kinds;
  for (const auto& [name, count] : log.other_messages)
    kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", name, count);
  return text + ": " + kinds;
}

using Found = std::vector<std::pair<std::string, std::string>>;

void add_skipped(const CarmenLog& log, Found* rows) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(CarmenSkip::kCount); ++k) {
    const auto reason = static_cast<CarmenSkip>(k);
    if (log.skip(reason).lines > 0) rows->emplace_back(tr(kSkipWords[k]), skip_text(log, reason));
  }
}

}  // namespace

std::string carmen_facts_text(const CarmenLog& log) {
  const LogFacts facts = facts_of(log);
  const CarmenScan& first = log.scans.front();
  const pose_wall_planar_pose sensor = carmen_sensor_pose(log);
  Found rows = {
      {tr("kind"), tr("a log of CARMEN: scans of a planar laser scanner")},
      {tr("lines"), std::to_string(log.lines)},
      {tr("scans"), std::to_string(log.scans.size())},
      {tr("beams"), beams_text(facts, first)},
      {tr("ranges"), say("{:.2f} to {:.2f} m; from {:.2f} m on nothing came back: {:.1f} % of the beams",
                         facts.nearest_m, facts.farthest_m, first.range_max_m, 100.0 * facts.none_share)},
      {tr("stamps"), say("{} to {}", first.stamp, log.scans.back().stamp)},
      {tr("rate"), steps_text(facts.steps)},
      {tr("odometry"), say("{:.1f} m of travel, {:.0f}° of turns", facts.travel_m, facts.turned_rad * kDegPerRad)},
      {tr("scanner"),
       say("at x {:.3f} m, y {:.3f} m, {:.1f}° in base", sensor.x_m, sensor.y_m, sensor.yaw_rad * kDegPerRad)}};
  add_skipped(log, &rows);
  std::size_t width = 0;
  for (const auto& [name, found] : rows) width = std::max(width, shown_width(name));
  std::string text;
  for (const auto& [name, found] : rows) text += hanging(name, found, width + 2, kLineWidth);
  return text;
}

std::string carmen_facts_json(const std::string& input, const CarmenLog& log) {
  const LogFacts facts = facts_of(log);
  const CarmenScan& first = log.scans.front();
  const pose_wall_planar_pose sensor = carmen_sensor_pose(log);
  Json page = {{"input", input}, {"kind", "CARMEN log"}, {"lines", log.lines}, {"scans", log.scans.size()}};
  page["beams"] = {{"min", facts.beams_least},
                   {"max", facts.beams_most},
                   {"angle_min_rad", first.angle_min_rad},
                   {"angle_step_rad", first.angle_step_rad},
                   {"view_rad", facts.view_rad}};
  page["ranges_m"] = {{"min", facts.nearest_m}, {"max", facts.farthest_m}, {"none_from", first.range_max_m}};
  page["none_share"] = facts.none_share;
  const StampSteps& steps = facts.steps;
  page["stamps"] = {{"first", first.stamp},     {"last", log.scans.back().stamp}, {"duration_s", steps.duration_s},
                    {"rate_hz", steps.rate_hz}, {"jitter_s", steps.jitter_s},     {"longest_s", steps.longest_s},
                    {"gaps", steps.gaps},       {"still", steps.still},           {"backwards", steps.back}};
  page["odometry"] = {{"travel_m", facts.travel_m}, {"turned_rad", facts.turned_rad}};
  page["scanner"] = {{"x_m", sensor.x_m}, {"y_m", sensor.y_m}, {"yaw_rad", sensor.yaw_rad}};
  page["skipped"] = Json::object();
  for (std::size_t k = 0; k < static_cast<std::size_t>(CarmenSkip::kCount); ++k) {
    const auto reason = static_cast<CarmenSkip>(k);
    const CarmenSkipped& skipped = log.skip(reason);
    page["skipped"][carmen_skip_name(reason)] = {{"lines", skipped.lines}, {"first_line", skipped.first_line}};
  }
  page["other_messages"] = Json::object();
  for (const auto& [name, count] : log.other_messages) page["other_messages"][name] = count;
  return json_text(page, 2);
}

int worthy_restart_m(const CarmenLog& log) {
  constexpr double kRestarts = 5.0;
  // On the log aces (325 m) 9 of 17 restarts every 20 m end unique, and 6 of 6 every 60 m.
  constexpr double kLeast_m = 5.0, kMost_m = 60.0;
  return static_cast<int>(std::clamp(facts_of(log).travel_m / kRestarts, kLeast_m, kMost_m));
}

}  // namespace pose_wall::tools
