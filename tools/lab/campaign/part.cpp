// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "io/frames/text_cursor.hpp"
#include "io/terminal/counted.hpp"
#include "lab/sim/sensors.hpp"

namespace pose_wall::tools::campaign {
namespace {

double points_of(const std::string& sensor) {
  const sim::SensorModel* const model = sim::find_sensor(sensor);
  if (model == nullptr) return 1.0;
  return std::max(model->sensor.rings * model->sensor.columns, model->sensor.pattern_points);
}

}  // namespace

std::string part_text(const Part& part) {
  return fmt::format("{}/{}", part.number, part.of);
}

Part parse_part(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto number = parse_number<std::uint32_t>(text.substr(0, slash));
  const auto of = slash == std::string::npos ? std::nullopt : parse_number<std::uint32_t>(text.substr(slash + 1));
  if (!number || !of) {
    throw std::invalid_argument(fmt::format("--part: '{}' is refused; allowed is NUMBER/PARTS, such as 3/16", text));
  }
  if (*of < 1 || *of > kPartsMax) {
    throw std::invalid_argument(fmt::format("--part: '{}' is refused; allowed are 1 to {} parts", text, kPartsMax));
  }
  if (*number < 1 || *number > *of) {
    throw std::invalid_argument(fmt::format("--part: '{0}' is refused; allowed are 1/{1} to {1}/{1}", text, *of));
  }
  return {*number, *of};
}

std::vector<Run> runs_of_part(const std::vector<Run>& runs, const Part& part) {
  if (part.of > runs.size()) {
    throw std::invalid_argument(fmt::format("--part {}: the campaign has {}; at most as many parts are allowed",
                                            part_text(part), counted(runs.size(), "run")));
  }
  std::vector<std::size_t> by_cost(runs.size());
  std::iota(by_cost.begin(), by_cost.end(), std::size_t{0});
  const auto cost = [&runs](std::size_t i) { return frames_of(runs[i]) * points_of(runs[i].sensor); };
  std::stable_sort(by_cost.begin(), by_cost.end(), [&](std::size_t a, std::size_t b) { return cost(a) > cost(b); });
  std::vector<std::size_t> mine;
  std::vector<double> dealt(part.of, 0.0);
  for (const std::size_t i : by_cost) {
    const auto taker = std::min_element(dealt.begin(), dealt.end());
    *taker += cost(i);
    if (taker - dealt.begin() + 1 == static_cast<std::ptrdiff_t>(part.number)) mine.push_back(i);
  }
  std::sort(mine.begin(), mine.end());
  std::vector<Run> chosen;
  chosen.reserve(mine.size());
  for (const std::size_t i : mine) chosen.push_back(runs[i]);
  return chosen;
}

}  // namespace pose_wall::tools::campaign
