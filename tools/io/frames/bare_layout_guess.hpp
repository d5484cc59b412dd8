// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How many numbers make a point of bare bytes, by what the numbers look like.
//
// Under the right layout each column holds one kind of value: x, y, z and intensity differ in size. Under a wrong one
// every column holds a mixture of all of them. So the share of the variance of log2|value| that the columns explain is
// large for the right layout and nearly zero for the others. This does not depend on the order of the points.
//
// A layout whose points are parts of the right one's has columns of one kind, too, or nearly so: every second point is
// then intensity, ring and time. So the same column of neighbouring points must hold values of one kind.

#pragma once

#include <vector>

#include "io/frames/bare_points.hpp"

namespace pose_wall::tools {

struct BareGuess {
  std::vector<BareLayout> possible;  // by size and values, the likeliest first
  bool is_clear = false;             // the first is the only one that is likely

  const BareLayout* clear() const { return is_clear ? &possible.front() : nullptr; }
};

BareGuess guess_bare_layout(const Bytes& bytes);

// Why it is not clear: names the layouts and the option that chooses.
std::string unclear_layout_text(const BareGuess& guess, std::size_t bytes);

// Reads by the guess. Throws FrameError where it is not clear.
Frame read_guessed_points(Bytes bytes);

}  // namespace pose_wall::tools
