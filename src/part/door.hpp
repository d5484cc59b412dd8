// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How a pointer of the C ABI is known to be an opened part, and that one call is inside.

#pragma once

#include <cstdint>
#include <type_traits>

#include "pose_wall.h"

namespace pose_wall {

class Door {
 public:
  // For a part at this place; each kind of part has a magic number of its own.
  void open(std::uint64_t magic, const void* self) {
    inside_ = kNobody;
    magic_ = magic;
    self_ = self;
  }

  // After POSE_WALL_OK leave() must follow. POSE_WALL_E_BUSY: another call is inside. POSE_WALL_E_ENGINE: no such part
  // was opened here, or these words were changed from outside.
  std::int32_t enter(std::uint64_t magic, const void* self) const {
    if (magic_ != magic || self_ != self) return POSE_WALL_E_ENGINE;
    std::uint64_t inside = kNobody;
    if (__atomic_compare_exchange_n(&inside_, &inside, kOne, false, __ATOMIC_ACQUIRE, __ATOMIC_RELAXED)) {
      return POSE_WALL_OK;
    }
    return inside == kOne ? POSE_WALL_E_BUSY : POSE_WALL_E_ENGINE;
  }
  void leave() const { __atomic_store_n(&inside_, kNobody, __ATOMIC_RELEASE); }

  // Whether a call is inside. The words may hold anything, also what was never written.
#if defined(__clang__)
  __attribute__((no_sanitize("memory")))
#endif
  bool
  is_entered(std::uint64_t magic, const void* self) const {
    return magic_ == magic && self_ == self && __atomic_load_n(&inside_, __ATOMIC_RELAXED) == kOne;
  }

 private:
  // Far apart in bits, so that a flipped bit does not look like a call inside:
  static constexpr std::uint64_t kNobody = 0x6964CC33A55A6C65ULL;
  static constexpr std::uint64_t kOne = 0x96813C5A5AA5939AULL;

  // First, since it changes with each call: a part that sums up its state begins behind it.
  mutable std::uint64_t inside_ = kNobody;
  std::uint64_t magic_ = 0;
  const void* self_ = nullptr;

 public:
  static constexpr std::uint64_t kChangingBytes = sizeof(inside_);  // of the first word
};

// call(part) inside a part that has enter() and leave(). It gives the status, or nothing where it cannot fail. The
// header's handle may be NULL.
template <typename Part, typename Handle, typename Call>
std::int32_t with_inside(const Handle* handle, const Call& call) {
  if (handle == nullptr) return POSE_WALL_E_NULL;
  Part& part = *reinterpret_cast<Part*>(const_cast<Handle*>(handle));
  std::int32_t status = part.enter();
  if (status != POSE_WALL_OK) return status;
  if constexpr (std::is_void<decltype(call(part))>::value) {
    call(part);
  } else {
    status = call(part);
  }
  part.leave();
  return status;
}

}  // namespace pose_wall
