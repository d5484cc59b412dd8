// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Errors of a trajectory by known relations, as a table.

#pragma once

#include <string>

#include "io/planar_files/relations.hpp"

namespace pose_wall::tools {

std::string relation_table(const RelationReport& report);

}  // namespace pose_wall::tools
