// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The newest of a series of values, for readers that must never wait. Four cells, each with a sequence lock (Boehm
// 2012: every word is atomic, so a torn read is a wrong read and not undefined). Only a writer that comes round to a
// reader's cell during its copy disturbs it. A writer put to sleep in the middle disturbs nobody. Each cell carries a
// sum, since a flipped bit would become a value.

#pragma once

#include <atomic>
#include <cstdint>
#include <cstring>

#include "base/math/fnv1a.hpp"

namespace pose_wall::runtime {

constexpr int kLatestAttempts = 1000;  // a loop needs an end; a second one is rare already, see load()

enum class LatestStatus { kNothing, kDamaged, kThere };

template <typename T, std::uint32_t kCells = 4>
class LatestValue {
 public:
  // One thread only.
  void store(const T& value) {
    const std::uint64_t turn = turn_.load(std::memory_order_relaxed) + 1;
    Cell& cell = cell_[turn % kCells];
    const std::uint64_t version = cell.version.load(std::memory_order_relaxed);
    cell.version.store(version + 1, std::memory_order_relaxed);  // odd: being written
    std::uint64_t sum = kFnv1aOfNothing;
    for (std::uint32_t i = 0; i < words(); ++i) {
      // Release: a reader of this word sees the odd version, too.
      const std::uint64_t word = word_of(value, i);
      cell.word[i].store(word, std::memory_order_release);
      sum = fnv1a_with(sum, word);
    }
    cell.sum.store(sum, std::memory_order_release);
    cell.version.store(version + 2, std::memory_order_release);
    turn_.store(turn, std::memory_order_release);
  }

  // A reader whose cell was overwritten takes the newer one; the cap is for the case that cannot be, a writer faster
  // than any copy.
  LatestStatus load(T* value) const {
    for (int attempt = 0; attempt < kLatestAttempts; ++attempt) {
      const std::uint64_t turn = turn_.load(std::memory_order_acquire);
      if (turn == 0) return LatestStatus::kNothing;
      const Cell& cell = cell_[turn % kCells];
      const std::uint64_t before = cell.version.load(std::memory_order_acquire);
      T copy;
      std::uint64_t sum = kFnv1aOfNothing;
      for (std::uint32_t i = 0; i < words(); ++i) {
        const std::uint64_t word = cell.word[i].load(std::memory_order_acquire);
        set_word(&copy, i, word);
        sum = fnv1a_with(sum, word);
      }
      const std::uint64_t noted = cell.sum.load(std::memory_order_acquire);
      if (before % 2 != 0 || cell.version.load(std::memory_order_relaxed) != before) continue;
      if (sum != noted) return LatestStatus::kDamaged;
      *value = copy;
      return LatestStatus::kThere;
    }
    return LatestStatus::kDamaged;
  }

  // While no thread stores or loads.
  void clear() { turn_.store(0, std::memory_order_release); }

 private:
  static constexpr std::uint32_t words() { return sizeof(T) / 8; }
  static_assert(sizeof(T) % 8 == 0, "made of whole words");
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "a reader would wait for a lock of the library's");

  struct Cell {
    std::atomic<std::uint64_t> version{0};
    std::atomic<std::uint64_t> word[words()] = {};
    std::atomic<std::uint64_t> sum{0};
  };

  static std::uint64_t word_of(const T& value, std::uint32_t i) {
    std::uint64_t word;
    std::memcpy(&word, reinterpret_cast<const unsigned char*>(&value) + 8 * i, 8);
    return word;
  }
  static void set_word(T* value, std::uint32_t i, std::uint64_t word) {
    std::memcpy(reinterpret_cast<unsigned char*>(value) + 8 * i, &word, 8);
  }

  Cell cell_[kCells];
  std::atomic<std::uint64_t> turn_{0};
};

}  // namespace pose_wall::runtime
