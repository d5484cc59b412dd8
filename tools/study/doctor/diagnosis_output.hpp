// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A diagnosis for people and for programs.

#pragma once

#include <string>

#include "study/doctor/diagnosis.hpp"

namespace pose_wall::tools::doctor {

// Tables of what was found, what is to be changed and confirmed; then the verdict and its rule.
std::string diagnosis_text(const Diagnosis& diagnosis);

// The same as one JSON object; null where there is no number.
std::string diagnosis_json(const Diagnosis& diagnosis);

}  // namespace pose_wall::tools::doctor
