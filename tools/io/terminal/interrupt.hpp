// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Ctrl-C as a wish that the work can meet in its own time.

#pragma once

#include <exception>

namespace pose_wall::tools {

// While it lives, the first Ctrl-C is only noted; a second one ends the program as ever. Where the program was started
// with Ctrl-C ignored (in the background), it stays ignored. A watch within another sees what that one has seen.
class InterruptWatch {
 public:
  InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  ~InterruptWatch();

  // From any thread.
  static bool is_interrupted();

 private:
  void (*before_)(int) = nullptr;
};

// Thrown where work has no other way to end early.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

// Throws Interrupted after Ctrl-C.
void stop_if_interrupted();

}  // namespace pose_wall::tools
