// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Stamps that go anywhere, by the bytes of an input.

#pragma once

#include "fuzz/fuzz_target.hpp"

namespace pose_wall::test {

// Of 256 moves, those below `usual` go on by a period, below `leaps` by up to 33 s in either way, below `anywhere` to
// any number; the rest stand still. Wraps like the clocks of sensors do.
struct StampMoves {
  std::uint8_t usual, leaps, anywhere;
};

inline void move_stamp(Input* input, const StampMoves& moves, std::int64_t* stamp_ns) {
  const std::uint8_t how = input->byte();
  std::int64_t by_ns = 0;
  if (how < moves.usual) {
    by_ns = 100000000;
  } else if (how < moves.leaps) {
    by_ns = std::int64_t{input->take<std::int16_t>()} * 1000000;
  } else if (how < moves.anywhere) {
    *stamp_ns = input->take<std::int64_t>();
  }
  *stamp_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(*stamp_ns) + static_cast<std::uint64_t>(by_ns));
}

}  // namespace pose_wall::test
