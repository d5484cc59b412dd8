// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/run_files.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "lab/sim/machine_body.hpp"
#include "lab/sim/parameters.hpp"

namespace pose_wall::tools::sim {
namespace {

std::string box_text(const std::array<double, 6>& box) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(3);
  for (std::size_t i = 0; i < box.size(); ++i) out << (i == 0 ? "[" : ", ") << box[i];
  return out.str() + "]";
}

std::string number_text(double number) {
  std::ostringstream out;
  out << std::setprecision(10) << number;
  return out.str();
}

// Up to here the engine's own motion_speed_max does, 2 m/s: sway moves the sensor as well.
constexpr double kUsualSpeed_mps = 1.8;
// Top speeds of faster machines, as their makers know them: a fifth above what the campaign drives at most (5 m/s), and
// above what the simulator does (10 m/s).
constexpr double kFastSpeed_mps = 5.0;
constexpr const char* kFastTopSpeed_mps = "6";
constexpr const char* kFastestTopSpeed_mps = "12";

double fastest_mps(const Machine& machine) {
  const double drive_in_mps = machine.drive_in_m > 0.0 ? machine.drive_in_mps : 0.0;
  return std::max({std::abs(machine.speed_mps), std::abs(machine.speed_after_mps), drive_in_mps});
}

}  // namespace

std::filesystem::path frame_file(const std::filesystem::path& folder, std::uint32_t frame_index) {
  std::ostringstream name;
  name << std::setw(6) << std::setfill('0') << frame_index << ".pcd";
  return folder / "frames" / name.str();
}

std::vector<EngineSetting> engine_setting_list(const Setup& setup) {
  const Machine& machine = setup.machine;
  const Mount& m = setup.mount;
  std::vector<EngineSetting> list = {
      {"forward_axis", parameter_text(*find_parameter("forward_axis"), machine.forward_axis)},
      {"s_front", number_text(machine.s_front_m)},
      {"s_back", number_text(machine.s_back_m)},
      {"extrinsic_x", number_text(m.mount_x_m)},
      {"extrinsic_y", number_text(m.mount_y_m)},
      {"extrinsic_z", number_text(m.mount_z_m)},
      {"extrinsic_roll", number_text(m.mount_roll_deg * kRadPerDeg)},
      {"extrinsic_pitch", number_text(m.mount_pitch_deg * kRadPerDeg)},
      {"extrinsic_yaw", number_text(m.mount_yaw_deg * kRadPerDeg)},
  };
  if (machine.body != 0.0) list.push_back({"body_box_1", box_text(body_box_base_m(machine))});
  if (machine.boom != 0.0 && machine.boom_sweep_deg == 0.0) {
    list.push_back({"body_box_2", box_text(boom_box_base_m(machine))});
  }
  if (fastest_mps(machine) > kUsualSpeed_mps) {
    const bool is_fastest = fastest_mps(machine) > kFastSpeed_mps;
    list.push_back({"motion_speed_max", is_fastest ? kFastestTopSpeed_mps : kFastTopSpeed_mps});
  }
  if (setup.sequence.scan_s == 0.0) list.push_back({"scan_max", "0"});  // all rays of a frame at one instant
  list.push_back({"floor_region_min", number_text(setup.sensor.floor_from_m)});
  list.push_back({"floor_region_max", number_text(setup.sensor.floor_to_m)});
  if (const SensorModel* const model = find_sensor(setup.sensor.name)) {
    list.insert(list.end(), model->engine.begin(), model->engine.end());
  }
  return list;
}

std::string engine_settings(const Setup& setup, const std::string& comment) {
  std::string text = "# " + comment + "\n";
  for (const EngineSetting& setting : engine_setting_list(setup)) text += setting.key + ": " + setting.value + "\n";
  return text;
}

}  // namespace pose_wall::tools::sim
