// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What cannot be read or written is told apart from what was asked wrongly: by the exit status, for scripts.

#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "apps/verbs/verbs.hpp"
#include "io/config_file/load_config.hpp"

namespace pose_wall::tools {

// The exit status that `work` returns, or that of the std::runtime_error it throws, which is said on stderr. Settings
// that are refused are bad usage: ConfigError passes, as everything else does.
template <typename Work>
int done_or_complaint(const char* verb, const Work& work) {
  try {
    return work();
  } catch (const ConfigError&) {
    throw;
  } catch (const std::runtime_error& error) {
    fmt::print(stderr, "pose_wall {}: {}\n", verb, error.what());
    return kExitUnreadable;
  }
}

}  // namespace pose_wall::tools
