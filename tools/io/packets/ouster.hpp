// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Ouster sensors: packets of columns, which metadata describes.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/packets/ouster_metadata.hpp"
#include "io/packets/scan.hpp"

namespace pose_wall::tools {

// Frames by the number that the sensor gives them; a column that did not come has no returns. Points in the sensor's
// frame, x towards the front. Stamps are the sensor's own: the time of the first column. A frame is open until the
// next one is well begun, so that a packet that comes late at its end belongs to it; what comes later is dropped.
// Packets of another serial number than the metadata's are not those of this sensor: hint() tells both numbers.
// Metadata of another lidar_mode than the packets' is a contradiction, told by the sensor's clock: then add() throws,
// from there on always.
class OusterAssembler : public ScanAssembler {
 public:
  explicit OusterAssembler(OusterMetadata metadata);

  bool add(const Datagram& datagram) override;
  void finish() override;
  const char* kind() const override { return kind_.c_str(); }
  bool stamps_are_of_arrival() const override { return false; }
  std::string hint() const override { return hint_; }

  std::size_t packet_bytes() const;
  // Packets of frames that were handed on before, and what came twice.
  std::size_t dropped_packets() const { return dropped_packets_; }

 private:
  struct Turn {
    std::uint32_t number = 0;  // as the sensor counts frames
    std::uint32_t columns = 0;
    std::vector<std::optional<std::uint64_t>> times_ns;  // of columns; nothing: did not come
    Scan scan;
  };

  bool is_of_this_sensor(ByteView packet, OusterHead* head);
  void explain_size(std::size_t bytes);
  bool add_column(ByteView bytes, std::uint32_t frame);
  Turn* turn_of(std::uint32_t frame, std::uint32_t index, std::uint64_t time_ns);
  Turn new_turn(std::uint32_t frame) const;
  void add_pixel(ByteView pixel, std::uint32_t ring, std::uint32_t column, Turn& turn) const;
  void check_mode(std::uint32_t next_frame, std::uint32_t next_index, std::uint64_t next_time_ns);
  bool is_whole(const Turn& turn) const;
  bool is_complete(const Turn& turn);
  void settle();
  void end_current();
  void end_all();
  std::uint32_t ahead_of(std::uint32_t reference, std::uint32_t frame) const {
    return (frame - reference) & last_number_;
  }

  OusterMetadata metadata_;
  std::uint32_t last_number_;  // of frames, before they begin anew with 0
  std::string kind_;
  bool is_heard_ = false;
  std::string hint_, contradiction_;
  std::optional<Turn> current_, next_;
  std::optional<std::uint32_t> ended_;    // the number of the turn that was handed on last
  std::optional<std::uint32_t> session_;  // of the packets
  bool mode_is_known_ = false;            // the sensor's clock has confirmed the number of columns
  std::vector<bool> shown_;               // columns that turns have had so far
  std::uint32_t columns_before_ = 0;      // of the turn before
  std::size_t dropped_packets_ = 0;
};

}  // namespace pose_wall::tools
