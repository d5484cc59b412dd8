// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "sim/run_files.hpp"

#include <iomanip>
#include <sstream>

#include "sim/machine_body.hpp"
#include "sim/parameters.hpp"

namespace pose_wall::tools::sim {
namespace {

std::string box_text(const std::array<double, 6>& box) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(3);
  for (std::size_t i = 0; i < box.size(); ++i) out << (i == 0 ? "[" : ", ") << box[i];
  return out.str() + "]";
}

}  // namespace

std::filesystem::path frame_file(const std::filesystem::path& folder, std::uint32_t frame_index) {
  std::ostringstream name;
  name << std::setw(6) << std::setfill('0') << frame_index << ".pcd";
  return folder / "frames" / name.str();
}

std::string engine_settings(const Setup& setup, const std::string& comment) {
  const Machine& machine = setup.machine;
  const Mount& m = setup.mount;
  std::ostringstream out;
  out << std::setprecision(10) << "# " << comment << "\n"
      << "forward_axis: \"" << parameter_text(*find_parameter("forward_axis"), machine.forward_axis) << "\"\n"
      << "s_front: " << machine.s_front_m << "\ns_back: " << machine.s_back_m << "\n"
      << "extrinsic_x: " << m.mount_x_m << "\nextrinsic_y: " << m.mount_y_m << "\nextrinsic_z: " << m.mount_z_m << "\n"
      << "extrinsic_roll: " << m.mount_roll_deg * kRadPerDeg << "\n"
      << "extrinsic_pitch: " << m.mount_pitch_deg * kRadPerDeg << "\n"
      << "extrinsic_yaw: " << m.mount_yaw_deg * kRadPerDeg << "\n";
  if (machine.body != 0.0) out << "body_box_1: " << box_text(body_box_base_m(machine)) << "\n";
  if (machine.boom != 0.0 && machine.boom_sweep_deg == 0.0) {
    out << "body_box_2: " << box_text(boom_box_base_m(machine)) << "\n";
  }
  return out.str();
}

}  // namespace pose_wall::tools::sim
