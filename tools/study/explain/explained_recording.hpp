// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Runs a recording through the engine and explains one of its frames, or all of them in short.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/config_file/load_config.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "study/explain/explanation.hpp"
#include "study/explain/summary.hpp"
#include "study/explain/traced_frame.hpp"

namespace pose_wall::tools::explain {

struct Explained {
  FrameOutcome outcome;  // of the delivered engine
  std::optional<TracedFrame> traced;
  Explanation explanation;
  std::string picture;  // SVG; empty where none is wanted
};

struct RecordingRun {
  const LoadedConfig& loaded;
  double rate_hz;
  bool shows_progress;
  bool wants_picture;
};

// Frames before it are measured too: held and smoothed values depend on them. Nothing after Ctrl-C. Throws
// std::runtime_error where the input ends before it.
std::optional<Explained> explain_one(const RecordingRun& run, FrameSequence& inputs, std::uint64_t frame);

struct ExplainedRecording {
  RecordingSummary summary;
  std::optional<Explained> worst;  // nothing where no frame could be read
  bool interrupted = false;
};
ExplainedRecording explain_all(const RecordingRun& run, FrameSequence& inputs);

}  // namespace pose_wall::tools::explain
