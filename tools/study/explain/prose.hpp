// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Sentences, lists and counts put together as the chosen language writes them.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pose_wall::tools::explain {

// One paragraph: English puts a space between sentences, Chinese puts none. Empty sentences are left out.
std::string paragraph(const std::vector<std::string>& sentences);

// "left wall, right wall"; "左帮、右帮".
std::string listed(const std::vector<std::string>& words);

// "held, 1.92 m, 0.30 s old": of different things; Chinese divides these by a comma of its own.
std::string in_a_row(const std::vector<std::string>& parts);

// "a; b"; "a；b".
std::string clauses(const std::vector<std::string>& parts);
// The parts that clauses() put together.
std::vector<std::string> clauses_of(const std::string& text);

// "1 frame", "12 frames"; "12 帧".
std::string frames_text(std::size_t count);
std::string points_text(std::size_t count);

}  // namespace pose_wall::tools::explain
