// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What a map costs along a rough road, beside a plain array that every beam is drawn into:
//
//     pose_wall_planar_map_cost [LENGTH_m [STEP_m]]       1000 m in steps of 0.2 m if not given

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "pose_wall_planar_map.h"

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kPiece_m = 0.4, kRange_m = 30.0, kWidth_m = 5.0, kCell_m = 0.05;

// Two walls along x, each a line with corners every 0.4 m that stand out by up to 0.3 m.
class Road {
 public:
  explicit Road(double length_m) : corners_(2), random_(5) {
    const auto pieces = static_cast<std::size_t>((length_m + 2.0 * kRange_m) / kPiece_m) + 2;
    std::uniform_real_distribution<double> rough(0.0, 0.3);
    for (auto& side : corners_) {
      for (std::size_t k = 0; k < pieces; ++k) side.push_back(0.5 * kWidth_m - rough(random_));
    }
  }

  // From piece to piece along the beam's own side.
  double range(double x, double y, double angle) const {
    const double dx = std::cos(angle), dy = std::sin(angle);
    const double sign = dy > 0.0 ? 1.0 : -1.0;
    const std::vector<double>& side = corners_[dy > 0.0 ? 0 : 1];
    auto piece = static_cast<std::ptrdiff_t>((x + kRange_m) / kPiece_m);
    for (int k = 0; k<static_cast<int>(kRange_m / kPiece_m) + 2; ++k, piece += dx> 0.0 ? 1 : -1) {
      if (piece < 0 || piece + 1 >= static_cast<std::ptrdiff_t>(side.size())) break;
      const double x0 = static_cast<double>(piece) * kPiece_m - kRange_m;
      const double y0 = sign * side[static_cast<std::size_t>(piece)];
      const double ex = kPiece_m, ey = sign * side[static_cast<std::size_t>(piece) + 1] - y0;
      const double det = ex * dy - ey * dx;
      if (std::abs(det) < 1e-12) continue;
      const double range = (ex * (y0 - y) - ey * (x0 - x)) / det, along = (dx * (y0 - y) - dy * (x0 - x)) / det;
      if (range > 0.0 && along >= 0.0 && along <= 1.0) return range;
    }
    return std::numeric_limits<double>::infinity();
  }

  void scan(double x, double y, double yaw, std::vector<float>* ranges) {
    std::normal_distribution<double> noise(0.0, 0.02);
    const double step = 2.0 * kPi / static_cast<double>(ranges->size());
    for (std::size_t k = 0; k < ranges->size(); ++k) {
      const double far = range(x, y, yaw - kPi + static_cast<double>(k) * step);
      (*ranges)[k] =
          far <= kRange_m ? static_cast<float>(far + noise(random_)) : std::numeric_limits<float>::infinity();
    }
  }

 private:
  std::vector<std::vector<double>> corners_;
  std::mt19937_64 random_;
};

// Every beam into every cell of its way, as one writes it first.
class PlainGrid {
 public:
  explicit PlainGrid(double length_m)
      : width_(static_cast<int>((length_m + 2.0 * kRange_m) / kCell_m)),
        height_(static_cast<int>(2.0 * kWidth_m / kCell_m)),
        cells_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0.0F) {}

  void insert(double x, double y, double yaw, const std::vector<float>& ranges) {
    const double step = 2.0 * kPi / static_cast<double>(ranges.size());
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      const double range = std::min(static_cast<double>(ranges[k]), kRange_m);
      const double angle = yaw - kPi + static_cast<double>(k) * step;
      draw(cell(x + kRange_m), cell(y + kWidth_m), cell(x + kRange_m + range * std::cos(angle)),
           cell(y + kWidth_m + range * std::sin(angle)), ranges[k] <= kRange_m);
    }
  }
  std::size_t bytes() const { return cells_.size() * sizeof(float); }

 private:
  static int cell(double at_m) { return static_cast<int>(std::floor(at_m / kCell_m)); }
  void add(int x, int y, float log_odds) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    float& at = cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    at = std::min(3.5F, std::max(-2.0F, at + log_odds));
  }
  void draw(int x0, int y0, int x1, int y1, bool thing) {  // Bresenham 1965
    const int dx = std::abs(x1 - x0), dy = -std::abs(y1 - y0), step_x = x0 < x1 ? 1 : -1, step_y = y0 < y1 ? 1 : -1;
    int error = dx + dy;
    while (x0 != x1 || y0 != y1) {
      add(x0, y0, -0.4F);
      const int twice = 2 * error;
      if (twice >= dy) error += dy, x0 += step_x;
      if (twice <= dx) error += dx, y0 += step_y;
    }
    if (thing) add(x1, y1, 0.85F);
  }

  int width_, height_;
  std::vector<float> cells_;
};

