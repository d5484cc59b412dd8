// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/length_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/frames/field_value.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

struct Unit {
  const char* name;
  double metres;
};
// The international foot.
constexpr Unit kUnits[] = {{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"ft", 0.3048}};

constexpr double kBeyondShareMin = 0.95;
constexpr double kMedianMin_m = 0.5;  // of a road: nearer, the sensor would be in a box
constexpr std::size_t kSampledMax = 10000;

template <typename Number>
void scale_number(std::byte* at, double factor, bool is_turned) {
  std::byte raw[sizeof(Number)];
  std::memcpy(raw, at, sizeof raw);
  if (is_turned) std::reverse(std::begin(raw), std::end(raw));
  Number number{};
  std::memcpy(&number, raw, sizeof number);
  number = static_cast<Number>(static_cast<double>(number) * factor);
  std::memcpy(raw, &number, sizeof raw);
  if (is_turned) std::reverse(std::begin(raw), std::end(raw));
  std::memcpy(at, raw, sizeof raw);
}

}  // namespace

std::vector<std::string> length_unit_names() {
  std::vector<std::string> names;
  for (const Unit& unit : kUnits) names.emplace_back(unit.name);
  return names;
}

double metres_of(const std::string& unit) {
  const auto found = std::find_if(std::begin(kUnits), std::end(kUnits), [&](const Unit& u) { return unit == u.name; });
  return found != std::end(kUnits) ? found->metres : 1.0;
}

void scale_points(Frame* frame, double factor) {
  const pose_wall_cloud& cloud = frame->cloud;
  const bool is_turned = (cloud.big_endian != 0) != host_is_big_endian();
  const std::size_t row_step = cloud.row_step != 0 ? cloud.row_step : std::size_t{cloud.width} * cloud.point_step;
  // The frame owns its bytes; the description only reads them.
  const std::size_t start = static_cast<std::size_t>(static_cast<const std::byte*>(cloud.data) - frame->bytes.data());
  for (std::size_t row = 0; row < cloud.height; ++row) {
    for (std::size_t column = 0; column < cloud.width; ++column) {
      std::byte* point = frame->bytes.data() + start + row * row_step + column * cloud.point_step;
      for (const pose_wall_field& field : {cloud.x, cloud.y, cloud.z}) {
        field.type == POSE_WALL_FIELD_FLOAT64 ? scale_number<double>(point + field.offset, factor, is_turned)
                                              : scale_number<float>(point + field.offset, factor, is_turned);
      }
    }
  }
}

std::vector<std::string> likely_units(double median_range, double beyond_share, double range_max_m) {
  std::vector<std::string> likely;
  if (beyond_share < kBeyondShareMin) return likely;
  for (const char* name : {"mm", "cm"}) {
    const double median_m = median_range * metres_of(name);
    if (median_m >= kMedianMin_m && median_m <= range_max_m) likely.emplace_back(name);
  }
  return likely;
}

UnitQuestion unit_question(const pose_wall_cloud& cloud, double range_max_m) {
  std::vector<double> ranges;
  const std::uint64_t points = std::uint64_t{cloud.width} * cloud.height;
  const std::uint64_t step = std::max<std::uint64_t>(1, points / kSampledMax);
  for (std::uint64_t i = 0; i < points; i += step) {
    const auto row = static_cast<std::uint32_t>(i / cloud.width), column = static_cast<std::uint32_t>(i % cloud.width);
    const double range = std::hypot(field_value(cloud, row, column, cloud.x), field_value(cloud, row, column, cloud.y),
                                    field_value(cloud, row, column, cloud.z));
    if (std::isfinite(range) && range > 0.0) ranges.push_back(range);
  }
  if (ranges.empty()) return {};
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  const auto beyond = std::count_if(ranges.begin(), ranges.end(), [&](double range) { return range > range_max_m; });
  const double share = static_cast<double>(beyond) / static_cast<double>(ranges.size());
  return {*middle, likely_units(*middle, share, range_max_m)};
}

std::string unit_question_text(const UnitQuestion& question, double range_max_m) {
  if (question.units.empty()) return "";
  const std::string& unit = question.units.front();
  return say(
      "Nearly all points lie beyond range_max ({:g} m), half of them beyond {:.0f} m: are they in {}? --unit {} reads "
      "them so.",
      range_max_m, question.median_range, unit, unit);
}

}  // namespace pose_wall::tools
