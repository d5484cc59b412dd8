// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Calls of the C ABI that every part with settings and a block has. Held: the part in its block (held.hpp), laid out by
// its settings. Table: those settings (settings.hpp). Handle: the header's opaque struct.

#pragma once

#include <cstdint>

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

// call(body) gives the status; the handle may be NULL.
template <typename Held, typename Handle, typename Call>
std::int32_t with_part(Handle* handle, const Call& call) {
  if (handle == nullptr) return POSE_WALL_E_NULL;
  const Inside<Held> inside(reinterpret_cast<const Held*>(handle));
  return inside.status() == POSE_WALL_OK ? call(inside->body()) : inside.status();
}

}  // namespace pose_wall
