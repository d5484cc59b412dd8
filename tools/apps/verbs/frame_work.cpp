// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/verbs/frame_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "apps/verbs/verbs.hpp"
#include "io/language/language.hpp"
#include "io/terminal/frames_text.hpp"

namespace pose_wall::tools {

bool has_no_input(const char* verb, const FrameSequence& inputs, const std::string& output) {
  std::error_code ignored;
  const bool nothing_to_read = inputs.frames() == 0 || std::none_of(inputs.files().begin(), inputs.files().end(),
                                                                    [&](const std::filesystem::path& file) {
                                                                      return std::filesystem::exists(file, ignored);
                                                                    });
  if (!nothing_to_read) return false;
  for (const std::string& error : inputs.errors()) fmt::print(stderr, "pose_wall {}: {}\n", verb, error);
  for (const auto& file : inputs.files()) {
    if (std::filesystem::exists(file, ignored)) continue;
    fmt::print(stderr, "{}", say("pose_wall {}: {}: no such file or folder\n", verb, file.string()));
  }
  fmt::print(stderr, "{}",
             std::filesystem::exists(output)
                 ? say("pose_wall {}: there is no input; {} is left as it was\n", verb, output)
                 : say("pose_wall {}: there is no input\n", verb));
  return true;
}

int tell_interrupted(std::size_t frames) {
  fmt::print(stderr, "{}", say("interrupted after {}, each with its whole row\n", frames_text(frames)));
  return kExitInterrupted;
}

}  // namespace pose_wall::tools
