// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Writes records into the ring, one after the other, by the caller's sink.

#pragma once

#include <cstdint>

#include "frame_slot.hpp"
#include "pose_wall_runtime.h"

namespace pose_wall::runtime {

class BoxWriter {
 public:
  // In the block of pose_wall_runtime_open: room for the parts of a record that are put together in memory.
  static std::uint64_t scratch_bytes();
  // The ring must hold at least this much.
  static std::uint64_t box_bytes_min(std::uint64_t cloud_bytes_max);

  void open(const pose_wall_runtime_options& options, unsigned char* scratch);

  // Writes the header; the ring starts anew. `run`, never 0, separates this start's records from those of others.
  // False: the sink failed.
  bool begin(const pose_wall_config& config, std::uint16_t run);

  // False: the sink failed; the next record takes the same place. Before the first header none is written.
  bool write(const FrameSlot& slot);

  std::uint64_t bytes_written() const { return bytes_written_; }

 private:
  void fill_body(const FrameSlot& slot, unsigned char* body) const;
  void fill_head(const FrameSlot& slot, std::uint64_t record_bytes, std::uint64_t cloud_bytes, std::uint32_t body_crc,
                 unsigned char* head) const;
  bool sink(std::uint64_t offset, const void* bytes, std::uint64_t count);

  pose_wall_runtime_sink sink_ = nullptr;
  void* sink_user_ = nullptr;
  std::uint64_t box_bytes_ = 0;
  bool with_clouds_ = true;
  bool begun_ = false;
  unsigned char* scratch_ = nullptr;
  std::uint64_t at_ = 0;
  std::uint32_t config_crc32_ = 0;
  std::uint16_t run_ = 0;
  std::uint16_t lap_ = 0;
  std::uint64_t bytes_written_ = 0;
};

}  // namespace pose_wall::runtime
