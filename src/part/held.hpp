// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// An opened part in its caller's block.
//
//     using Mine = Held<Body, 0x...>;      Body has lay_out(Arena&) and is trivially destructible
//     std::uint64_t bytes = Mine::bytes(lay_out_arguments...);
//     status = Mine::place(block, bytes, &mine, lay_out_arguments...);
//     with_inside<Mine>(handle, [](Mine& mine) { mine.body()... });

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "part/door.hpp"
#include "part/status.hpp"
#include "pose_wall.h"

namespace pose_wall {

template <typename Body, std::uint64_t kMagic>
class Held {
 public:
  // One walk both measures and places.
  template <typename... Arguments>
  static std::uint64_t bytes(const Arguments&... arguments) {
    return lay_out(nullptr, nullptr, arguments...);
  }

  // Fails for a block that is NULL, misaligned or too small; *out is then unchanged.
  template <typename... Arguments>
  static std::int32_t place(void* block, std::uint64_t block_bytes, Held** out, const Arguments&... arguments) {
    if (block == nullptr || out == nullptr) return POSE_WALL_E_NULL;
    if (!is_aligned(block)) return POSE_WALL_E_BLOCK_ALIGN;
    if (block_bytes < bytes(arguments...)) return POSE_WALL_E_BLOCK_SMALL;
    lay_out(block, out, arguments...);
    (*out)->door_.open(kMagic, *out);
    return POSE_WALL_OK;
  }

  std::int32_t enter() const { return door_.enter(kMagic, this); }
  void leave() const { door_.leave(); }
  Body& body() { return body_; }

 private:
  template <typename... Arguments>
  static std::uint64_t lay_out(void* block, Held** out, const Arguments&... arguments) {
    Arena arena(block);
    Held* const held = arena.take_one<Held>();
    Body measured;
    (held != nullptr ? held->body_ : measured).lay_out(arena, arguments...);
    if (out != nullptr) *out = held;
    return arena.bytes();
  }

  Door door_;
  Body body_;
};

}  // namespace pose_wall
