// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which frame of a recording the command line means: by number, name or stamp, or the worst.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "io/inputs/frame_sequence.hpp"

namespace pose_wall::tools::explain {

// As given; both empty: the whole recording.
struct FrameChoice {
  std::string frame;  // "12", "worst", "000123.pcd", "road.bag#12"
  std::string
      stamp;  // "1690000000.25" in s, a frame's own stamp or more than 10 digits in ns, "+3.5": s since the first frame
};

enum class ChoiceKind { kRecording, kWorst, kNumber, kName, kStamp };
ChoiceKind kind_of(const FrameChoice& choice);

// Why the word is no stamp; empty where it is one.
std::string stamp_fault(const std::string& word);

struct FoundFrame {
  std::uint64_t frame;
  std::string told;          // which frame was taken and how far off its stamp is; empty for a number
  bool read_frames = false;  // then the sequence is at its end: open another one to measure
};

// Goes through the sequence where the search needs names or stamps of frames. `step` gets the name of each
// frame that was read; its false stops the search, and nothing is found. Throws std::invalid_argument that names the
// allowed choices, std::runtime_error where there is no frame.
std::optional<FoundFrame> find_frame(const FrameChoice& choice, FrameSequence& frames, double rate_hz,
                                     const std::function<bool(const std::string&)>& step);

}  // namespace pose_wall::tools::explain
