// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/beams/beam_table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

bool is_lower(const Laser& a, const Laser& b) {
  return a.elevation_deg < b.elevation_deg;
}

}  // namespace

double BeamTable::lowest_deg() const {
  return std::min_element(lasers.begin(), lasers.end(), is_lower)->elevation_deg;
}

double BeamTable::highest_deg() const {
  return std::max_element(lasers.begin(), lasers.end(), is_lower)->elevation_deg;
}

double BeamTable::reach_m() const {
  double up_m = 0.0;
  for (const Laser& laser : lasers) up_m = std::max(up_m, std::abs(laser.up_m));
  return std::hypot(lens.out_m, up_m);
}

LaserRay laser_ray(const BeamTable& table, const Laser& laser, std::uint32_t column, std::uint32_t columns) {
  const double share = table.turns_meanwhile ? laser.after_ns / table.cycle_ns : 0.0;
  const double head_deg = 360.0 * (column + share) / columns;
  const double beside_deg = table.lens.azimuth_deg + (table.lens.turns_with_laser ? laser.azimuth_deg : 0.0);
  const double lens_rad = (head_deg + beside_deg) * kRadPerDeg;
  const double azimuth_rad = (head_deg + laser.azimuth_deg) * kRadPerDeg;
  const double elevation_rad = laser.elevation_deg * kRadPerDeg;
  const double out_m = table.lens.out_m;
  return {{out_m * std::cos(lens_rad), -out_m * std::sin(lens_rad), laser.up_m},
          {std::cos(elevation_rad) * std::cos(azimuth_rad), -std::cos(elevation_rad) * std::sin(azimuth_rad),
           std::sin(elevation_rad)}};
}

void number_rings(std::vector<Laser>* lasers) {
  for (Laser& laser : *lasers) {
    laser.ring = static_cast<std::uint16_t>(std::count_if(lasers->begin(), lasers->end(), [&](const Laser& other) {
      return other.elevation_deg < laser.elevation_deg ||
             (other.elevation_deg == laser.elevation_deg && &other < &laser);
    }));
  }
}

const std::vector<const BeamTable*>& beam_tables() {
  static const std::vector<const BeamTable*> tables = [] {
    std::vector<const BeamTable*> all = {
        &velodyne_vlp16(),      &velodyne_vlp16_hires(), &velodyne_hdl32e(),    &velodyne_vlp32c(),
        &hesai_xt32(),          &hesai_pandar40p(),      &hesai_qt64(),         &hesai_xt16(),
        &hesai_xt32m(),         &hesai_pandar64(),       &ouster_os0_128(),     &ouster_os0_128_rev7(),
        &ouster_os1_64_gen1(),  &ouster_os1_64(),        &ouster_os1_64_rev7(), &ouster_os2_128(),
        &ouster_os2_128_rev7(), &robosense_rs16(),       &robosense_rs32(),     &robosense_helios32(),
        &robosense_helios16p(), &robosense_bpearl(),     &robosense_bpearl4(),  &robosense_airy()};
    const std::vector<const BeamTable*> of_lslidar = lslidar_tables();
    all.insert(all.end(), of_lslidar.begin(), of_lslidar.end());
    return all;
  }();
  return tables;
}

const BeamTable& beam_table(std::string_view word) {
  for (const BeamTable* const table : beam_tables()) {
    if (table->word == word) return *table;
  }
  throw std::invalid_argument(std::string(word) + ": no table of beams has this word");
}

}  // namespace pose_wall::tools
