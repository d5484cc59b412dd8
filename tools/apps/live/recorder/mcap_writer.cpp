// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/recorder/mcap_writer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "io/bags/crc32.hpp"

namespace pose_wall::tools::live {
namespace {

// https://mcap.dev/spec, version 0.
constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
enum Kind : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kDataEnd = 0x0F
};

class Record {
 public:
  template <typename Number>
  Record& number(Number number) {
    for (std::size_t i = 0; i < sizeof number; ++i) {
      bytes_.push_back(static_cast<char>((static_cast<std::uint64_t>(number) >> (8U * i)) & 0xFFU));
    }
    return *this;
  }
  Record& text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    return raw(text);
  }
  Record& raw(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }
  std::string as(Kind kind) const {
    return Record().number(static_cast<std::uint8_t>(kind)).number(std::uint64_t{bytes_.size()}).raw(bytes_).bytes_;
  }

 private:
  std::string bytes_;
};

constexpr std::uint64_t kRecordHead = 9, kMagicBytes = 8;
// Kind and length, then what each holds.
constexpr std::uint64_t kChunkHead = kRecordHead + 40, kChunkIndexBytes = kRecordHead + 64;
constexpr std::uint64_t kIndexHead = kRecordHead + 6, kEntryBytes = 16, kIndexOffsetBytes = 10;
constexpr std::uint64_t kDataEndBytes = kRecordHead + 4, kFooterBytes = kRecordHead + 20;

[[noreturn]] void refuse(int why, const std::string& path) {
  throw std::system_error(why, std::generic_category(), path);
}

}  // namespace

McapWriter::McapWriter(const std::string& path, const std::vector<McapChannel>& channels)
    : path_(path),
      file_(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR | S_IRGRP)),
      index_(channels.size()),
      messages_of_(channels.size(), 0) {
  if (file_ < 0) refuse(errno, path);
  for (std::uint16_t i = 0; i < channels.size(); ++i) {
    const McapChannel& c = channels[i];
    const auto schema = static_cast<std::uint16_t>(i + 1);  // 0 would be none
    descriptions_ +=
        Record().number(schema).text(c.schema_name).text(c.schema_encoding).text(c.schema_text).as(kSchema);
    descriptions_ +=
        Record().number(i).number(schema).text(c.topic).text(c.message_encoding).number(std::uint32_t{0}).as(kChannel);
  }
  try {
    write(std::string(kMagic) + Record().text("").text("pose_walld").as(kHeader) + descriptions_);
  } catch (...) {  // there will be no destructor
    close_file();
    throw;
  }
}

McapWriter::~McapWriter() {
  close_file();
}

// A disk that is full for days is tried every few seconds: empty files must not pile up.
void McapWriter::close_file() {
  if (chunks_.empty() && is_in_place()) unlink(path_.c_str());
  close(file_);
}

// What was deleted or moved away takes bytes as before, and nobody would find them.
bool McapWriter::is_in_place() const {
  struct stat named {
  }, held{};
  return stat(path_.c_str(), &named) == 0 && fstat(file_, &held) == 0 && named.st_ino == held.st_ino &&
         named.st_dev == held.st_dev;
}

void McapWriter::require_in_place() const {
  if (!is_in_place()) refuse(ENOENT, path_);
}

void McapWriter::write(std::string_view bytes) {
  std::uint64_t at = bytes_;
  while (!bytes.empty()) {
    const ssize_t written = pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int why = written < 0 ? errno : ENOSPC;
      // Half a chunk is no record: the file ends where it ended before.
      static_cast<void>(!ftruncate(file_, static_cast<off_t>(bytes_)));
      refuse(why, path_);
    }
    at += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  bytes_ = at;
}

void McapWriter::add(std::uint16_t channel, std::uint64_t time_ns, std::string_view message) {
  if (chunk_.empty()) chunk_first_ns_ = chunk_last_ns_ = time_ns;
  chunk_first_ns_ = std::min(chunk_first_ns_, time_ns);
  chunk_last_ns_ = std::max(chunk_last_ns_, time_ns);
  index_[channel].push_back({time_ns, chunk_.size()});
  const auto sequence = static_cast<std::uint32_t>(messages_of_[channel]++);
  chunk_ += Record().number(channel).number(sequence).number(time_ns).number(time_ns).raw(message).as(kMessage);
  ++messages_;
}

