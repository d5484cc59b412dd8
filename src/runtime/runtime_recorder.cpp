// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The recorder's thread. It alone waits for the sink.

#include "runtime.hpp"
#include "saturated.hpp"

namespace pose_wall::runtime {
namespace {

// Starts of one runtime follow each other, so none has the number of the one before. Never 0, which unwritten bytes may
// hold.
std::uint16_t number_of_run(std::uint32_t seed, std::uint64_t start) {
  return static_cast<std::uint16_t>(1 + (seed + start) % 0xFFFFU);
}

}  // namespace

void* Runtime::run_recorder(void* runtime) {
  static_cast<Runtime*>(runtime)->record();
  return nullptr;
}

// At a stop it goes on until nothing waits: an incident is about the last worked frames.
void Runtime::record() {
  const std::uint16_t run = number_of_run(run_seed_, epoch_);
  bool begun = box_.begin(config_, run);
  Locked locked(&lock_);
  if (!begun) ++counters_.box_failed;
  while (!to_record_.empty() || !recorder_may_end_) {
    if (to_record_.empty()) {
      changed_.wait(&lock_);
      continue;
    }
    FrameSlot* const slot = to_record_.pop();
    recording_ = true;
    bool written = false;
    {
      Unlocked unlocked(&lock_);
      const std::int64_t begin_ns = now();
      // A disk that was not there at the start may be by now.
      begun = begun || box_.begin(config_, run);
      written = begun && box_.write(*slot);
      times_.sink.add(difference(now(), begin_ns));  // a disk that fails may take its time, too
    }
    ++(written ? counters_.box_written : counters_.box_failed);
    counters_.box_bytes_written = box_.bytes_written();
    recording_ = false;
    free_.push(slot);
    changed_.wake_all();
  }
}

}  // namespace pose_wall::runtime
