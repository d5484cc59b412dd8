// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include "io/json/json_words.hpp"
#include "study/truth/error_statistics.hpp"

namespace pose_wall::tools {

// Null where there is no number.
Json error_figures_json(const ErrorFigures& figures);

}  // namespace pose_wall::tools
