// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/trial.hpp"
#include "judge/surveyed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "support/engine_under_test.hpp"

namespace pose_wall::judge {
namespace {

// A driver knows the top speeds of the machine a little better than they matter.
constexpr double kAllowance = 1.2;
// Defaults of hold_rate_angle, hold_rate_distance and motion_speed_max: no machine is given less.
constexpr double kTurn_rad_s = 0.05, kAcross_m_s = 0.2, kSpeed_m_s = 2.0;
// A sampling point swings about the machine's middle as it turns: the furthest is 3 m away.
constexpr double kLever_m = 3.0;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::string decimals(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.4f", value);
  return text.data();
}

void write_points(const Cloud& cloud, const std::string& file) {
  std::ofstream out(file, std::ios::binary);
  out << "VERSION 0.7\nFIELDS x y z" << (cloud.timed ? " t ring" : "") << "\nSIZE 4 4 4" << (cloud.timed ? " 4 4" : "")
      << "\nTYPE F F F" << (cloud.timed ? " U U" : "") << "\nCOUNT 1 1 1" << (cloud.timed ? " 1 1" : "") << "\nWIDTH "
      << cloud.points.size() << "\nHEIGHT 1\nPOINTS " << cloud.points.size() << "\nDATA binary\n";
  const std::streamsize bytes = cloud.timed ? sizeof(Point) : 3 * sizeof(float);
  for (const Point& point : cloud.points) out.write(reinterpret_cast<const char*>(&point), bytes);
}

}  // namespace

std::vector<Setting> settings_in(const std::string& file) {
  std::ifstream in(std::string(POSE_WALL_JUDGE_CONFIGS) + "/" + file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  std::vector<Setting> settings;
  std::string line;
  while (std::getline(in, line)) {
    line = line.substr(0, line.find('#'));
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    settings.emplace_back(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
  }
  return settings;
}

FloorRegion floor_region_in(const std::string& file) {
  FloorRegion floor;
  for (const auto& [key, value] : settings_in(file)) {
    if (key == "floor_region_min") floor.from_m = std::stod(value);
    if (key == "floor_region_max") floor.to_m = std::stod(value);
  }
  return floor;
}

void read_settings(const std::string& file, pose_wall_config* config) {
  for (const auto& [key, value] : settings_in(file)) {
    const std::int32_t status = pose_wall_config_set(config, key.c_str(), value.c_str());
    if (status == POSE_WALL_E_KEY_UNKNOWN) continue;
    if (status != POSE_WALL_OK) throw std::runtime_error(key + ": " + pose_wall_status_text(status));
  }
}

// The drive and the sensor with its own beams have random numbers of their own, so that a seed keeps its road.
Trial::Trial(const Case& tried)
    : tried_(tried),
      draw_(tried.seed ^ 0x5EED5EED5EED5EEDU),
      drive_draw_(tried.seed ^ 0xD01E5D01E5D01E5DU),
      road_(draw_road(tried.seed, tried.furnishing)),
      sensor_(tried.sensor >= 0 ? tried.sensor
              : tried.times     ? draw_real_sensor(&drive_draw_)
                                : draw_.whole(0, kSensors - 1)),
      machine_(draw_machine(road_, sensor().hung, &draw_)),
      scanner_(sensor(), tried.no_bias, &draw_),
      stance_(draw_stance(road_, tried.furnishing == Furnishing::kQuiet, &draw_)),
      stands_(draw_.chance(0.5)) {
  floor_ = floor_region_in(sensor().config);
  if (!tried.times) return;
  Draw going(tried.seed ^ 0x601D601D601D601DU);
  drive_ = draw_drive(road_, machine_, stance_, tried.going, tried.frames, &going);
}

std::vector<Setting> Trial::settings() const {
  std::vector<Setting> settings = settings_of(machine_);
  if (!tried_.times) return settings;
  const Pace pace = drive_.pace();
  const double turn_rad_s = kAllowance * pace.turn_rad_s;
  const double across_m_s = kAllowance * pace.across_m_s + kLever_m * turn_rad_s;
  settings.emplace_back("hold_rate_angle", decimals(std::max(kTurn_rad_s, turn_rad_s)));
  settings.emplace_back("hold_rate_distance", decimals(std::max(kAcross_m_s, across_m_s)));
  return settings;
}

Setup Trial::setup() const {
  Setup setup;
  setup.config = test::config_with();
  read_settings(sensor().config, &setup.config);
  for (const Setting& setting : settings()) test::set(&setup.config, setting.first.c_str(), setting.second.c_str());
  pose_wall_motion_settings_init(&setup.motion);
  setup.motion.speed_max_m_s = std::max(kSpeed_m_s, kAllowance * drive_.pace().ahead_m_s);
  return setup;
}

Truths Trial::truths_at(const Pose& pose) const {
  return {truth_of(road_, machine_, pose), surveyed_truth(road_, machine_, pose, floor_)};
}

double Truths::error(int quantity, double value, double alert_limit) const {
  const double by_road = road.error(quantity, value), by_survey = surveyed.error(quantity, value);
  if (!std::isfinite(by_survey)) return by_road;
  if (!std::isfinite(by_road)) return by_survey;
  const bool is_between = (by_road < 0.0) != (by_survey < 0.0);
  if (is_between && std::abs(by_road - by_survey) <= 2.0 * alert_limit) return 0.0;
  return std::abs(by_road) < std::abs(by_survey) ? by_road : by_survey;
}

Cloud Trial::creeping_frame(Truths* truths) {
  if (frame_ > 0 && !stands_) creep(&stance_, &draw_);
  const Pose pose = stance_.pose(road_, machine_);
  *truths = truths_at(pose);
  return scanner_.scan(road_, machine_, pose, frame_++, &draw_);
}

Cloud Trial::next_frame(Truths* truths) {
  if (!tried_.times) return creeping_frame(truths);
  const auto at = static_cast<std::size_t>(frame_);
  const Passage passage(road_, machine_, drive_.stances.at(at), drive_.stances.at(at + 1));
  *truths = truths_at(passage.at(0.0));
  return scanner_.sweep(road_, machine_, passage, frame_++, &draw_);
}

void write_frames(const Case& tried, const std::string& folder) {
  Trial trial(tried);
  std::ofstream settings(folder + "/judge.yaml");
  std::ifstream delivered(std::string(POSE_WALL_JUDGE_CONFIGS) + "/" + trial.sensor().config);
  std::vector<Setting> own = trial.settings();
  own.emplace_back("motion_speed_max", decimals(trial.setup().motion.speed_max_m_s));
  std::string line;
  while (std::getline(delivered, line)) {
    const std::string key = trimmed(line.substr(0, line.find(':')));
    const bool twice =
        std::any_of(own.begin(), own.end(), [&](const Setting& setting) { return setting.first == key; });
    if (!twice) settings << line << "\n";
  }
  for (const Setting& setting : own) settings << setting.first << ": " << setting.second << "\n";
  for (int frame = 0; frame < tried.frames; ++frame) {
    Truths truths;
    std::array<char, 40> name{};
    std::snprintf(name.data(), name.size(), "/frame_%03d.pcd", frame);
    write_points(trial.next_frame(&truths), folder + name.data());
  }
}

}  // namespace pose_wall::judge
