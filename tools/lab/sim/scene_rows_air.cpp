// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/scene_rows.hpp"

namespace pose_wall::tools::sim {

std::vector<SceneChoice> air_scenes() {  // NOLINT(readability-function-size): a table
  return {
      // air, water, mud
      {"dust",
       SceneKind::kAdversarial,
       "dust, drops, dropouts",
       "degraded, then held as it thickens",
       {{"dust", "0.25", 0.05, 0.5},
        {"dust_range_m", "1.5", 0.5, 4.0},
        {"drops", "0.02", 0.0, 0.05},
        {"dropout", "0.2", 0.0, 0.4},
        {"roughness_m", "0.03", 0.0, 0.06}}},
      {"dust_thickens",
       SceneKind::kAdversarial,
       "dust that gets thicker",
       "degraded, then held as it thickens; no oscillation",
       {{"dust", "0.9", 0.6, 0.98},
        {"dust_rise_s", "2", 1.0, 4.0},
        {"dust_range_m", "1", 0.4, 2.5},
        {"roughness_m", "0.03", 0.0, 0.06}}},
      {"dropout", SceneKind::kAdversarial, "many returns lost", "valid or degraded", {{"dropout", "0.5", 0.2, 0.6}}},
      {"wet_wall",
       SceneKind::kAdversarial,
       "one wall hardly to be seen",
       "that side degraded or held",
       {{"wet_side", "left", 1.0, 2.0}, {"wet_dropout", "0.95", 0.7, 1.0}}},
      {"dark_wall",
       SceneKind::kAdversarial,
       "one wall without return",
       "that side held or invalid",
       {{"wet_side", "right", 1.0, 2.0}, {"wet_dropout", "1", 0.98, 1.0}, {"roughness_m", "0.03", 0.0, 0.06}}},
      {"shimmer",
       SceneKind::kAdversarial,
       "hot exhaust in view",
       "inside the protection level",
       {{"shimmer_from_deg", "60", 30.0, 90.0},
        {"shimmer_to_deg", "150", 110.0, 180.0},
        {"shimmer_factor", "5", 3.0, 6.0}}},
      {"blocked",
       SceneKind::kAdversarial,
       "mud on the window",
       "that side degraded or held",
       {{"blocked_from_deg", "40", 20.0, 60.0}, {"blocked_to_deg", "140", 100.0, 160.0}}},
      {"blocked_twice",
       SceneKind::kAdversarial,
       "mud on the window on both sides",
       "both sides degraded or held",
       {{"blocked_from_deg", "50", 20.0, 80.0},
        {"blocked_to_deg", "130", 90.0, 160.0},
        {"blocked_2_from_deg", "-130", -160.0, -90.0},
        {"blocked_2_to_deg", "-50", -80.0, -20.0}}},
      {"half_blocked",
       SceneKind::kAdversarial,
       "half the view blocked",
       "that side held or invalid",
       {{"blocked_from_deg", "-180", -200.0, -160.0}, {"blocked_to_deg", "0", -20.0, 20.0}}},
  };
}

}  // namespace pose_wall::tools::sim
