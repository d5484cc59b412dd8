// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/terminal/colours.hpp"

#include <cstdlib>
#include <cstring>

#include "io/terminal/progress_bar.hpp"

namespace pose_wall::tools {

bool wants_colours(bool is_terminal, const char* no_color, const char* term) {
  const bool is_forbidden = no_color != nullptr && *no_color != '\0';
  const bool is_dumb = term != nullptr && std::strcmp(term, "dumb") == 0;
  return is_terminal && !is_forbidden && !is_dumb;
}

bool wants_colours(int stream) {
  return wants_colours(is_terminal(stream), std::getenv("NO_COLOR"), std::getenv("TERM"));
}

}  // namespace pose_wall::tools
