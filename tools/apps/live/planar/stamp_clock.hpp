// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Stamps of a sensor on the clock of this process, so that a frame that waited somewhere counts as old.

#pragma once

#include <algorithm>
#include <cstdint>

namespace pose_wall::tools::live {

// The fastest frame so far came without a delay. Two crystals of 100 ppm may run apart by kDrift_ppm, and so much later
// may every frame be. Of a silence that forgives kSilence_ns at most, 2 ms: a sensor that restarts or a cable that is
// put back takes seconds, and after a day a frame could be 17 s late unnoticed. Where the drift was more than that,
// frames seem late until the clock is begun anew: it cannot be told from frames that waited in a queue.
class StampClock {
 public:
  struct Placed {
    std::int64_t ns;  // by this process's clock; never after the reception
    bool is_later;    // than the frame before. Where it is not, the clock begins anew with this frame
  };

  // stamp_ns 0: the driver has no stamps, and the reception counts.
  Placed place(std::int64_t stamp_ns, std::int64_t received_ns) {
    if (stamp_ns == 0) return begin(0, received_ns, !has_last_ || received_ns > last_received_ns_);
    if (!has_last_ || stamp_ns <= last_stamp_ns_) return begin(stamp_ns, received_ns, !has_last_);
    // Stamps and receptions are of any size: differences in unsigned numbers wrap and do not overflow.
    const std::int64_t offset_ns = difference(received_ns, stamp_ns);
    const std::int64_t since_ns = std::clamp<std::int64_t>(received_ns - last_received_ns_, 0, kSilence_ns);
    const std::int64_t drift_ns = since_ns / 1'000'000 * kDrift_ppm;
    offset_ns_ = std::min(offset_ns, offset_ns_ + drift_ns);
    last_stamp_ns_ = stamp_ns;
    last_received_ns_ = received_ns;
    return {std::min(difference(stamp_ns, -offset_ns_), received_ns), true};
  }

  static constexpr std::int64_t kDrift_ppm = 200, kSilence_ns = 10'000'000'000;

 private:
  static std::int64_t difference(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
  }
  Placed begin(std::int64_t stamp_ns, std::int64_t received_ns, bool is_later) {
    has_last_ = true;
    last_stamp_ns_ = stamp_ns;
    last_received_ns_ = received_ns;
    offset_ns_ = difference(received_ns, stamp_ns);
    return {received_ns, is_later};
  }

  bool has_last_ = false;
  std::int64_t last_stamp_ns_ = 0, last_received_ns_ = 0, offset_ns_ = 0;
};

}  // namespace pose_wall::tools::live
