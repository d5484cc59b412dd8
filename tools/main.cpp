// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "command.hpp"

int main(int argc, char** argv) {
  return pose_wall::tools::run_command(argc, argv);
}
