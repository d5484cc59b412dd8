// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One HTML file that needs nothing but itself: the page of page/, its style and scripts, and the data.

#pragma once

#include <string>

#include "io/config_file/load_config.hpp"
#include "study/report/page_data.hpp"

namespace pose_wall::tools::report {

// What the page says of the recording beside its frames.
struct PageHead {
  std::string title;
  std::string language;  // "en" or "zh": what it opens in
  std::string truth;     // the file, or empty
  bool complete = true;  // false: interrupted before the last input
  std::size_t inputs = 0;
  bool from_table = false;  // made of a table of run alone: there is no cloud, and no plane has a direction
};

// What a page's script reads beside the frames: the head, and the engine's names for states, reasons and parts.
Json head_json(const PageHead& head, const LoadedConfig& loaded);
Json words_json();

// The same data give the same text.
std::string page(const PageHead& head, const LoadedConfig& loaded, const PageData& data);

}  // namespace pose_wall::tools::report