struct Times {
  std::vector<double> us;

  template <typename Work>
  void take(const Work& work) {
    const double before = cpu_us();
    work();
    us.push_back(cpu_us() - before);
  }
  // Of this thread: others on the same processor do not count.
  static double cpu_us() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
  }
  double mean() const {
    double sum = 0.0;
    for (const double one : us) sum += one;
    return sum / static_cast<double>(us.size());
  }
  double worst() const { return *std::max_element(us.begin(), us.end()); }
  double quantile(double q) {
    std::sort(us.begin(), us.end());
    return us[static_cast<std::size_t>(q * static_cast<double>(us.size() - 1))];
  }
};

struct Free {
  void operator()(void* block) const { std::free(block); }
};

void print(const char* name, std::uint32_t beams, Times* times, double megabytes) {
  const double first = times->us.front();
  std::printf("%5u beams  %-22s first %7.0f us, mean %6.0f, 99 %% %6.0f, worst %7.0f; %6.1f MB\n", beams, name, first,
              times->mean(), times->quantile(0.99), times->worst(), megabytes);
}

bool drive(std::uint32_t beams, double length_m, double step_m, bool with_distances) {
  pose_wall_planar_map_settings settings;
  std::uint64_t bytes = 0;
  if (pose_wall_planar_map_settings_init(&settings) != POSE_WALL_OK) return false;
  settings.tiles = 2048;
  if (!with_distances) settings.distance_cap_m = 0.0;
  if (pose_wall_planar_map_memory_needed(&settings, &bytes) != POSE_WALL_OK) return false;
  const std::unique_ptr<void, Free> block(std::aligned_alloc(POSE_WALL_BLOCK_ALIGNMENT, bytes));
  pose_wall_planar_map* map = nullptr;
  if (pose_wall_planar_map_open(&settings, block.get(), bytes, &map) != POSE_WALL_OK) return false;
  Road road(length_m);
  PlainGrid plain(length_m);
  std::vector<float> ranges(beams);
  pose_wall_planar_scan scan{};
  scan.struct_size = sizeof(scan);
  scan.beams = beams;
  scan.angle_min_rad = -kPi;
  scan.angle_step_rad = 2.0 * kPi / beams;
  scan.range_max_m = kRange_m;
  scan.sigma_m = 0.02;
  scan.range_m = ranges.data();
  pose_wall_planar_map_report report{};
  report.struct_size = sizeof(report);
  Times tiled, simple;
  std::uint32_t stale_most = 0;
  std::uint64_t changes = 0;
  for (double x = 0.0; x <= length_m; x += step_m) {
    const pose_wall_planar_pose pose{x, 0.5 * std::sin(0.1 * x), 0.05 * std::cos(0.1 * x)};
    road.scan(pose.x_m, pose.y_m, pose.yaw_rad, &ranges);
    bool good = false;
    tiled.take([&] { good = pose_wall_planar_map_insert(map, &scan, &pose, &report) == POSE_WALL_OK; });
    if (!good || report.beams_not_stored != 0) return false;
    simple.take([&] { plain.insert(pose.x_m, pose.y_m, pose.yaw_rad, ranges); });
    stale_most = std::max(stale_most, report.tiles_stale);
    changes += report.things_new + report.things_gone;
  }
  const double per_tile = with_distances ? 4096.0 * 3 + 512 + 80 : 4096.0 + 512 + 80;
  print(with_distances ? "tiles with distances" : "tiles without", beams, &tiled, report.tiles * per_tile / 1e6);
  print("plain array", beams, &simple, static_cast<double>(plain.bytes()) / 1e6);
  std::printf("             %u tiles, %.1f changes of things a scan, at most %u tiles stale\n", report.tiles,
              static_cast<double>(changes) / static_cast<double>(tiled.us.size()), stale_most);
  return true;
}

