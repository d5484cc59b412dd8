// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What ROS 1 bags and MCAP share: records one behind the other, some of them chunks that hold further records, maybe
// compressed.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/bags/bag_reader.hpp"
#include "io/box/mapped_file.hpp"

namespace pose_wall::tools {

// A record as its own lengths cut it out.
struct BagRecord {
  std::uint8_t op = 0;
  std::uint64_t offset = 0;  // of the record
  ByteCursor header{ByteView{}};
  ByteCursor data{ByteView{}};
  std::uint64_t missing = 0;  // bytes of the data beyond the end
};

class RecordReader : public BagReader {
 public:
  // Throws std::runtime_error that names the file.
  explicit RecordReader(const std::string& path);

  std::optional<BagMessage> next() final;
  void rewind() final;
  const std::vector<BagTopic>& topics() const final { return topics_; }

 protected:
  // Checks what stands before the first record; an earlier walk is forgotten, its topics are not.
  virtual void start(ByteCursor& cursor) = 0;

  // Throws FrameError when the lengths of the record lead nowhere: nothing can follow then.
  virtual BagRecord cut_record(ByteCursor& cursor) const = 0;

  // Gives a message; everything else is noted. Throws FrameError: what lies behind the record, or behind the chunk that
  // it is in, is still read.
  virtual std::optional<BagMessage> interpret(BagRecord& record, bool in_chunk) = 0;

  // Behind the last record: throws FrameError when it is not the end of the recording.
  virtual void finish(const ByteCursor& cursor) = 0;

  // For `interpret`: the records of a chunk come next. A torn one can only be entered when it is not compressed.
  void enter_chunk(const BagRecord& record, std::string_view compression, std::uint64_t size);
  const ByteView& chunk_content() const { return chunk_content_; }
  void leave_chunk();

  // Throws FrameError when a part of the record lies beyond the end.
  static void require_whole(const BagRecord& record, std::string_view what);

  std::vector<BagTopic> topics_;

 private:
  std::optional<BagMessage> next_record();

  MappedFile file_;
  ByteCursor cursor_;
  bool started_ = false;
  bool ended_ = false;
  Bytes decompressed_;
  ByteView chunk_content_;
  std::optional<ByteCursor> chunk_;
  std::string torn_chunk_;  // what to say when the rest of a torn chunk is read
};

}  // namespace pose_wall::tools
