// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"

namespace pose_wall::planar::route {

// A heap of fixed room with four children a node; the least key is on top. An entry is a key and a number in one word.
class OpenList {
 public:
  void lay_out(Arena& arena, std::uint32_t capacity) { entries_ = arena.take<std::uint64_t>(capacity); }
  void clear() { count_ = 0; }
  bool is_empty() const { return count_ == 0; }
  bool is_full() const { return count_ == entries_.size(); }
  Span<const std::uint64_t> entries() const { return entries_.first(count_); }

  static std::uint32_t key_of(std::uint64_t entry) { return static_cast<std::uint32_t>(entry >> 32); }
  static std::uint32_t number_of(std::uint64_t entry) { return static_cast<std::uint32_t>(entry); }

  // New keys for all entries; those whose key is kDrop go. new_key_of(number) gives them.
  static constexpr std::uint32_t kDrop = 0xFFFFFFFFU;
  template <typename KeyOf>
  void rekey(const KeyOf& new_key_of) {
    const std::uint32_t old = count_;
    count_ = 0;
    for (std::uint32_t k = 0; k < old; ++k) {  // what is pushed lies before what is still to be read
      const std::uint32_t number = number_of(entries_[k]), key = new_key_of(number);
      if (key != kDrop) push(key, number);
    }
  }

  // There is room.
  void push(std::uint32_t key, std::uint32_t number) {
    const std::uint64_t entry = (static_cast<std::uint64_t>(key) << 32) | number;
    std::uint32_t at = count_++;
    while (at > 0 && entries_[(at - 1) / kChildren] > entry) {
      entries_[at] = entries_[(at - 1) / kChildren];
      at = (at - 1) / kChildren;
    }
    entries_[at] = entry;
  }

  // It is not empty.
  std::uint64_t pop() {
    const std::uint64_t top = entries_[0], last = entries_[--count_];
    std::uint32_t at = 0;
    for (std::uint32_t child = 1; child < count_; child = at * kChildren + 1) {
      std::uint32_t least = child;
      for (std::uint32_t k = child + 1; k < child + kChildren && k < count_; ++k) {
        if (entries_[k] < entries_[least]) least = k;
      }
      if (entries_[least] >= last) break;
      entries_[at] = entries_[least];
      at = least;
    }
    entries_[at] = last;
    return top;
  }

 private:
  static constexpr std::uint32_t kChildren = 4;  // of eight bytes: two nodes lie in a line of the cache
  Span<std::uint64_t> entries_;
  std::uint32_t count_ = 0;
};

}  // namespace pose_wall::planar::route
