// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Makes the checksums of a black box right, as whoever forges one would: they are no signature.

#pragma once

#include "base/math/crc32.hpp"
#include "fuzz/fuzz_target.hpp"
#include "pose_wall_box.h"
#include "runtime/box_layout.hpp"

namespace pose_wall::test {

enum MendedPart : std::uint8_t {
  kMendHeader = 1,
  kMendSizes = 2,
  kMendRecords = 4,
  kMendMementos = 8,
  kMendSyncs = 16
};

inline void mend_header(unsigned char* box) {
  using namespace runtime;
  std::memcpy(box, kBoxMagic, sizeof kBoxMagic);
  put<std::uint32_t>(crc32(box, kAtHeaderCrc), box + kAtHeaderCrc);
}

inline void mend_sizes(unsigned char* box) {
  using namespace runtime;
  put<std::uint32_t>(POSE_WALL_BOX_VERSION, box + kAtVersion);
  put<std::uint32_t>(kHeaderBytes, box + kAtHeaderBytes);
  put<std::uint32_t>(sizeof(pose_wall_config), box + kAtConfigBytes);
  put<std::uint32_t>(sizeof(pose_wall_result), box + kAtResultBytes);
  put<std::uint32_t>(static_cast<std::uint32_t>(pose_wall_memento_bytes()), box + kAtMementoBytes);
  put<std::uint32_t>(POSE_WALL_ABI_VERSION, box + kAtAbi);
  put<std::uint32_t>(sizeof(pose_wall_inputs), box + kAtInputsBytes);
}

inline void mend_memento(unsigned char* memento) {
  std::uint64_t sum = 0xCBF29CE484222325U;
  for (std::uint64_t i = 16; i < pose_wall_memento_bytes(); ++i) sum = (sum ^ memento[i]) * 0x100000001B3U;
  std::memcpy(memento + 8, &sum, sizeof sum);
}

// From the head on, as far as the record says it reaches, or the file does. Returns whether the record fits.
inline void mend_record(const unsigned char* header, unsigned char* head, std::uint64_t room, std::uint8_t parts) {
  using namespace runtime;
  const std::uint64_t fixed = kHeadBytes + body_without_cloud();
  if ((parts & kMendMementos) != 0 && room >= fixed) mend_memento(head + kHeadBytes + kAtMemento);
  if ((parts & kMendSizes) != 0 && room >= fixed) {
    unsigned char* const description = head + kHeadBytes;
    // Of the header's run: others are not computed.
    put<std::uint16_t>(get<std::uint16_t>(header + kAtHeaderRun), head + kAtRun);
    put<std::uint32_t>(get<std::uint32_t>(header + kAtHeaderConfigCrc), description + kAtConfigCrc);
    // Inputs of a size that the engine takes, where there are any.
    unsigned char* const inputs = description + kAtInputs;
    if (get<std::uint32_t>(inputs) != 0) put<std::uint32_t>(sizeof(pose_wall_inputs), inputs);
    const std::uint64_t cloud = get<std::uint64_t>(head + kAtCloudBytes) % (room - fixed + 1) / 64 * 64;
    const std::uint32_t step = get<std::uint32_t>(description + kAtPointBytes) % 48U + 1U;
    const std::uint64_t points = cloud / step;
    put<std::uint32_t>(step, description + kAtPointBytes);
    put<std::uint32_t>(static_cast<std::uint32_t>(points), description + kAtPoints);
    put<std::uint64_t>(points * step, head + kAtCloudBytes);
    put<std::uint64_t>(fixed + aligned(points * step), head + kAtRecordBytes);
  }
  const std::uint64_t bytes = get<std::uint64_t>(head + kAtRecordBytes);
  if (bytes >= kHeadBytes && bytes <= room) {
    put<std::uint32_t>(crc32(head + kHeadBytes, bytes - kHeadBytes), head + kAtBodyCrc);
  }
  put<std::uint32_t>(crc32(head, kAtHeadCrc), head + kAtHeadCrc);
}

inline void mend_box(unsigned char* box, std::uint64_t count, std::uint8_t parts) {
  using namespace runtime;
  if (count < kHeaderBytes) return;
  if ((parts & kMendSizes) != 0) mend_sizes(box);
  if ((parts & kMendHeader) != 0) mend_header(box);
  if ((parts & kMendRecords) == 0) return;
  if ((parts & kMendSyncs) != 0 && count >= kHeaderBytes + kHeadBytes) put(kRecordSync, box + kHeaderBytes);
  for (std::uint64_t at = kHeaderBytes; count - at >= kHeadBytes;) {
    const bool is_head = get<std::uint32_t>(box + at + kAtSync) == kRecordSync;
    if (is_head) mend_record(box, box + at, count - at, parts);
    const std::uint64_t bytes = is_head ? get<std::uint64_t>(box + at + kAtRecordBytes) : 0;
    at += bytes >= kHeadBytes && bytes <= count - at ? aligned(bytes) : kHeadBytes;
    if (at > count) return;
  }
}

}  // namespace pose_wall::test
