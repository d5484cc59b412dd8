// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where each laser of a real spinning sensor points, where its light leaves the sensor, and when it fires. The decoders
// of packets and the simulator read the same tables, so that each checks the other.
//
// Frame: x at the head's azimuth 0, y to its left, z up along the axis. Azimuths count clockwise seen from above, as
// all these heads turn.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools {

struct Laser {
  double elevation_deg = 0.0;
  double azimuth_deg = 0.0;  // beside the head's
  double up_m = 0.0;         // where its light leaves the sensor, above the origin
  double after_ns = 0.0;     // since the first laser of its firing
  std::uint16_t ring = 0;    // from the lowest
};

// Where all light leaves the head, beside what each laser has of its own.
struct Lens {
  double out_m = 0.0;               // from the axis
  double azimuth_deg = 0.0;         // of the lens beside the head's
  bool range_is_from_axis = false;  // the sensor's ranges hold out_m, too
  bool turns_with_laser = false;    // stands beside a laser's own azimuth, not beside the head's
};

// What the sensor makes of a range. By the makers' sheets; noise is half of what a sheet calls accuracy, where it names
// no other figure.
struct Ranges {
  double unit_m = 0.0;  // they come in whole multiples of it
  double noise_m = 0.0;
  double min_m = 0.0, max_m = 0.0;
  double beam_deg = 0.0;  // width of a beam; 0: not known here, and the simulator's beams are rays
};

enum class SensorMaker { kVelodyne, kHesai, kOuster, kRoboSense, kLslidar };

struct BeamTable {
  SensorMaker maker;
  std::string word;           // as the simulator names it: "velodyne-vlp16"
  std::string title;          // "Velodyne VLP-16"
  std::string source;         // of angles, offsets and times
  std::vector<Laser> lasers;  // in the order in which packets hold them
  std::uint32_t columns;      // firings of all lasers in a turn of 0.1 s; whole packets
  double cycle_ns;            // from one firing to the next
  bool turns_meanwhile;       // the maker counts how far the head turns between two lasers of a firing
  Lens lens;
  Ranges ranges;

  double lowest_deg() const;
  double highest_deg() const;
  // How far from the origin light leaves at most.
  double reach_m() const;
  // What a range holds besides the way of the light outside.
  double ahead_m() const { return lens.range_is_from_axis ? lens.out_m : 0.0; }
};

// A laser's light at one moment.
struct LaserRay {
  std::array<double, 3> origin_m;
  std::array<double, 3> direction;  // unit
};

// `column`: which firing of a turn of `columns`.
LaserRay laser_ray(const BeamTable& table, const Laser& laser, std::uint32_t column, std::uint32_t columns);

// Counts rings from the lowest. Lasers at one elevation keep their order, so that each has a ring of its own.
void number_rings(std::vector<Laser>* lasers);

// All, by makers.
const std::vector<const BeamTable*>& beam_tables();
// The one of this word. Throws std::invalid_argument where there is none.
const BeamTable& beam_table(std::string_view word);

const BeamTable& velodyne_vlp16();
const BeamTable& velodyne_vlp16_hires();
const BeamTable& velodyne_hdl32e();
const BeamTable& velodyne_vlp32c();
const BeamTable& hesai_xt32();
const BeamTable& hesai_pandar40p();
const BeamTable& hesai_qt64();
const BeamTable& hesai_xt16();
const BeamTable& hesai_xt32m();
const BeamTable& hesai_qt128();
const BeamTable& hesai_pandar64();
// The revisions of one kind differ in where their light leaves.
const BeamTable& ouster_os0_128();
const BeamTable& ouster_os0_128_rev7();
const BeamTable& ouster_os1_64_gen1();
const BeamTable& ouster_os1_64();
const BeamTable& ouster_os1_64_rev7();
const BeamTable& ouster_os2_128();
const BeamTable& ouster_os2_128_rev7();
const BeamTable& robosense_rs16();
const BeamTable& robosense_rs32();
const BeamTable& robosense_helios32();
const BeamTable& robosense_helios16p();
const BeamTable& robosense_bpearl();
const BeamTable& robosense_bpearl4();
const BeamTable& robosense_airy();
std::vector<const BeamTable*> lslidar_tables();
// In which column a laser of a C32 of firmware 3 stands, in the order of firing: of two, or of four where it is dense
// in the middle. The sensor tells their angles.
std::size_t lslidar_c32_column(bool is_dense, std::size_t laser);

}  // namespace pose_wall::tools
