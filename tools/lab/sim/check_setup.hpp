// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include "lab/sim/setup.hpp"

namespace pose_wall::tools::sim {

// The setup as it is. Throws std::invalid_argument that names the keys which contradict each other.
const Setup& checked(const Setup& setup);

}  // namespace pose_wall::tools::sim
