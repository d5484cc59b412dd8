// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Texts of the public enums.

#include <cstdint>

#include "part/export.hpp"
#include "pose_wall.h"

namespace pose_wall {
namespace {

// Each table is one string of all its texts, the last one for unknown numbers. A loader has no pointers to place, and
// the code is a ninth of a switch's:
constexpr char kStatusTexts[] =
#define STATUS(name, number, text) text "\0"
#include "engine/names.def"
    "unknown status";
constexpr char kReasonNames[] =
#define REASON(bit, name, text) name "\0"
#include "engine/names.def"
    "unknown";
constexpr char kReasonTexts[] =
#define REASON(bit, name, text) text "\0"
#include "engine/names.def"
    "unknown reason";
constexpr char kStateNames[] =
#define STATE(state, name) name "\0"
#include "engine/names.def"
    "unknown";
constexpr char kQuantityNames[] =
#define QUANTITY(quantity, name) name "\0"
#include "engine/names.def"
    "unknown";
constexpr char kStageNames[] =
#define STAGE(stage, name) name "\0"
#include "engine/names.def"
    "unknown";
constexpr char kPartNames[] =
#define PART(part, name) name "\0"
#include "engine/names.def"
    "unknown";
constexpr char kSenseNames[] =
#define SENSE(sense, name) name "\0"
#include "engine/names.def"
    "unknown";

// The numbers of the same rows, in the order of their texts:
constexpr std::int16_t kStatuses[] = {
#define STATUS(name, number, text) number,
#include "engine/names.def"
};
constexpr std::int64_t kReasonBits[] = {
#define REASON(bit, name, text) bit,
#include "engine/names.def"
};
constexpr std::int64_t kStates[] = {
#define STATE(state, name) state,
#include "engine/names.def"
};
constexpr std::int64_t kQuantities[] = {
#define QUANTITY(quantity, name) quantity,
#include "engine/names.def"
};
constexpr std::int64_t kStages[] = {
#define STAGE(stage, name) stage,
#include "engine/names.def"
};
constexpr std::int64_t kParts[] = {
#define PART(part, name) part,
#include "engine/names.def"
};
constexpr std::int64_t kSenses[] = {
#define SENSE(sense, name) sense,
#include "engine/names.def"
};

template <typename Number, std::uint32_t kRows>
constexpr std::uint32_t rows_of(const Number (&)[kRows]) {
  return kRows;
}

template <std::uint32_t kRows>
constexpr bool in_order(const std::int64_t (&numbers)[kRows]) {
  for (std::uint32_t row = 0; row < kRows; ++row) {
    if (numbers[row] != row) return false;
  }
  return true;
}

constexpr bool bits_in_order() {
  for (std::uint32_t row = 0; row < rows_of(kReasonBits); ++row) {
    if (kReasonBits[row] != 1LL << row) return false;
  }
  return true;
}

static_assert(bits_in_order() && rows_of(kReasonBits) == POSE_WALL_REASON_COUNT, "reasons by their bits");
static_assert(in_order(kStates) && rows_of(kStates) == POSE_WALL_VALID + 1, "states by their numbers");
static_assert(in_order(kQuantities) && rows_of(kQuantities) == POSE_WALL_QUANTITIES, "quantities by their numbers");
static_assert(in_order(kStages) && rows_of(kStages) == POSE_WALL_STAGES, "stages by their numbers");

static_assert(in_order(kParts) && rows_of(kParts) == POSE_WALL_PARTS, "parts by their numbers");
static_assert(in_order(kSenses) && rows_of(kSenses) == POSE_WALL_SENSE_TURNED_RIGHT + 1, "senses by their numbers");

const char* text_of(const char* texts, std::uint32_t rows, std::uint32_t row) {
  for (std::uint32_t left = row < rows ? row : rows; left > 0; --left) {
    while (*texts++ != '\0') {
    }
  }
  return texts;
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT const char* pose_wall_status_text(int32_t status) {
  std::uint32_t row = 0;
  while (row < rows_of(kStatuses) && kStatuses[row] != status) ++row;
  return text_of(kStatusTexts, rows_of(kStatuses), row);
}

POSE_WALL_EXPORT const char* pose_wall_reason_name(uint32_t bit_index) {
  return text_of(kReasonNames, rows_of(kReasonBits), bit_index);
}

POSE_WALL_EXPORT const char* pose_wall_reason_text(uint32_t bit_index) {
  return text_of(kReasonTexts, rows_of(kReasonBits), bit_index);
}

POSE_WALL_EXPORT const char* pose_wall_state_name(uint32_t state) {
  return text_of(kStateNames, rows_of(kStates), state);
}

POSE_WALL_EXPORT const char* pose_wall_quantity_name(uint32_t quantity) {
  return text_of(kQuantityNames, rows_of(kQuantities), quantity);
}

POSE_WALL_EXPORT const char* pose_wall_stage_name(uint32_t stage) {
  return text_of(kStageNames, rows_of(kStages), stage);
}

POSE_WALL_EXPORT const char* pose_wall_part_name(uint32_t part) {
  return text_of(kPartNames, rows_of(kParts), part);
}

POSE_WALL_EXPORT const char* pose_wall_sense_name(uint32_t sense) {
  return text_of(kSenseNames, rows_of(kSenses), sense);
}

}  // extern "C"

}  // namespace pose_wall
