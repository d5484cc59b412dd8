// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/terminal/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace pose_wall::tools {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else");
int watches = 0;  // of the thread that reads the command line alone

extern "C" void note_interrupt(int) {
  interrupted = true;
  std::signal(SIGINT, SIG_DFL);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  if (watches++ > 0) return;
  interrupted = false;
  before_ = std::signal(SIGINT, note_interrupt);
  if (before_ == SIG_IGN) std::signal(SIGINT, SIG_IGN);
}

InterruptWatch::~InterruptWatch() {
  if (--watches == 0 && before_ != SIG_ERR) std::signal(SIGINT, before_);
}

bool InterruptWatch::is_interrupted() {
  return interrupted;
}

void stop_if_interrupted() {
  if (InterruptWatch::is_interrupted()) throw Interrupted();
}

}  // namespace pose_wall::tools
