// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The planar scan in many drawn scenes.
// usage: pose_wall_planar_scan_trial things [SCENES [SEED]]    things of 0.2 m or more within 10 m: told or missed
//        pose_wall_planar_scan_trial walls [SCENES [SEED]]     error of a beam by range and roughness, beside the plain
//                                                             minimum of pointcloud_to_laserscan
//        pose_wall_planar_scan_trial tilt [SCENES [SEED]]      beams that end at floor or roof on a tilted machine
//        pose_wall_planar_scan_trial cost [FRAMES]             time of a frame of an OS1-64

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "planar/scan_campaign.hpp"
#include "planar/scan_walls.hpp"

namespace {

using namespace pose_wall::test;

int things(std::uint64_t scenes, std::uint64_t seed) {
  Campaign campaign;
  const RingSensor sensors[] = {kScanOs1, kScanVlp16, kScanMid360};
  for (const RingSensor& sensor : sensors) {
    Campaign one;
    CampaignRunner runner(sensor);
    for (std::uint64_t i = 0; i < scenes / 3 + 1; ++i) runner.run(seed + i, &one);
    seed += 1000003;  // other scenes for the next
    std::printf("%s: %llu scenes, clear in %.1f %% of the beams, to %.1f m in the mean\n", sensor.name,
                static_cast<unsigned long long>(one.scenes),
                100.0 * static_cast<double>(one.clear_beams) / static_cast<double>(one.beams),
                one.clear_far_m / static_cast<double>(one.clear_beams + (one.clear_beams == 0 ? 1 : 0)));
    std::printf("  not told %llu: of these with returns %llu; claimed clear, but there: %llu, of dark things %llu\n",
                static_cast<unsigned long long>(one.missed), static_cast<unsigned long long>(one.missed_with_returns),
                static_cast<unsigned long long>(one.false_clear),
                static_cast<unsigned long long>(one.dark_false_clear));
    std::printf("  promised to be told %llu: of these not told %llu\n", static_cast<unsigned long long>(one.promised),
                static_cast<unsigned long long>(one.promise_broken));
    campaign.cells.insert(one.cells.begin(), one.cells.end());
  }
  static const char* const sizes[] = {"0.2-0.3", "0.3-0.45", "0.45-"};
  static const char* const ranges[] = {"1.2-3", "3-5", "5-7.5", "7.5-10"};
  std::printf("%-8s %-9s %-9s %-7s %7s %9s %9s %9s %9s %9s %9s\n", "sensor", "thing", "size m", "range m", "things",
              "promised", "not told", "no ray", "all lost", "at edge", "clear");
  for (const auto& [key, cell] : campaign.cells) {
    const auto& [sensor, kind, size, range] = key;
    std::printf("%-8s %-9s %-9s %-7s %7llu %9llu %9llu %9llu %9llu %9llu %9llu\n", sensor.c_str(),
                name_of(static_cast<ThingKind>(kind)), sizes[size], ranges[range],
                static_cast<unsigned long long>(cell.things), static_cast<unsigned long long>(cell.promised),
                static_cast<unsigned long long>(cell.missed), static_cast<unsigned long long>(cell.without_rays),
                static_cast<unsigned long long>(cell.all_lost), static_cast<unsigned long long>(cell.on_floor),
                static_cast<unsigned long long>(cell.false_clear));
  }
  return 0;
}

int walls(std::uint64_t scenes, std::uint64_t seed) {
  std::printf("%-8s %7s %7s | %8s | %8s %8s | %8s %8s | %8s %8s\n", "sensor", "rough m", "range m", "beams", "ours",
              "sd", "mean", "sd", "minimum", "sd");
  for (const RingSensor& sensor : {kScanOs1, kScanVlp16, kScanMid360}) {
    for (const double rough_m : {0.0, 0.01, 0.03, 0.06}) {
      WallErrors errors;
      for (std::uint64_t i = 0; i < scenes; ++i) measure_walls(sensor, rough_m, seed + i, &errors);
      for (int bin = 0; bin < WallErrors::kBins; ++bin) {
        const WallErrors::Cell& c = errors.cells[bin];
        if (c.ours.count == 0) continue;
        std::printf("%-8s %7.2f %7s | %8llu | %8.4f %8.4f | %8.4f %8.4f | %8.4f %8.4f\n", sensor.name, rough_m,
                    WallErrors::name(bin), static_cast<unsigned long long>(c.ours.count), c.ours.mean(), c.ours.sd(),
                    c.from_mean.mean(), c.from_mean.sd(), c.minimum.mean(), c.minimum.sd());
      }
    }
  }
  std::printf(
      "errors in m. ours and minimum: from the k-th smallest and the smallest range of the same rays without "
      "noise. mean: ours from the mean of these\n");
  return 0;
}

int tilt(std::uint64_t scenes, std::uint64_t seed) {
  std::printf(
      "of the beams with a range those that end at floor or roof, %%: ours, and with heights along the sensor's "
      "axes\n");
  for (const RingSensor& sensor : {kScanOs1, kScanVlp16, kScanMid360}) {
    for (const double tilt_deg : {0.0, 1.0, 2.0, 5.0, 10.0}) {
      FalseThings counts;
      for (std::uint64_t i = 0; i < scenes; ++i) count_false_things(sensor, tilt_deg * M_PI / 180.0, seed + i, &counts);
      std::printf("%-8s tilted by %4.1f deg: %7.3f %7.3f\n", sensor.name, tilt_deg,
                  100.0 * static_cast<double>(counts.ours) / static_cast<double>(counts.beams),
                  100.0 * static_cast<double>(counts.by_axes) / static_cast<double>(counts.beams_by_axes));
    }
  }
  return 0;
}

int cost(int frames) {
  RoadScene road;
  road.roll_rad = 0.03, road.pitch_rad = -0.02, road.noise_m = 0.012;
  for (const RingSensor& sensor : {kScanOs1, kScanVlp16, kScanMid360}) {
    const SeenScene seen = see(road, sensor, rays_of(sensor, 1), 1);
    std::vector<std::array<float, 4>> padded;
    for (const auto& p : seen.points) padded.push_back({p[0], p[1], p[2], 0.0F});
    pose_wall_cloud cloud;
    pose_wall_cloud_xyz32(&cloud, padded.data(), static_cast<std::uint32_t>(padded.size()), 16, 0);
    pose_wall_config config = config_with();
    set(&config, "extrinsic_roll", sensor.mount_roll_rad);
    ScannerUnderTest scanner(config);
    SceneDraw draw(1);
    const pose_wall_planar_floor floor = floor_of(road, kCampaignTilt_rad, &draw);
    double best_ms = 1e9, sum_ms = 0.0;
    for (int i = 0; i < frames; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      scanner.process(cloud, &floor);
      const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
      sum_ms += ms;
      best_ms = std::min(best_ms, ms);
    }
    std::printf("%-8s %6zu points, %5u in the band: best %.3f ms, mean %.3f ms, block %.2f MiB\n", sensor.name,
                padded.size(), scanner.view().of_band, best_ms, sum_ms / frames,
                static_cast<double>(bytes_of(scan_settings())) / 1048576.0);
  }
  return 0;
}

}  // namespace

int main(int count, char** words) {
  const char* const what = count > 1 ? words[1] : "";
  const std::uint64_t number = count > 2 ? std::strtoull(words[2], nullptr, 10) : 0;
  const std::uint64_t seed = count > 3 ? std::strtoull(words[3], nullptr, 10) : 1;
  if (std::strcmp(what, "things") == 0) return things(number != 0 ? number : 3000, seed);
  if (std::strcmp(what, "walls") == 0) return walls(number != 0 ? number : 10, seed);
  if (std::strcmp(what, "tilt") == 0) return tilt(number != 0 ? number : 10, seed);
  if (std::strcmp(what, "cost") == 0) return cost(number != 0 ? static_cast<int>(number) : 200);
  std::fprintf(stderr, "usage: pose_wall_planar_scan_trial things|walls|tilt|cost [NUMBER [SEED]]\n");
  return 2;
}
