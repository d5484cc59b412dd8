// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/demo/demo_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "io/config_file/load_config.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantile.hpp"
#include "io/numbers/quantities.hpp"
#include "io/picture/frame_picture.hpp"
#include "io/terminal/text_table.hpp"
#include "study/truth/alert_limits.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uint32_t kPointStep = 4 * sizeof(float);

using Clock = std::chrono::steady_clock;

double millis_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::string amount(std::uint32_t quantity, double value) {
  if (!std::isfinite(value)) return "-";
  return is_angle(quantity) ? fmt::format("{:.3f}°", value * kDegPerRad) : fmt::format("{:.1f} mm", value * 1e3);
}

}  // namespace

DemoRun::DemoRun(const sim::Setup& setup, const api::Config& config, std::uint64_t seed)
    : simulator_(setup, seed), config_(config) {
  const std::int32_t status = engine_.open(config_);
  if (status != POSE_WALL_OK) throw ConfigError(say("the engine: {}", pose_wall_status_text(status)));
  const AlertLimits limits = alert_limits_of(config_);
  for (std::uint32_t quantity = 0; quantity < POSE_WALL_QUANTITIES; ++quantity) {
    errors_.emplace_back(is_angle(quantity), limit_of(quantity, limits));
  }
}

DemoFrame DemoRun::next() {
  const Clock::time_point render_start = Clock::now();
  const sim::Frame cloud_points = simulator_.render(next_frame_);
  render_ms_.push_back(millis_since(render_start));
  pose_wall_cloud cloud{};
  pose_wall_cloud_xyz32(&cloud, cloud_points.xyz_intensity.data(), static_cast<std::uint32_t>(cloud_points.count()),
                        kPointStep, cloud_points.stamp_ns);

  DemoFrame frame;
  frame.truth = simulator_.truth(next_frame_);
  frame.time_s = simulator_.pose(next_frame_).time_s;
  frame.outcome.frame = next_frame_++;
  frame.outcome.source = "demo";
  frame.outcome.stamp_ns = cloud_points.stamp_ns;
  pose_wall_result result = api::make_result();
  const Clock::time_point start = Clock::now();
  const std::int32_t status = engine_.process(cloud, result);
  frame.outcome.total_ms = millis_since(start);
  if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_status_text(status));
  frame.outcome.result = result;

  engine_ms_.push_back(frame.outcome.total_ms);
  for (std::size_t quantity = 0; quantity < errors_.size(); ++quantity) {
    const pose_wall_value& value = result.quantity[quantity];
    errors_[quantity].add({value.value, value.raw, value.sigma, value.protection_level, value.state},
                          frame.truth.value.at(quantity));
  }
  return frame;
}

std::string DemoRun::error_table() const {
  TextTable table({tr("error of raw"), tr("frames"), tr("valid"), tr("RMSE"), tr("95 %"), tr("max"),
                   tr("beyond protection level")});
  for (std::uint32_t quantity = 0; quantity < POSE_WALL_QUANTITIES; ++quantity) {
    const ErrorStatistics& errors = errors_[quantity];
    const ErrorFigures figures = errors.raw();
    table.add_row({tr(pose_wall_quantity_name(quantity)), std::to_string(errors.frames()),
                   std::to_string(errors.valid()), amount(quantity, figures.rmse),
                   amount(quantity, figures.absolute_95), amount(quantity, figures.absolute_max),
                   say("{} of {}", errors.raw_beyond_protection(), errors.measured())});
  }
  return table.text();
}

std::string DemoRun::picture(const DemoFrame& frame, const std::string& subtitle) const {
  pose_wall_points points{};
  engine_.last_points(points);
  return picture::frame_picture({config_.get(), &*frame.outcome.result, &points,
                                 tr("pose_wall: how the machine stands in its roadway"), subtitle,
                                 frame.truth.value.data()});
}

double DemoRun::median_engine_ms() const {
  return quantile(engine_ms_, 0.5);
}
double DemoRun::median_render_ms() const {
  return quantile(render_ms_, 0.5);
}

}  // namespace pose_wall::tools
