// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Writes MCAP (version 0, uncompressed) so that whatever ends the program leaves a readable file: what was written is
// readable up to the last whole chunk, also by tools of others.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools::live {

struct McapChannel {
  std::string topic;
  std::string message_encoding;                           // "json", "cdr"
  std::string schema_name, schema_encoding, schema_text;  // "sensor_msgs/msg/PointCloud2", "ros2msg"
};

class McapWriter {
 public:
  // Opens a new file and writes its head. A message's channel is its place in the list. Throws std::system_error that
  // names the file; so do the others, when the disk is full or the file was moved away. Then the file stays as it was;
  // one that holds no message yet is deleted.
  McapWriter(const std::string& path, const std::vector<McapChannel>& channels);
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;
  // Closes without a summary, as a loss of power would; deletes what holds no chunk.
  ~McapWriter();

  void add(std::uint16_t channel, std::uint64_t time_ns, std::string_view message);
  // Writes what was gathered as a chunk, and has the disk take it.
  void flush();
  // The rest, and the summary by which readers find their way.
  void finish();

  std::uint64_t bytes() const { return bytes_; }  // of the file
  std::uint64_t gathered_bytes() const { return chunk_.size(); }
  // Of the file, were it finished now.
  std::uint64_t finished_bytes() const;
  const std::string& path() const { return path_; }
  std::uint64_t messages() const { return messages_; }

 private:
  struct Chunk {
    std::uint64_t first_ns, last_ns, offset, bytes, content_bytes;
    std::vector<std::uint64_t> index_at;  // by channel; 0: none of its messages is in the chunk
    std::uint64_t index_bytes;
  };
  struct Entry {
    std::uint64_t time_ns, offset;  // of a message, in the content of its chunk
  };

  void write(std::string_view bytes);
  void require_in_place() const;
  bool is_in_place() const;
  void close_file();
  std::string index_of(std::size_t channel) const;
  std::string summary() const;

  std::string path_;
  int file_ = -1;
  std::string descriptions_;  // schemas and channels, which the summary repeats
  std::string chunk_;
  std::uint64_t chunk_first_ns_ = 0, chunk_last_ns_ = 0;
  std::vector<std::vector<Entry>> index_;  // of the chunk that is gathered, by channel
  std::vector<Chunk> chunks_;
  std::vector<std::uint64_t> messages_of_;  // by channel
  std::uint64_t bytes_ = 0, messages_ = 0;
};

}  // namespace pose_wall::tools::live
