// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// ROS 1 bags, format 2.0. Read in the order of the file and without the index at its end: a bag that was cut, or whose
// recorder crashed, has none.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "io/bags/record_reader.hpp"

namespace pose_wall::tools {

class Ros1Bag : public RecordReader {
 public:
  explicit Ros1Bag(const std::string& path) : RecordReader(path) {}

 protected:
  void start(ByteCursor& cursor) override;
  BagRecord cut_record(ByteCursor& cursor) const override;
  std::optional<BagMessage> interpret(BagRecord& record, bool in_chunk) override;
  void finish(const ByteCursor& cursor) override;

 private:
  using Fields = std::map<std::string_view, ByteCursor>;

  void note_bag_header(Fields& fields);
  void note_connection(const BagRecord& record, Fields& fields, bool in_chunk);
  std::optional<BagMessage> message_of(const BagRecord& record, Fields& fields) const;

  std::map<std::uint32_t, std::size_t> topic_of_connection_;
  bool header_seen_ = false;
  std::uint64_t index_offset_ = 0;
  std::uint32_t connections_announced_ = 0, connections_indexed_ = 0;
  std::uint32_t chunks_announced_ = 0, chunks_indexed_ = 0;
};

}  // namespace pose_wall::tools
