// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/hesai.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

// Between packets that follow each other; a QT128C2X turns 0.8 degrees at 1,200 turns a minute.
constexpr double kSingleStepMost_deg = 2.0;
constexpr double kSingleStepsAlike_deg = 0.05;  // azimuths are rounded to a hundredth

double azimuth_of(const HesaiTraits& traits, ByteView payload, std::size_t block) {
  const std::size_t start = traits.head_bytes + block * traits.block_bytes();
  return 0.01 * little_endian_at(payload, start + traits.block_head_bytes - 2, 2);
}

}  // namespace

HesaiAssembler::HesaiAssembler(std::optional<HesaiModel> stated, std::string angles) : angles_(std::move(angles)) {
  if (stated) set_model(*stated);
}

void HesaiAssembler::set_model(HesaiModel model) {
  const HesaiTraits& traits = hesai_traits(model);
  std::vector<Laser> lasers = traits.beams.lasers;
  if (!angles_.empty()) {
    const std::vector<HesaiLaser> own = parse_hesai_angles(angles_, traits.lasers());
    for (std::size_t i = 0; i < own.size(); ++i) {
      lasers[i].elevation_deg = own[i].elevation_deg;
      lasers[i].azimuth_deg = own[i].azimuth_deg;
    }
    number_rings(&lasers);
  }
  for (const Laser& laser : lasers) {
    const double elevation_rad = laser.elevation_deg * kRadPerDeg;
    beams_.push_back({laser, std::cos(elevation_rad), std::sin(elevation_rad)});
  }
  traits_ = &traits;
  last_step_deg_ = 360.0 / traits.beams.columns;
  kind_ = "packets of a " + traits.title();
  firing_.points.resize(traits.lasers());
}

bool HesaiAssembler::add(const Datagram& datagram) {
  const std::optional<HesaiModel> model = hesai_model_of(datagram.payload);
  if (!model || (traits_ != nullptr && traits_->model != *model)) return false;
  if (traits_ == nullptr) set_model(*model);
  const std::size_t step = hesai_returns(*traits_, datagram.payload);
  std::vector<double> azimuths_deg;
  for (std::size_t block = 0; block < traits_->blocks; block += step) {
    azimuths_deg.push_back(azimuth_of(*traits_, datagram.payload, block));
  }
  if (azimuths_deg.size() == 1) learn_step(azimuths_deg.front());
  const PacketSteps steps(azimuths_deg, last_step_deg_);
  const double cycle_ns = traits_->beams.cycle_ns;
  const ClockIs clock_is = traits_->last_is_known ? ClockIs::kOfEnd : ClockIs::kOfBegin;
  const std::int64_t packet_ns =
      packet_moment_ns(datagram.captured_ns, 1000 * hesai_clock_us(*traits_, datagram.payload), kClockSecond_ns, steps,
                       cycle_ns, clock_is);
  for (std::size_t k = 0; k < azimuths_deg.size(); ++k) {
    fill_firing(datagram.payload, k * step, step, packet_ns + std::llround(steps.moved_ns(k, cycle_ns, clock_is)));
    add_firing(firing_, steps.after_deg(k));
  }
  last_step_deg_ = steps.after_deg(azimuths_deg.size());
  return true;
}

// A packet of one firing tells no step. Two in a row do that agree: one alone may be late, or behind a lost one.
void HesaiAssembler::learn_step(double azimuth_deg) {
  const double since_deg = turned_deg(last_azimuth_deg_.value_or(azimuth_deg), azimuth_deg);
  const bool is_small = std::min(since_deg, 360.0 - since_deg) < kSingleStepMost_deg && since_deg > 0.0;
  if (is_small && std::abs(since_deg - last_since_deg_) < kSingleStepsAlike_deg) last_step_deg_ = since_deg;
  last_since_deg_ = since_deg;
  last_azimuth_deg_ = azimuth_deg;
}

void HesaiAssembler::fill_firing(ByteView payload, std::size_t block, std::size_t returns, std::int64_t packet_ns) {
  firing_.azimuth_deg = azimuth_of(*traits_, payload, block);
  const double start_ns = traits_->firing_start_ns(block / returns, traits_->blocks / returns);
  firing_.time_ns = packet_ns + std::llround(start_ns + traits_->first_laser_ns);
  const std::size_t start = traits_->head_bytes + block * traits_->block_bytes() + traits_->block_head_bytes;
  for (std::size_t i = 0; i < traits_->lasers(); ++i) {
    const auto& [laser, cos_elevation, sin_elevation] = beams_[i];
    ScanPoint& point = firing_.points[laser.ring];
    point = ScanPoint{};
    point.ring = laser.ring;
    point.t_ns = static_cast<std::uint32_t>(laser.after_ns);
    // Whatever their order, the farthest return is the last one: dust before a wall would be taken for the wall.
    std::size_t at = start + i * traits_->return_bytes, other = at;
    for (std::size_t k = 1; k < returns; ++k) {
      other += traits_->block_bytes();
      if (little_endian_at(payload, other, 2) > little_endian_at(payload, at, 2)) at = other;
    }
    const double range_m = traits_->beams.ranges.unit_m * little_endian_at(payload, at, 2);
    if (range_m == 0.0) continue;
    const double azimuth_rad = (firing_.azimuth_deg + laser.azimuth_deg) * kRadPerDeg;
    const double flat_m = range_m * cos_elevation;
    point.x_m = static_cast<float>(flat_m * std::cos(azimuth_rad));
    point.y_m = static_cast<float>(-flat_m * std::sin(azimuth_rad));
    point.z_m = static_cast<float>(range_m * sin_elevation);
    point.intensity = std::to_integer<std::uint8_t>(payload.data[at + 2]);
  }
}

}  // namespace pose_wall::tools
