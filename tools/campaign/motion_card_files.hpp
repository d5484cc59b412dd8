// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The card of motion as text: for people (card.md), for programs (card.json), for the terminal.

#pragma once

#include <filesystem>
#include <string>

#include "campaign/motion_card.hpp"

namespace pose_wall::tools::campaign {

std::string motion_card_page(const MotionCard& card);
std::string motion_card_json(const MotionCard& card);
// A row a class, and what it breaks.
std::string motion_card_summary(const MotionCard& card);

// The classes, what is right in each and what is allowed there, as `campaign --motion --list` prints them.
std::string motion_class_list();

// card.md, card.json. Throws std::runtime_error that names the file.
void write_motion_card(const std::filesystem::path& folder, const MotionCard& card);

}  // namespace pose_wall::tools::campaign
