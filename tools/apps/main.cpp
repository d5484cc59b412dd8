// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "command.hpp"
#include "io/terminal/whole_lines.hpp"

int main(int argc, char** argv) {
  pose_wall::tools::write_whole_lines();
  return pose_wall::tools::run_command(argc, argv);
}
