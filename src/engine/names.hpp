// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Texts of the public enums.

#pragma once

#include <cstdint>

namespace pose_wall {

const char* status_text(std::int32_t status);
const char* reason_name(std::uint32_t bit_index);
const char* reason_text(std::uint32_t bit_index);
const char* state_name(std::uint32_t state);
const char* quantity_name(std::uint32_t quantity);
const char* stage_name(std::uint32_t stage);
const char* part_name(std::uint32_t part);
const char* sense_name(std::uint32_t sense);

}  // namespace pose_wall
