// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/court.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "support/engine_under_test.hpp"

namespace pose_wall::judge {
namespace {

constexpr std::int64_t kPeriod_ns = 100000000;  // 10 Hz

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// "key: value" lines, as far as the delivered files go. What the engine does not know belongs to other programs.
void read_settings(const std::string& file, pose_wall_config* config) {
  std::ifstream in(std::string(POSE_WALL_JUDGE_CONFIGS) + "/" + file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  std::string line;
  while (std::getline(in, line)) {
    line = line.substr(0, line.find('#'));
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::string key = trimmed(line.substr(0, colon)), value = trimmed(line.substr(colon + 1));
    const std::int32_t status = pose_wall_config_set(config, key.c_str(), value.c_str());
    if (status == POSE_WALL_E_KEY_UNKNOWN) continue;
    if (status != POSE_WALL_OK) throw std::runtime_error(key + ": " + pose_wall_status_text(status));
  }
}

// Everything that a seed decides, in the order in which it is drawn.
class Trial {
 public:
  explicit Trial(const Case& tried)
      : draw_(tried.seed ^ 0x5EED5EED5EED5EEDU),
        road_(draw_road(tried.seed, tried.quiet)),
        sensor_(tried.sensor >= 0 ? tried.sensor : draw_.whole(0, kSensors - 1)),
        machine_(draw_machine(road_, sensor().hung, &draw_)),
        scanner_(sensor(), tried.no_bias, &draw_),
        stance_(draw_stance(road_, tried.quiet, &draw_)),
        stands_(draw_.chance(0.5)) {}

  const Sensor& sensor() const { return kSensorTable.at(static_cast<std::size_t>(sensor_)); }
  int sensor_row() const { return sensor_; }
  const Road& road() const { return road_; }

  pose_wall_config config() const {
    pose_wall_config config = test::config_with();
    read_settings(sensor().config, &config);
    for (const Setting& setting : settings_of(machine_)) {
      test::set(&config, setting.first.c_str(), setting.second.c_str());
    }
    return config;
  }
  std::vector<Setting> settings() const { return settings_of(machine_); }

  std::vector<float> next_frame(Truth* truth) {
    if (frame_ > 0 && !stands_) creep(&stance_, &draw_);
    const Pose pose = stance_.pose(road_, machine_);
    *truth = truth_of(road_, machine_, pose);
    return scanner_.scan(road_, machine_, pose, frame_++, &draw_);
  }

 private:
  Draw draw_;
  Road road_;
  int sensor_;
  Machine machine_;
  Scanner scanner_;
  Stance stance_;
  bool stands_;
  int frame_ = 0;
};

Finding finding_of(const pose_wall_value& value, int quantity, int frame, const Truth& truth) {
  Finding finding;
  finding.frame = frame;
  finding.quantity = quantity;
  finding.state = value.state;
  finding.raw_state = value.raw_state;
  finding.reasons = value.reasons;
  finding.cause = value.cause;
  finding.error = truth.error(quantity, value.value);
  finding.raw_error = truth.error(quantity, value.raw);
  finding.level = value.protection_level;
  finding.raw_level = value.raw_protection_level;
  finding.sigma = value.sigma;
  return finding;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

// Angles in degrees, distances in millimetres.
double shown(int quantity, double value) {
  return quantity < POSE_WALL_D_LF ? value / kRadPerDeg : 1000.0 * value;
}

std::string reason_names(std::uint32_t reasons) {
  std::string names;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if ((reasons >> bit & 1U) != 0) names += std::string(names.empty() ? "" : "+") + pose_wall_reason_name(bit);
  }
  return names;
}

std::string feature_names(std::uint32_t features) {
  std::string names;
  for (std::uint32_t k = 0; k < kFeatures; ++k) {
    if ((features >> k & 1U) != 0) names += std::string(names.empty() ? "" : "+") + feature_name(k);
  }
  return names.empty() ? "bare" : names;
}

}  // namespace

Verdict hear(const Case& tried) {
  return hear(tried, [](const pose_wall_config& config) -> Process {
    const auto engine = std::make_shared<test::EngineUnderTest>(config);
    return [engine](const pose_wall_cloud& cloud) { return engine->process(cloud); };
  });
}

Verdict hear(const Case& tried, const Open& open) {
  Trial trial(tried);
  const pose_wall_config config = trial.config();
  const Process process = open(config);
  std::array<double, 2> limit{};
  pose_wall_config_get_number(&config, "alert_limit_angle_deg", limit.data());
  pose_wall_config_get_number(&config, "alert_limit_distance", &limit[1]);
  Verdict verdict;
  verdict.tried = tried;
  verdict.sensor = trial.sensor_row();
  verdict.features = trial.road().features;
  for (int frame = 0; frame < tried.frames; ++frame) {
    Truth truth;
    const std::vector<float> points = trial.next_frame(&truth);
    pose_wall_cloud cloud;
    pose_wall_cloud_xyz32(&cloud, points.data(), static_cast<std::uint32_t>(points.size() / 3), 12,
                          (frame + 1) * kPeriod_ns);
    const pose_wall_result result = process(cloud);
    for (int q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      verdict.findings.push_back(finding_of(result.quantity[q], q, frame, truth));
      verdict.findings.back().alert_limit = q < POSE_WALL_D_LF ? kRadPerDeg * limit[0] : limit[1];
    }
  }
  return verdict;
}

std::string Verdict::text(const Finding& finding) const {
  const int q = finding.quantity;
  std::string text = format(
      "road %llu (%s, %s), frame %d: %s %s, off by %.3f, level %.3f; raw off by %.3f, level %.3f, sigma %.3f (%s); ",
      static_cast<unsigned long long>(tried.seed), kSensorTable.at(static_cast<std::size_t>(sensor)).name,
      feature_names(features).c_str(), finding.frame, pose_wall_quantity_name(static_cast<std::uint32_t>(q)),
      pose_wall_state_name(finding.state), shown(q, finding.error), shown(q, finding.level),
      shown(q, finding.raw_error), shown(q, finding.raw_level), shown(q, finding.sigma),
      q < POSE_WALL_D_LF ? "deg" : "mm");
  if (finding.reasons != 0) text += reason_names(finding.reasons) + "; ";
  text += format("replay: pose_wall_judge --seed %llu --roads 1 --frames %d%s%s",
                 static_cast<unsigned long long>(tried.seed), tried.frames, tried.quiet ? " --quiet" : "",
                 tried.no_bias ? " --no-bias" : "");
  if (tried.sensor >= 0) text += std::string(" --sensor ") + kSensorTable[static_cast<std::size_t>(sensor)].name;
  return text;
}

void write_frames(const Case& tried, const std::string& folder) {
  Trial trial(tried);
  std::ofstream settings(folder + "/judge.yaml");
  std::ifstream delivered(std::string(POSE_WALL_JUDGE_CONFIGS) + "/" + trial.sensor().config);
  std::string line;
  while (std::getline(delivered, line)) {
    if (line.rfind("forward_axis", 0) != 0) settings << line << "\n";
  }
  for (const Setting& setting : trial.settings()) settings << setting.first << ": " << setting.second << "\n";
  for (int frame = 0; frame < tried.frames; ++frame) {
    Truth truth;
    const std::vector<float> points = trial.next_frame(&truth);
    std::ofstream out(folder + format("/frame_%03d.pcd", frame), std::ios::binary);
    out << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " << points.size() / 3
        << "\nHEIGHT 1\nPOINTS " << points.size() / 3 << "\nDATA binary\n";
    out.write(reinterpret_cast<const char*>(points.data()), static_cast<std::streamsize>(4 * points.size()));
  }
}

void Tally::add(const Finding& finding) {
  ++frames;
  valid += finding.state == POSE_WALL_VALID ? 1 : 0;
  degraded += finding.state == POSE_WALL_DEGRADED ? 1 : 0;
  held += finding.state == POSE_WALL_HELD ? 1 : 0;
  int* beyond[] = {nullptr, &beyond_held, &beyond_degraded, &beyond_valid};
  if (finding.beyond()) ++*beyond[finding.state];
  raw_beyond += finding.raw_beyond() ? 1 : 0;
  misleading += finding.misleading() ? 1 : 0;
  if (finding.raw_state != POSE_WALL_INVALID) {
    closest = std::max(closest, finding.raw_error_abs() / finding.raw_level);
    z2_sum += std::pow(finding.raw_error_abs() / finding.sigma, 2.0);
    errors.push_back(finding.raw_error_abs());
    levels.push_back(finding.raw_level);
    levels_in_sigma.push_back(finding.raw_level / finding.sigma);
  }
  if (finding.state == POSE_WALL_VALID) return;
  for (std::uint32_t bit = 0; bit < 32; ++bit) reasons[bit] += static_cast<int>(finding.reasons >> bit & 1U);
}

void add(Tallies* tallies, const Verdict& verdict) {
  tallies->resize(POSE_WALL_QUANTITIES);
  for (const Finding& finding : verdict.findings) (*tallies)[static_cast<std::size_t>(finding.quantity)].add(finding);
}

std::string table(const Tallies& tallies) {
  std::string text = format("%-6s %6s %7s %7s %6s %8s %8s %8s %8s %7s %6s %6s %6s %6s %6s %6s\n", "", "frames",
                            "valid%", "degr%", "held%", "err50", "err95", "level50", "lvl/sig", "closest", "z2",
                            "bey.v", "bey.d", "bey.h", "bey.r", "misl");
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    const Tally& tally = tallies[k];
    const int q = static_cast<int>(k);
    const double percent = 100.0 / std::max(1, tally.frames);
    text += format("%-6s %6d %7.1f %7.1f %6.1f %8.3f %8.3f %8.3f %8.1f %7.2f %6.2f %6d %6d %6d %6d %6d\n",
                   pose_wall_quantity_name(static_cast<std::uint32_t>(k)), tally.frames, percent * tally.valid,
                   percent * tally.degraded, percent * tally.held, shown(q, quantile(tally.errors, 0.5)),
                   shown(q, quantile(tally.errors, 0.95)), shown(q, quantile(tally.levels, 0.5)),
                   quantile(tally.levels_in_sigma, 0.5), tally.closest,
                   tally.z2_sum / std::max<double>(1.0, static_cast<double>(tally.errors.size())), tally.beyond_valid,
                   tally.beyond_degraded, tally.beyond_held, tally.raw_beyond, tally.misleading);
  }
  return text;
}

std::string reasons_table(const Tallies& tallies) {
  std::string text;
  for (std::size_t q = 0; q < tallies.size(); ++q) {
    std::vector<std::uint32_t> bits;
    for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
      if (tallies[q].reasons[bit] > 0) bits.push_back(bit);
    }
    std::stable_sort(bits.begin(), bits.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return tallies[q].reasons[a] > tallies[q].reasons[b]; });
    text += format("%-6s", pose_wall_quantity_name(static_cast<std::uint32_t>(q)));
    for (const std::uint32_t bit : bits) text += format(" %s %d", pose_wall_reason_name(bit), tallies[q].reasons[bit]);
    text += "\n";
  }
  return text;
}

}  // namespace pose_wall::judge
