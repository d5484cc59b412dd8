// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Calls of the C ABI that every part with settings and a block has. Held: the part in its block (held.hpp), laid out by
// its settings. Table: those settings (settings.hpp). Handle: the header's opaque struct.
//
// A part defines its calls in its own namespace: by their C linkage they are those of the header.

#pragma once

#include <cstdint>

#include "part/export.hpp"
#include "part/held.hpp"
#include "part/settings.hpp"

namespace pose_wall {

template <typename Held, typename Table>
std::int32_t part_memory_needed(const typename Table::Settings* settings, std::uint64_t* bytes) {
  if (bytes == nullptr) return POSE_WALL_E_NULL;
  typename Table::Settings chosen;
  const std::int32_t status = choose_settings<Table>(settings, &chosen);
  if (status == POSE_WALL_OK) *bytes = Held::bytes(chosen);
  return status;
}

// open(body, settings) readies the part; *handle is written where all went well.
template <typename Held, typename Table, typename Handle, typename Open>
std::int32_t open_part(const typename Table::Settings* settings, void* block, std::uint64_t block_bytes,
                       Handle** handle, const Open& open) {
  if (block == nullptr || handle == nullptr) return POSE_WALL_E_NULL;
  typename Table::Settings chosen;
  Held* held = nullptr;
  std::int32_t status = choose_settings<Table>(settings, &chosen);
  if (status == POSE_WALL_OK) status = Held::place(block, block_bytes, &held, chosen);
  if (status != POSE_WALL_OK) return status;
  open(held->body(), chosen);
  *handle = reinterpret_cast<Handle*>(held);
  return POSE_WALL_OK;
}

// call(body) gives the status, or nothing where it cannot fail; the handle may be NULL.
template <typename Held, typename Handle, typename Call>
std::int32_t with_part(const Handle* handle, const Call& call) {
  return with_inside<Held>(handle, [&](Held& held) { return call(held.body()); });
}

}  // namespace pose_wall

// NOLINTBEGIN(bugprone-macro-parentheses): the arguments are types

// part_settings_init() and part_settings_check() of the header, by the part's table.
#define POSE_WALL_SETTINGS_CALLS(part, Table, Fault)                                              \
  POSE_WALL_EXPORT int32_t part##_settings_init(part##_settings* settings) {                      \
    return ::pose_wall::init_settings<Table>(settings);                                           \
  }                                                                                               \
  POSE_WALL_EXPORT int32_t part##_settings_check(const part##_settings* settings, Fault* fault) { \
    return ::pose_wall::check_settings<Table>(settings, fault);                                   \
  }

// part_memory_needed() and part_open() of a part that its settings alone lay out and open.
#define POSE_WALL_BLOCK_CALLS(part, Held, Table, Handle)                                                   \
  POSE_WALL_EXPORT int32_t part##_memory_needed(const part##_settings* settings, uint64_t* bytes) {        \
    return ::pose_wall::part_memory_needed<Held, Table>(settings, bytes);                                  \
  }                                                                                                        \
  POSE_WALL_EXPORT int32_t part##_open(const part##_settings* settings, void* block, uint64_t block_bytes, \
                                       Handle** handle) {                                                  \
    return ::pose_wall::open_part<Held, Table>(settings, block, block_bytes, handle,                       \
                                               [](auto& body, const auto& chosen) { body.open(chosen); }); \
  }

// NOLINTEND(bugprone-macro-parentheses)
