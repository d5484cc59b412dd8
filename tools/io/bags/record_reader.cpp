// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/record_reader.hpp"

#include <fmt/format.h>

#include <utility>

#include "io/bags/decompress.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

ByteView view_of(const MappedFile& file) {
  return {static_cast<const std::byte*>(file.data()), static_cast<std::size_t>(file.size())};
}

}  // namespace

RecordReader::RecordReader(const std::string& path) : file_(path), cursor_(view_of(file_)) {}

void RecordReader::rewind() {
  cursor_ = ByteCursor(view_of(file_));
  started_ = false;
  ended_ = false;
  torn_chunk_.clear();
  leave_chunk();
}

void RecordReader::leave_chunk() {
  chunk_.reset();
  decompressed_.clear();
}

void RecordReader::require_whole(const BagRecord& record, std::string_view what) {
  if (record.missing == 0) return;
  throw FrameError(
      say("offset {}: the file is cut: {} bytes of this {} are missing", record.offset, record.missing, what));
}

void RecordReader::enter_chunk(const BagRecord& record, std::string_view compression, std::uint64_t size) {
  ByteCursor rest = record.data;
  const Place place = rest.place_at(rest.position());
  const ByteView stored = rest.bytes(rest.left(), "chunk");
  const bool plain = compression.empty() || compression == "none";
  if (!plain) require_whole(record, "chunk");
  if (plain && stored.size + record.missing != size) {
    record.data.refuse(
        say("the chunk announces {} bytes and stores {} without compression", size, stored.size + record.missing));
  }
  if (plain) {
    chunk_content_ = stored;
    chunk_.emplace(stored, place);
    if (record.missing > 0) {
      torn_chunk_ =
          say("offset {}: the file is cut: {} bytes of this chunk are missing", record.offset, record.missing);
    }
    return;
  }
  try {
    decompressed_ = decompress(compression, stored, size);
  } catch (const FrameError& fault) {
    throw FrameError(say("offset {}: chunk: {}", record.offset, fault.what()));
  }
  chunk_content_ = {decompressed_.data(), decompressed_.size()};
  chunk_.emplace(chunk_content_, Place{0, say("chunk at offset {}", record.offset)});
}

std::optional<BagMessage> RecordReader::next_record() {
  const bool in_chunk = chunk_.has_value();
  BagRecord record;
  try {
    record = cut_record(in_chunk ? *chunk_ : cursor_);
    if (in_chunk) require_whole(record, "record");
  } catch (const FrameError&) {
    leave_chunk();
    ended_ = ended_ || !in_chunk || !torn_chunk_.empty();
    torn_chunk_.clear();
    throw;
  }
  if (record.missing > 0) ended_ = true;
  try {
    return interpret(record, in_chunk);
  } catch (const FrameError&) {
    if (in_chunk) leave_chunk();  // one fault for a damaged chunk, not one for each of its records
    throw;
  }
}

std::optional<BagMessage> RecordReader::next() {
  if (!started_) {
    started_ = true;
    try {
      start(cursor_);
    } catch (const FrameError&) {
      ended_ = true;
      throw;
    }
  }
  while (true) {
    if (chunk_ && chunk_->left() == 0) leave_chunk();
    if (!chunk_ && !torn_chunk_.empty()) throw FrameError(std::exchange(torn_chunk_, ""));
    if (!chunk_ && ended_) return std::nullopt;
    if (!chunk_ && cursor_.left() == 0) {
      ended_ = true;
      finish(cursor_);
      return std::nullopt;
    }
    if (std::optional<BagMessage> message = next_record()) return message;
  }
}

}  // namespace pose_wall::tools
