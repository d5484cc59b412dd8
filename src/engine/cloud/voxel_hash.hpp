// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "base/math/golden_ratio.hpp"

namespace pose_wall {

// Key to index, open addressing with linear probing over a power-of-two table at most half full. Indices are given out
// in the order of first insertion.
//
// An attacker who knows the hash can choose keys that all begin at one slot. So a key probes kProbesMost slots and no
// more. If none of them is free or its own, it goes into a tree beside the table. The tree branches at the highest bit
// in which keys differ, so it is never deeper than a key has bits, whatever the keys and their order. A slot is never
// freed, so a key that went to the tree does so again, and its index does not show where it lies.
class VoxelHash {
 public:
  static constexpr std::uint32_t kFull = 0xFFFFFFFFU;  // no index is as large
  // Few random keys go further, even in a table half full, and the tree costs as much as some more probes.
  static constexpr std::uint32_t kProbesMost = 8;
  // A link of the tree has room for twenty bits of an index; points_max is 400,000 at most.
  static constexpr std::uint32_t kCapacityMost = 1U << 20;

  // capacity: how many keys, up to kCapacityMost; the table has at least twice as many slots.
  void lay_out(Arena& arena, std::uint32_t capacity) {
    capacity_ = capacity;
    std::uint32_t bits = 1;
    while ((1U << bits) < 2 * capacity) ++bits;
    shift_ = 64 - bits;
    mask_ = (1U << bits) - 1;
    slots_ = arena.take<std::uint32_t>(1U << bits);
    keys_ = arena.take<std::uint64_t>(capacity);
    for (Span<std::uint32_t>& side : sides_) side = arena.take<std::uint32_t>(capacity + 1);
  }

  void clear() {
    count_ = 0;
    root_ = kFree;
    links_ = 0;
    slots_.fill(kFree);
  }

  // Adds keys one after the other and keeps the changing numbers in registers, not in the table. Nothing else may read
  // the table meanwhile.
  class Filling {
   public:
    explicit Filling(VoxelHash* hash)
        : hash_(*hash),
          slots_(hash->slots_.data()),
          keys_(hash->keys_.data()),
          capacity_(hash->capacity_),
          mask_(hash->mask_),
          shift_(hash->shift_),
          count_(hash->count_) {}
    ~Filling() { hash_.count_ = count_; }
    Filling(const Filling&) = delete;
    Filling& operator=(const Filling&) = delete;

    // Index of the key, new or old; kFull if a new key does not fit. Points arrive in scan order, so the last key is
    // often the next one too.
    std::uint32_t insert(std::uint64_t key) {
      if (key == last_key_) return last_index_;
      std::uint32_t slot = home(key), index = slots_[slot];
      for (std::uint32_t probe = 1; index != kFree && keys_[index] != key; ++probe) {
        if (probe == kProbesMost) return insert_crowded(key);
        slot = (slot + 1) & mask_;
        index = slots_[slot];
      }
      if (index == kFree) {
        if (count_ == capacity_) return kFull;
        slots_[slot] = index = count_;
        keys_[count_++] = key;
      }
      last_key_ = key;
      return last_index_ = index;
    }

    std::uint32_t count() const { return count_; }

   private:
    std::uint32_t insert_crowded(std::uint64_t key) {
      const std::uint32_t index = hash_.find_or_branch(key, count_);
      if (index == kFull) return kFull;
      if (index == count_) keys_[count_++] = key;
      last_key_ = key;
      return last_index_ = index;
    }

    // Fibonacci hashing: the high bits of the product depend on all bits of the key.
    std::uint32_t home(std::uint64_t key) const { return static_cast<std::uint32_t>((key * kGoldenTurn64) >> shift_); }

    VoxelHash& hash_;
    std::uint32_t* const slots_;
    std::uint64_t* const keys_;
    const std::uint32_t capacity_, mask_, shift_;
    std::uint32_t count_, last_index_ = 0;
    std::uint64_t last_key_ = ~0ULL;
  };

  std::uint32_t count() const { return count_; }
  std::uint64_t key(std::uint32_t index) const { return keys_[index]; }
  Span<const std::uint64_t> keys() const { return keys_.first(count_); }

  // Number of branchings of the tree, and slots before it, passed since clear(): the cost of crowding.
  std::uint64_t links() const { return links_; }
  std::uint32_t slots() const { return slots_.size(); }

  // The tree's room, of the capacity and one each. Once all keys are in, the tree is not needed, and the caller may
  // write there until the next clear().
  Span<std::uint32_t> first_side() const { return sides_[0]; }
  Span<std::uint32_t> second_side() const { return sides_[1]; }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFFU;  // all ones, so that clearing is a fill; no index is as large

  // Index of a key that found no room among its slots. A new key gets `count` and a place in the tree; kFull if it does
  // not fit.
  std::uint32_t find_or_branch(std::uint64_t key, std::uint32_t count);

  Span<std::uint32_t> slots_;  // indices
  Span<std::uint64_t> keys_;
  std::uint32_t capacity_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t mask_ = 1, shift_ = 63;  // of the table's slots
  // The tree. Each key but the first brings the branching at which it parted from the others; both have its index.
  Span<std::uint32_t> sides_[2];  // by index of a branching: the links at its side of zeros and of ones
  std::uint32_t root_ = kFree;
  std::uint64_t links_ = 0;
};

}  // namespace pose_wall
