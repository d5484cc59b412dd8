// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Amounts of notes as people read them: degrees, per cent, metres to the centimetre.

#pragma once

#include <cstdint>
#include <string>

#include "study/explain/notes.hpp"

namespace pose_wall::tools::explain {

std::string metres(double value_m);
std::string degrees(double value_rad);
std::string per_cent(double share);

// In degrees or metres, as the quantity has it.
std::string quantity_amount(std::uint32_t quantity, double value);

// The note's value and limit, in its unit.
std::string value_text(const Note& note);
std::string limit_text(const Note& note);

// The config's key of the limit, "" where the limit is a constant. Of two keys the one for the note's subject.
std::string key_of(const Note& note);

// "frame", "floor", "left wall", "both walls", "d_lf": for programs, in every language.
std::string subject_name(std::uint32_t subject);
// The same for people.
std::string subject_words(std::uint32_t subject);

}  // namespace pose_wall::tools::explain
