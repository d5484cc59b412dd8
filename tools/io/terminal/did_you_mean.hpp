// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// "Did you mean": the known word nearest to a mistyped one.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools {

// Damerau-Levenshtein distance (optimal string alignment): insertions, deletions, substitutions and swaps of
// neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The nearest of `known` when it is near enough to be meant (a third of the word's length, at least two edits), else
// "".
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

// "; did you mean 'voxel_leaf'?" or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

// Words that question for the nearest word in another language; nullptr: English. The simulator, which asks it too,
// is built without the catalogues. Choose it once, before threads start.
using DidYouMeanWords = std::string (*)(const std::string& nearest);
void choose_did_you_mean(DidYouMeanWords words);

}  // namespace pose_wall::tools
