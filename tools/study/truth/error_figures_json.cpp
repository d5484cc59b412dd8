// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/truth/error_figures_json.hpp"

#include <nlohmann/json.hpp>

namespace pose_wall::tools {

Json error_figures_json(const ErrorFigures& figures) {
  return {{"count", figures.count},
          {"rmse", figures.rmse},
          {"bias", figures.bias},
          {"absolute_95", figures.absolute_95},
          {"absolute_max", figures.absolute_max}};
}

}  // namespace pose_wall::tools
