// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The meaning of a failed gate in a few sentences, and the remedy.

#pragma once

#include <string>

#include "study/explain/notes.hpp"

namespace pose_wall::tools::explain {

// "The plane is supported over 1.50 m along the road; 2.00 m is needed (wall_length_min)."
std::string sentence_of(const Note& note);

// "show more of the wall; ..."; empty where nothing is to be done.
std::string help_of(const Note& note);

}  // namespace pose_wall::tools::explain