// Readers that do not go through the whole file (those of JavaScript, which Foxglove has) find messages by these alone.
// Empty where the chunk holds no message of the channel.
std::string McapWriter::index_of(std::size_t channel) const {
  if (index_[channel].empty()) return "";
  Record record;
  record.number(static_cast<std::uint16_t>(channel));
  record.number(static_cast<std::uint32_t>(kEntryBytes * index_[channel].size()));
  for (const Entry& entry : index_[channel]) record.number(entry.time_ns).number(entry.offset);
  return record.as(kMessageIndex);
}

void McapWriter::flush() {
  if (chunk_.empty()) return;
  const ByteView content{reinterpret_cast<const std::byte*>(chunk_.data()), chunk_.size()};
  const std::string record = Record()
                                 .number(chunk_first_ns_)
                                 .number(chunk_last_ns_)
                                 .number(std::uint64_t{chunk_.size()})
                                 .number(crc32(content))
                                 .text("")
                                 .number(std::uint64_t{chunk_.size()})
                                 .raw(chunk_)
                                 .as(kChunk);
  require_in_place();
  Chunk chunk{chunk_first_ns_, chunk_last_ns_, bytes_, record.size(), chunk_.size(), {}, 0};
  std::string indexes;
  for (std::size_t channel = 0; channel < index_.size(); ++channel) {
    const bool is_there = !index_[channel].empty();
    chunk.index_at.push_back(is_there ? bytes_ + record.size() + indexes.size() : 0);
    indexes += index_of(channel);
    index_[channel].clear();
  }
  chunk.index_bytes = indexes.size();
  chunk_.clear();
  write(record + indexes);
  chunks_.push_back(std::move(chunk));
  if (fdatasync(file_) != 0) refuse(errno, path_);
}

std::uint64_t McapWriter::finished_bytes() const {
  std::uint64_t chunk = chunk_.empty() ? 0 : kChunkHead + chunk_.size() + kChunkIndexBytes;
  for (const std::vector<Entry>& entries : index_) {
    if (!entries.empty()) chunk += kIndexHead + kEntryBytes * entries.size() + kIndexOffsetBytes;
  }
  return bytes_ + chunk + kDataEndBytes + summary().size() + kFooterBytes + kMagicBytes;
}

std::string McapWriter::summary() const {
  std::string records = descriptions_;
  std::uint64_t first_ns = chunks_.empty() ? 0 : chunks_.front().first_ns, last_ns = 0;
  for (const Chunk& c : chunks_) {
    first_ns = std::min(first_ns, c.first_ns);
    last_ns = std::max(last_ns, c.last_ns);
    Record offsets;
    for (std::uint16_t channel = 0; channel < c.index_at.size(); ++channel) {
      if (c.index_at[channel] != 0) offsets.number(channel).number(c.index_at[channel]);
    }
    records += Record()
                   .number(c.first_ns)
                   .number(c.last_ns)
                   .number(c.offset)
                   .number(c.bytes)
                   .text(offsets.bytes())
                   .number(c.index_bytes)
                   .text("")
                   .number(c.content_bytes)
                   .number(c.content_bytes)
                   .as(kChunkIndex);
  }
  const auto channels = static_cast<std::uint32_t>(messages_of_.size());
  Record statistics;
  statistics.number(messages_).number(static_cast<std::uint16_t>(channels)).number(channels);
  statistics.number(std::uint32_t{0}).number(std::uint32_t{0}).number(static_cast<std::uint32_t>(chunks_.size()));
  statistics.number(first_ns).number(last_ns).number(10 * channels);
  for (std::uint16_t i = 0; i < channels; ++i) statistics.number(i).number(messages_of_[i]);
  return records + statistics.as(kStatistics);
}

void McapWriter::finish() {
  flush();
  const std::string data_end = Record().number(std::uint32_t{0}).as(kDataEnd);
  const std::uint64_t summary_at = bytes_ + data_end.size();
  write(data_end + summary() +
        Record().number(summary_at).number(std::uint64_t{0}).number(std::uint32_t{0}).as(kFooter) +
        std::string(kMagic));
  static_cast<void>(fdatasync(file_));
}

}  // namespace pose_wall::tools::live
