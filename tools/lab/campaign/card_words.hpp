// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Numbers of the card as words, the same in each of its forms.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lab/campaign/card.hpp"

namespace pose_wall::tools::campaign {

// "0.123°" or "12.3 mm"; "-" for NaN.
std::string amount(bool is_angle, double value);
// "98.2 %". "100 %" and "0 %" are all and none: "> 99.9 %" is not rounded up, "< 0.1 %" not down.
std::string percent(double share);
// "0.95"; "-" for NaN.
std::string figure(double value);
// "3 (<= 2.4e-04)": events, and the 95 % upper bound of their rate.
std::string count_with_bound(std::size_t events, std::size_t frames);
// "4 / 12 (1 never)": median and longest in frames; "-" when nothing was timed.
std::string times_text(std::vector<std::size_t> times, std::size_t never);
// The most frequent reasons of values that are not valid, each with its share of them all.
std::string reasons_text(const ClassCard& card);
// Whether the gate is passed, and a point for each demand that does not hold.
std::string gate_text(const std::vector<std::string>& faults);
// What the engine was given: scans that take time or not, with the motion library or not.
std::string movement_text(const Manifest& manifest);
// The command that makes the campaign again, and what decided its records.
std::string origin_text(const Manifest& manifest);

}  // namespace pose_wall::tools::campaign
