// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// An opened part in its caller's block: how a pointer of the C ABI is known to be one, and that one call is inside.
//
//     using Mine = Held<Body, 0x...>;      Body has lay_out(Arena&) and is trivially destructible
//     std::uint64_t bytes = Mine::bytes(lay_out_arguments...);
//     status = Mine::place(block, bytes, &mine, lay_out_arguments...);
//     Mine::Inside inside(mine);  if (inside.status() != POSE_WALL_OK) return inside.status();
//     inside.body()...

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "pose_wall.h"

namespace pose_wall::planar {

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
    if (reinterpret_cast<std::uintptr_t>(block) % POSE_WALL_BLOCK_ALIGNMENT != 0) return POSE_WALL_E_BLOCK_ALIGN;
    if (block_bytes < bytes(arguments...)) return POSE_WALL_E_BLOCK_SMALL;
    lay_out(block, out, arguments...);
    (*out)->magic_ = kMagic;
    (*out)->self_ = *out;
    (*out)->inside_ = 0;
    return POSE_WALL_OK;
  }

  Body& body() { return body_; }

  // One call inside, as long as this lives. The pointer may be anything but NULL.
  class Inside {
   public:
    explicit Inside(const Held* held) : held_(const_cast<Held*>(held)), status_(enter()) {}
    ~Inside() {
      if (status_ == POSE_WALL_OK) __atomic_store_n(&held_->inside_, std::uint64_t{0}, __ATOMIC_RELEASE);
    }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;

    std::int32_t status() const { return status_; }
    Body& body() const { return held_->body_; }

   private:
    std::int32_t enter() const {
      if (held_->magic_ != kMagic || held_->self_ != held_) return POSE_WALL_E_ENGINE;
      std::uint64_t nobody = 0;
      const bool entered = __atomic_compare_exchange_n(&held_->inside_, &nobody, std::uint64_t{1}, false,
                                                       __ATOMIC_ACQUIRE, __ATOMIC_RELAXED);
      return entered ? std::int32_t{POSE_WALL_OK} : POSE_WALL_E_BUSY;
    }

    Held* held_;
    std::int32_t status_;
  };

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

  std::uint64_t magic_ = 0;
  const Held* self_ = nullptr;
  std::uint64_t inside_ = 0;
  Body body_;
};

}  // namespace pose_wall::planar
