// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// MCAP, the container of ROS 2. Read in the order of the file up to the end of its data; the summary behind it, which a
// cut file lacks, is passed over.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "io/bags/packed_message.hpp"
#include "io/bags/record_reader.hpp"

namespace pose_wall::tools {

class McapBag : public RecordReader {
 public:
  explicit McapBag(const std::string& path) : RecordReader(path) {}

 protected:
  void start(ByteCursor& cursor) override;
  BagRecord cut_record(ByteCursor& cursor) const override;
  std::optional<BagMessage> interpret(BagRecord& record, bool in_chunk) override;
  void finish(const ByteCursor& cursor) override;

 private:
  void note_schema(ByteCursor& data);
  void note_channel(ByteCursor& data);
  void read_chunk(BagRecord& record);
  BagMessage message_of(ByteCursor& data);

  PackedMessage packed_;
  std::map<std::uint16_t, std::string> schema_names_;
  std::map<std::uint16_t, std::size_t> topic_of_channel_;
  bool footer_seen_ = false;
  bool data_end_seen_ = false;
};

}  // namespace pose_wall::tools
