// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/drive_tracks.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools::sim {
namespace {

// A track keeps some grip and never more than all.
constexpr double kSlipMax = 0.6;
constexpr double kResistanceMin = 1.0;
constexpr double kNoiseMax = 3.0;

double towards(double now_mps, double command_mps, const TrackSettings& settings, double time_s) {
  const double wanted_mps = std::clamp(command_mps, -settings.speed_max_mps, settings.speed_max_mps);
  const double lag = settings.lag_s > 0.0 ? 1.0 - std::exp(-time_s / settings.lag_s) : 1.0;
  const double most_mps = settings.acceleration_mps2 * time_s;
  return now_mps + std::clamp(lag * (wanted_mps - now_mps), -most_mps, most_mps);
}

double wrapped_angle(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * M_PI);
}

}  // namespace

TrackSettings TrackSettings::without_slip() {
  TrackSettings settings;
  settings.slip = settings.slip_sigma = settings.turn_resistance_sigma = settings.turn_ahead_m = 0.0;
  settings.odometry_slip = settings.scale_sigma = settings.count_m = 0.0;
  settings.turn_resistance = settings.odometry_turn_resistance = 1.0;
  return settings;
}

PlanePose moved(const PlanePose& from, double ahead_mps, double left_mps, double turn_radps, double time_s) {
  const double half_rad = 0.5 * turn_radps * time_s;
  // The chord of an arc: sin(x) / x, by its series where x is small.
  const double chord = std::abs(half_rad) < 1e-4 ? 1.0 - half_rad * half_rad / 6.0 : std::sin(half_rad) / half_rad;
  const double c = std::cos(from.yaw_rad + half_rad), s = std::sin(from.yaw_rad + half_rad);
  const double ahead_m = ahead_mps * time_s * chord, left_m = left_mps * time_s * chord;
  return {from.x_m + c * ahead_m - s * left_m, from.y_m + s * ahead_m + c * left_m,
          wrapped_angle(from.yaw_rad + 2.0 * half_rad)};
}

TrackDrive::TrackDrive(const TrackSettings& settings, const Network* network, const PlanePose& start,
                       std::uint64_t seed)
    : settings_(settings),
      network_(network),
      left_ground_(mix(seed ^ 0x1ef7u), settings.slip_length_m),
      right_ground_(mix(seed ^ 0x819u), settings.slip_length_m),
      turn_ground_(mix(seed ^ 0x7u), 2.0 * settings.slip_length_m),
      random_(seed, 0xd81e),
      truth_(start),
      odometry_(start) {
  scale_left_ = 1.0 + settings.scale_sigma * random_.gaussian();
  scale_right_ = 1.0 + settings.scale_sigma * random_.gaussian();
  bias_radps_ = settings.gyroscope_bias_dps * kRadPerDeg * random_.gaussian();
  stand();
}

// The state of the ground under a track or under the machine: a number of variance 1.
double TrackDrive::ground(const PlaneNoise& noise, double beside_m) const {
  if (network_ == nullptr) return 0.0;
  const Place left(-std::sin(truth_.yaw_rad), std::cos(truth_.yaw_rad));
  return std::clamp(noise.at(truth_.place() + beside_m * left), -kNoiseMax, kNoiseMax);
}

void TrackDrive::step(const TrackSpeeds& command, double time_s) {
  tracks_.left_mps = towards(tracks_.left_mps, command.left_mps, settings_, time_s);
  tracks_.right_mps = towards(tracks_.right_mps, command.right_mps, settings_, time_s);
  const double half_m = 0.5 * settings_.gauge_m;
  const auto grip = [this](double noise) {
    return 1.0 - std::clamp(settings_.slip + settings_.slip_sigma * noise, 0.0, kSlipMax);
  };
  const double left_mps = tracks_.left_mps * grip(ground(left_ground_, half_m));
  const double right_mps = tracks_.right_mps * grip(ground(right_ground_, -half_m));
  const double resistance =
      std::max(kResistanceMin, settings_.turn_resistance + settings_.turn_resistance_sigma * ground(turn_ground_, 0.0));
  const double turn_radps = (right_mps - left_mps) / (resistance * settings_.gauge_m);
  const double ahead_mps = 0.5 * (left_mps + right_mps) * std::cos(pitch_rad_);
  truth_ = moved(truth_, ahead_mps, -settings_.turn_ahead_m * turn_radps, turn_radps, time_s);
  left_m_ += tracks_.left_mps * time_s;
  right_m_ += tracks_.right_mps * time_s;
  time_s_ += time_s;
  driven_m_ += std::hypot(ahead_mps, settings_.turn_ahead_m * turn_radps) * time_s;
  turned_rad_ += std::abs(turn_radps) * time_s;
  count(time_s, turn_radps);
  stand();
}

void TrackDrive::count(double time_s, double true_turn_radps) {
  const auto counted = [this](double m) {
    return settings_.count_m > 0.0 ? settings_.count_m * std::floor(m / settings_.count_m) : m;
  };
  const double left_m = counted(left_m_ * scale_left_), right_m = counted(right_m_ * scale_right_);
  const double left_mps = (left_m - counted_left_m_) / time_s, right_mps = (right_m - counted_right_m_) / time_s;
  counted_left_m_ = left_m;
  counted_right_m_ = right_m;
  const double grip = 1.0 - settings_.odometry_slip;
  double turn_radps = grip * (right_mps - left_mps) / (settings_.odometry_turn_resistance * settings_.gauge_m);
  if (settings_.gyroscope != 0.0) {
    turn_radps = true_turn_radps + bias_radps_ + settings_.gyroscope_noise_dps * kRadPerDeg * random_.gaussian();
  }
  odometry_ = moved(odometry_, grip * 0.5 * (left_mps + right_mps), 0.0, turn_radps, time_s);
}

// On four points: both ends of both tracks.
void TrackDrive::stand() {
  if (network_ == nullptr) return;
  const Place ahead(std::cos(truth_.yaw_rad), std::sin(truth_.yaw_rad)), left(-ahead.y(), ahead.x());
  const auto z = [&](double along, double across) {
    return network_->floor_height_m(truth_.place() + 0.5 * settings_.track_m * along * ahead +
                                    0.5 * settings_.gauge_m * across * left);
  };
  const double front_left = z(1, 1), front_right = z(1, -1), rear_left = z(-1, 1), rear_right = z(-1, -1);
  // Nose down is a positive pitch, the left side up a positive roll.
  pitch_rad_ = std::atan2(0.5 * (rear_left + rear_right - front_left - front_right), settings_.track_m);
  roll_rad_ = std::atan2(0.5 * (front_left + rear_left - front_right - rear_right), settings_.gauge_m);
  height_m_ = 0.25 * (front_left + front_right + rear_left + rear_right);
}

}  // namespace pose_wall::tools::sim
