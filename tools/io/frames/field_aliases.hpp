// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What drivers call the fields of a point.

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace pose_wall::tools {

enum class FieldRole { kNone, kCoordinate, kIntensity, kTime, kRing };

// Names of a role, the first that a cloud has is taken.
const std::vector<std::string_view>& field_names(FieldRole role);

FieldRole field_role(std::string_view name);

// Seconds that one step of a cloud's times stands for, by how far they spread within one scan, which takes 0.01 to 1 s:
// 1, 1e-3, 1e-6 or 1e-9; 0 when no unit makes a scan of them.
double time_unit_s(double spread);

}  // namespace pose_wall::tools
