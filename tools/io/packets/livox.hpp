// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Livox' sensors of SDK 2: packets of points, which have no turn; frames are cut by the sensor's time. All of them send
// alike, and no packet names its model.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/packets/scan.hpp"

namespace pose_wall::tools {

constexpr std::int64_t kLivoxFrame_ns = 100'000'000;
constexpr std::uint16_t kLivoxHostPort = 56301, kLivoxHapPort = 57000;  // to which data goes, as SDK 2 sets it

enum class LivoxModel { kMid360, kMid360s, kHap, kAvia2 };

// 36 bytes of head and as many points as it says, of data type 0x01 (cartesian, mm), 0x02 (cartesian, cm), 0x03
// (spherical) or 0x11 (cartesian, mm, two returns).
bool is_livox_data(ByteView payload);

// Of such data: whether each point has two returns.
bool is_livox_dual(ByteView payload);

// Points of a data type, or of a size, that is not read: "a Livox, data type 0x04 ..."; else "".
std::string unread_livox(ByteView payload);

// What the ports leave possible: "Livox HAP", "Livox Mid-360, Mid-360S or Avia 2", or all.
const char* livox_title(const Sender& from);

// Points in the sensor's frame as its manual draws it: x to the front, y to the left, z up. Stamps are the sensor's
// own. Of two returns the farther one is taken. Rings are the lines in which Livox' driver numbers the points, where
// the model is known; else 0. None of these sensors has rings: the engine takes so few for lines of a pattern.
class LivoxAssembler : public ScanAssembler {
 public:
  // A frame holds packets of `frame_ns`. `model`: as the user names it. Throws FrameError unless that is 1 ms to 10 s.
  explicit LivoxAssembler(std::optional<LivoxModel> model = std::nullopt, std::int64_t frame_ns = kLivoxFrame_ns);

  // Throws FrameError where packets leave from a port that the named model does not have.
  bool add(const Datagram& datagram) override;
  void finish() override;
  const char* kind() const override { return kind_.c_str(); }
  bool stamps_are_of_arrival() const override { return false; }

 private:
  void begin(const Sender& from);
  void add_points(ByteView payload, std::int64_t time_ns);
  void end_frame(bool is_complete);

  std::optional<LivoxModel> model_;
  std::int64_t frame_ns_;
  std::string kind_;
  std::uint32_t lines_ = 0;  // 0: no packet yet
  Scan scan_;
  std::int64_t last_ns_ = 0;  // of the packet added last
};

}  // namespace pose_wall::tools