std::int32_t forget(void* /*context*/, const pose_wall_planar_tile* /*tile*/) {
  return 0;
}

// The most that one scan can ask for under the defaults: 6,284 beams whose ends jump about, so that every cell changes
// from scan to scan, in a map that has to give a tile for each new one.
bool storm(std::uint32_t tiles, double jump_m) {
  pose_wall_planar_map_settings settings;
  std::uint64_t bytes = 0;
  if (pose_wall_planar_map_settings_init(&settings) != POSE_WALL_OK) return false;
  settings.tiles = tiles;
  if (pose_wall_planar_map_memory_needed(&settings, &bytes) != POSE_WALL_OK) return false;
  const std::unique_ptr<void, Free> block(std::aligned_alloc(POSE_WALL_BLOCK_ALIGNMENT, bytes));
  pose_wall_planar_map* map = nullptr;
  if (pose_wall_planar_map_open(&settings, block.get(), bytes, &map) != POSE_WALL_OK) return false;
  if (pose_wall_planar_map_on_save(map, forget, nullptr) != POSE_WALL_OK) return false;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> any(0.1F, 30.0F);
  std::vector<float> ranges(POSE_WALL_PLANAR_BEAMS_MAX);
  pose_wall_planar_scan scan{};
  scan.struct_size = sizeof(scan);
  scan.beams = POSE_WALL_PLANAR_BEAMS_MAX;
  scan.angle_step_rad = 2.0 * kPi / POSE_WALL_PLANAR_BEAMS_MAX;
  scan.range_max_m = kRange_m;
  scan.sigma_m = 0.02;
  scan.range_m = ranges.data();
  pose_wall_planar_map_report report{};
  report.struct_size = sizeof(report);
  Times times;
  std::uint32_t saved = 0, stale = 0;
  for (int k = 0; k < 40; ++k) {
    for (float& range : ranges) range = any(random);
    const pose_wall_planar_pose pose{jump_m * k, 0.0, 0.1 * k};
    bool good = false;
    times.take([&] { good = pose_wall_planar_map_insert(map, &scan, &pose, &report) == POSE_WALL_OK; });
    if (!good) return false;
    saved = std::max(saved, report.tiles_saved);
    stale = std::max(stale, report.tiles_stale);
  }
  std::printf(
      "%u tiles, ends at random, %.0f m on each scan: mean %.0f us, worst %.0f us; up to %u tiles saved in a scan, "
      "%u stale\n",
      tiles, jump_m, times.mean(), times.worst(), saved, stale);
  return true;
}

}  // namespace

int main(int count, char** words) {
  const double length_m = count > 1 ? std::atof(words[1]) : 1000.0, step_m = count > 2 ? std::atof(words[2]) : 0.2;
  for (const std::uint32_t beams : {360U, 720U, 6283U}) {
    for (const bool with_distances : {true, false}) {
      if (!drive(beams, length_m, step_m, with_distances)) return 1;
    }
  }
  return storm(1024, 0.0) && storm(1024, 100.0) && storm(4096, 0.0) ? 0 : 1;
}
