// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The card as text: for people (card.md), for programs (card.json), as pictures (stanford_*.svg), for the terminal.

#pragma once

#include <filesystem>
#include <string>

#include "campaign/card.hpp"

namespace pose_wall::tools::campaign {

std::string card_page(const Card& card);
std::string card_json(const Card& card);
// Totals and what is remarkable.
std::string card_summary(const Card& card);

// card.md, card.json, level_curve.csv, stanford_angles.svg, stanford_distances.svg. Throws std::runtime_error that
// names the file.
void write_card(const std::filesystem::path& folder, const Card& card);

}  // namespace pose_wall::tools::campaign
