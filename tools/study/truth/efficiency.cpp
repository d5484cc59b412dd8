// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/truth/efficiency.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "io/frames/load_frame.hpp"
#include "io/language/language.hpp"
#include "io/numbers/quantities.hpp"
#include "io/terminal/interrupt.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kNoiseMismatch = 0.1;

std::size_t result_column(const CsvTable& results, const std::string& name) {
  const std::optional<std::size_t> column = results.find_column(name);
  if (!column) {
    throw CsvError(say("the results have no column '{}', which the Cramer-Rao bound needs: run writes it", name));
  }
  return *column;
}

Frame frame_of(const std::filesystem::path& folder, const std::string& source) {
  const std::filesystem::path file = folder / std::filesystem::path(source).filename();
  try {
    return load_frame(file);
  } catch (const FrameError& error) {
    throw FrameError(say("{}: {} (the points of result row '{}')", file.string(), error.what(), source));
  }
}

std::array<double, kTruthQuantities> truth_at(const CsvTable& truth, std::size_t row) {
  std::array<double, kTruthQuantities> values{};
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::optional<std::size_t> column = truth.find_column(pose_wall_quantity_name(q));
    values[q] = column ? truth.number(row, *column) : kNoTruth;
  }
  return values;
}

// The columns that tell where the engine looked.
class ViewColumns {
 public:
  explicit ViewColumns(const CsvTable& results)
      : results_(results),
        floor_distance_(result_column(results, "floor_distance_m")),
        floor_radius_(result_column(results, "floor_extent_max_m")) {
    for (std::size_t side = 0; side < spans_.size(); ++side) {
      const std::string wall = side == 0 ? "left_wall" : "right_wall";
      spans_[side] = {result_column(results, wall + "_extent_min_m"), result_column(results, wall + "_extent_max_m")};
    }
  }

  View at(std::size_t row) const {
    View view{results_.number(row, floor_distance_), results_.number(row, floor_radius_), {}};
    for (std::size_t side = 0; side < spans_.size(); ++side) {
      for (std::size_t end = 0; end < 2; ++end) view.wall_span_m[side][end] = results_.number(row, spans_[side][end]);
    }
    return view;
  }

 private:
  const CsvTable& results_;
  std::size_t floor_distance_, floor_radius_;
  std::array<std::array<std::size_t, 2>, 2> spans_{};
};

double mean_with(double mean, double next, std::size_t count) {
  return mean + (next - mean) / static_cast<double>(count);
}

}  // namespace

void EfficiencySums::add(double error, double bound) {
  if (!std::isfinite(error) || !std::isfinite(bound)) return;
  ++frames_;
  error_squares_ += error * error;
  bound_squares_ += bound * bound;
}

double EfficiencySums::rmse() const {
  return frames_ > 0 ? std::sqrt(error_squares_ / static_cast<double>(frames_)) : kNoTruth;
}

double EfficiencySums::bound() const {
  return frames_ > 0 ? std::sqrt(bound_squares_ / static_cast<double>(frames_)) : kNoTruth;
}

void Efficiency::add(const FrameBound& bound) {
  if (!std::isfinite(bound.noise_ratio)) return;
  ++frames;
  floor_points = mean_with(floor_points, static_cast<double>(bound.floor_points), frames);
  for (std::size_t side = 0; side < wall_points.size(); ++side) {
    wall_points[side] = mean_with(wall_points[side], static_cast<double>(bound.wall_points[side]), frames);
  }
  noise_ratio = mean_with(noise_ratio, bound.noise_ratio, frames);
}

bool Efficiency::is_believable() const {
  return frames > 0 && std::abs(noise_ratio - 1.0) <= kNoiseMismatch;
}

Efficiency efficiency_of(const CsvTable& results, const CsvTable& truth, const Comparison& comparison,
                         const std::filesystem::path& folder, const CramerRao& bounds) {
  const std::size_t source = result_column(results, "source");
  const ViewColumns views(results);
  std::array<std::size_t, kTruthQuantities> raw{};
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    raw[q] = result_column(results, fmt::format("{}_raw", pose_wall_quantity_name(q)));
  }
  Efficiency out;
  for (const auto& [result_row, truth_row] : comparison.rows) {
    stop_if_interrupted();
    const View view = views.at(result_row);
    if (!std::isfinite(view.floor_distance_m)) continue;
    const std::array<double, kTruthQuantities> values = truth_at(truth, truth_row);
    const Frame frame = frame_of(folder, results.cell(result_row, source));
    const FrameBound bound = bounds.bound(frame.cloud, values, view);
    out.add(bound);
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const double error = results.number(result_row, raw[q]) - values[q];
      out.quantity[q].add(is_angle(q) ? wrap_angle(error) : error, bound.sigma[q]);
    }
  }
  return out;
}

}  // namespace pose_wall::tools
