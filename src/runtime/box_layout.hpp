// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Where everything lies in a black box; the picture is in pose_wall_box.h. Writer and reader use these alone.

#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "pose_wall_box.h"

namespace pose_wall::runtime {

// The format of pose_wall_box.h, from the start of the file:
constexpr std::uint64_t kBoxAlignment = 64;
constexpr std::uint64_t kHeaderBytes = POSE_WALL_BOX_HEADER_BYTES;
constexpr std::uint32_t kRecordSync = 0x43525750U;  // the letters "PWRC"
constexpr char kBoxMagic[8] = {'P', 'W', 'A', 'L', 'L', 'B', 'O', 'X'};

// The header, in bytes from its start:
constexpr std::uint32_t kAtVersion = 8, kAtHeaderBytes = 12, kAtBoxBytes = 16, kAtConfigBytes = 24, kAtResultBytes = 28,
                        kAtMementoBytes = 32, kAtAbi = 36, kAtLibrary = 40, kAtConfig = 64, kAtMotionBytes = 4076,
                        kAtInputsBytes = 4080, kAtHeaderRun = 4084, kAtHeaderConfigCrc = 4088, kAtHeaderCrc = 4092,
                        kLibraryBytes = 24;
static_assert(kAtConfig + sizeof(pose_wall_config) <= kAtMotionBytes, "the config fits the header");

// The head of a record.
constexpr std::uint32_t kAtSync = 0, kAtKind = 4, kAtRecordBytes = 8, kAtSequence = 16, kAtReceived = 24, kAtStamp = 32,
                        kAtCloudBytes = 40, kAtThinning = 48, kAtBodyCrc = 52, kAtRun = 56, kAtLap = 58,
                        kAtHeadCrc = 60;
constexpr std::uint64_t kHeadBytes = 64;  // one line of a cache

// The cloud's description, from the end of the head.
constexpr std::uint32_t kAtDigest = 0, kAtPoints = 8, kAtPointBytes = 12, kAtBigEndian = 16, kAtNotFinite = 20,
                        kAtZero = 24, kAtConfigCrc = 28, kAtFields = 32;
constexpr std::uint64_t kDescriptionBytes = 128;  // behind it there is room for more fields

constexpr std::uint64_t aligned(std::uint64_t bytes) {
  return (bytes + kBoxAlignment - 1) & ~(kBoxAlignment - 1);
}

inline std::uint64_t memento_room() {
  return aligned(pose_wall_memento_bytes());
}
// Of what has a size of its own, in whole steps of the alignment:
constexpr std::uint64_t kInputsRoom = aligned(sizeof(pose_wall_inputs));
constexpr std::uint64_t kResultRoom = aligned(sizeof(pose_wall_result));
constexpr std::uint64_t kMotionRoom = aligned(sizeof(pose_wall_motion_result));

// Behind the cloud's description.
constexpr std::uint64_t kAtInputs = kDescriptionBytes, kAtMemento = kAtInputs + kInputsRoom;
inline std::uint64_t at_result() {
  return kAtMemento + memento_room();
}

inline std::uint64_t at_motion() {
  return at_result() + kResultRoom;
}

inline std::uint64_t body_without_cloud() {
  return at_motion() + kMotionRoom;
}

// The machines that record are little-endian; pose_wall_runtime_open refuses a sink on others.
template <typename T>
void put(T value, unsigned char* to) {
  std::memcpy(to, &value, sizeof(value));
}
template <typename T>
T get(const unsigned char* from) {
  T value;
  std::memcpy(&value, from, sizeof(value));
  return value;
}

// What a build writes into its header, and asks of one that it reads.
struct HeaderWord {
  std::uint32_t at, word;
};
inline std::array<HeaderWord, 8> header_words() {
  return {{{kAtVersion, POSE_WALL_BOX_VERSION},
           {kAtHeaderBytes, kHeaderBytes},
           {kAtConfigBytes, sizeof(pose_wall_config)},
           {kAtResultBytes, sizeof(pose_wall_result)},
           {kAtMementoBytes, static_cast<std::uint32_t>(pose_wall_memento_bytes())},
           {kAtAbi, POSE_WALL_ABI_VERSION},
           {kAtInputsBytes, sizeof(pose_wall_inputs)},
           {kAtMotionBytes, sizeof(pose_wall_motion_result)}}};
}

}  // namespace pose_wall::runtime
