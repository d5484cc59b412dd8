// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Settings of the stop: defaults and limits.

#pragma once

#include <cstdint>

#include "part/settings.hpp"
#include "pose_wall_planar_stop.h"

namespace pose_wall::planar {

using StopSettings = pose_wall_planar_stop_settings;

struct StopTable : SettingsTable<StopSettings> {
  using SettingsTable::SettingsTable;
  static SettingRows rows();
  void set_others();
  SettingFault broken_rule() const;
};

void set_rectangle(StopSettings* settings, double x_min_m, double x_max_m, double y_min_m, double y_max_m);

// So slowly it may pass a thing that stood still, however near.
inline double creeping_speed_m_s(const StopSettings& s) {
  return s.creep_m_s;
}

// From the stamp to the first effect of the brakes.
inline double reaction_s(const StopSettings& s) {
  return s.scan_s + s.stale_s + s.delay_s + s.latency_s;
}

}  // namespace pose_wall::planar
