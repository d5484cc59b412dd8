// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The card as text: for people (card.md), for programs (card.json), as pictures (stanford_*.svg), for the terminal.

#pragma once

#include <filesystem>
#include <string>

#include "lab/campaign/card.hpp"
#include "lab/campaign/motion_card.hpp"

namespace pose_wall::tools::campaign {

std::string card_page(const Card& card);
std::string card_page(const MotionCard& card);
std::string card_json(const Card& card);
std::string card_json(const MotionCard& card);
// Totals and what is remarkable; of motion a row a class, and what it breaks.
std::string card_summary(const Card& card);
std::string card_summary(const MotionCard& card);

// The classes, what is right in each and what is allowed there, as `campaign --motion --list` prints them.
std::string motion_class_list();

// card.md, card.json, and of the engine level_curve.csv, stanford_angles.svg, stanford_distances.svg. Both throw
// std::runtime_error that names the file.
void write_card(const std::filesystem::path& folder, const Card& card);
void write_card(const std::filesystem::path& folder, const MotionCard& card);

}  // namespace pose_wall::tools::campaign
