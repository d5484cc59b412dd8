// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Ouster sensors: packets of columns, which metadata describes.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "packets/ouster_metadata.hpp"
#include "packets/scan.hpp"

namespace pose_wall::tools {

// Frames by the number that the sensor gives them; a column that did not come has no returns. Points in the sensor's
// frame, x towards the front. Of two returns the first is taken. Stamps are the sensor's own. Metadata of another
// lidar_mode than the packets' is a contradiction, told by the sensor's clock: then add() throws, from there on always.
class OusterAssembler : public ScanAssembler {
 public:
  explicit OusterAssembler(OusterMetadata metadata);

  bool add(const Datagram& datagram) override;
  void finish() override;
  const char* kind() const override { return kind_.c_str(); }
  bool stamps_are_of_arrival() const override { return false; }
  std::string hint() const override { return hint_; }

  std::size_t packet_bytes() const { return packet_bytes(metadata_.rings); }

 private:
  struct Layout {
    std::size_t packet_head, column_head, pixel, column_tail, packet_tail;
  };

  static Layout layout_of(OusterProfile profile);
  void add_column(ByteCursor column, std::uint32_t frame);
  void add_pixel(ByteView pixel, std::uint32_t ring, std::uint32_t column, std::uint64_t time_ns);
  void check_mode(std::uint32_t next_frame, std::uint32_t next_index, std::uint64_t next_time_ns);
  void end_frame();
  std::size_t packet_bytes(std::uint32_t rings) const;
  void look_for_other_pixels(std::size_t bytes);

  OusterMetadata metadata_;
  Layout layout_;
  std::string kind_;
  std::optional<std::uint32_t> frame_;
  std::optional<std::uint32_t> sensor_;
  std::string hint_, contradiction_;
  Scan scan_;
  struct Column {
    std::uint32_t index = 0;
    std::uint64_t time_ns = 0;
  };
  Column first_, last_;        // of the frame, so far
  std::uint32_t columns_ = 0;  // of the frame, that came
};

}  // namespace pose_wall::tools
