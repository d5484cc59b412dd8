// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/mcap_bag.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "io/bags/crc32.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

struct McapOp {
  enum : std::uint8_t {
    kFooter = 0x02,
    kSchema = 0x03,
    kChannel = 0x04,
    kMessage = 0x05,
    kChunk = 0x06,
    kDataEnd = 0x0F
  };
};

std::string text(ByteCursor& data, std::string_view what) {
  return std::string(text_of(data.counted_bytes(what)));
}

MessageEncoding encoding_of(std::string_view name) {
  if (name == "cdr") return MessageEncoding::kCdr;
  return name == "ros1" ? MessageEncoding::kRos1 : MessageEncoding::kOther;
}

}  // namespace

void McapBag::start(ByteCursor& cursor) {
  if (text_of(cursor.bytes(std::min(cursor.left(), kMcapMagic.size()), "magic")) != kMcapMagic) {
    throw FrameError(tr("offset 0: the file does not begin as an MCAP of version 0 does"));
  }
  footer_seen_ = false;
  data_end_seen_ = false;
}

BagRecord McapBag::cut_record(ByteCursor& cursor) const {
  BagRecord record;
  record.offset = cursor.place_at(cursor.position()).offset;
  record.op = cursor.number<std::uint8_t>("kind of a record");
  const auto bytes = cursor.number<std::uint64_t>("length of a record");
  const Place place = cursor.place_at(cursor.position());
  const std::uint64_t held = std::min<std::uint64_t>(bytes, cursor.left());
  record.data = ByteCursor(cursor.bytes(held, "record"), place);
  record.missing = bytes - held;
  if (record.op == McapOp::kFooter && record.missing == 0) {
    // Only here two ends meet: what follows the footer is no record.
    if (text_of(cursor.bytes(cursor.left(), "magic")) != kMcapMagic) {
      cursor.refuse(tr("the file is cut or goes on behind its footer: the 8 bytes of its magic are to end it"));
    }
  }
  return record;
}

std::optional<BagMessage> McapBag::interpret(BagRecord& record, bool in_chunk) {
  if (record.op != McapOp::kChunk) require_whole(record, "record");
  if (data_end_seen_ && record.op != McapOp::kFooter) return std::nullopt;
  switch (record.op) {
    case McapOp::kSchema:
      note_schema(record.data);
      break;
    case McapOp::kChannel:
      note_channel(record.data);
      break;
    case McapOp::kMessage:
      return message_of(record.data);
    case McapOp::kChunk:
      if (in_chunk) record.data.refuse(tr("a chunk within a chunk"));
      read_chunk(record);
      break;
    case McapOp::kDataEnd:
      data_end_seen_ = true;
      break;
    case McapOp::kFooter:
      footer_seen_ = true;
      break;
    default:  // indexes, attachments, metadata, and what later versions may add
      break;
  }
  return std::nullopt;
}

void McapBag::note_schema(ByteCursor& data) {
  const auto id = data.number<std::uint16_t>("id of a schema");
  schema_names_[id] = text(data, "name of a schema");
}

void McapBag::note_channel(ByteCursor& data) {
  const auto id = data.number<std::uint16_t>("id of a channel");
  if (topic_of_channel_.count(id) != 0) return;
  const auto schema = data.number<std::uint16_t>("schema of a channel");
  BagTopic topic;
  topic.name = text(data, "topic of a channel");
  topic.encoding = encoding_of(text(data, "encoding of a channel"));
  const auto name = schema_names_.find(schema);
  if (name != schema_names_.end()) {
    topic.type = name->second;
  } else if (schema != 0) {
    data.refuse(say("channel {} names schema {}, which no record before it describes", id, schema));
  }
  topic_of_channel_[id] = topics_.size();
  topics_.push_back(std::move(topic));
}

void McapBag::read_chunk(BagRecord& record) {
  ByteCursor& data = record.data;
  data.bytes(16, "times of a chunk");
  const auto size = data.number<std::uint64_t>("size of a chunk");
  const auto crc = data.number<std::uint32_t>("checksum of a chunk");
  const std::string compression = text(data, "compression of a chunk");
  const auto stored = data.number<std::uint64_t>("length of a chunk's records");
  if (stored != data.left() + record.missing) {
    data.refuse(
        say("a chunk's records are said to take {} bytes, its record holds {}", stored, data.left() + record.missing));
  }
  enter_chunk(record, compression, size);
  if (crc == 0 || record.missing > 0) return;
  const std::uint32_t found = crc32(chunk_content());
  if (found != crc) {
    leave_chunk();
    throw FrameError(say("offset {}: the chunk's checksum is {:08x}, its content has {:08x}: it was damaged",
                         record.offset, crc, found));
  }
}

BagMessage McapBag::message_of(ByteCursor& data) {
  const auto channel = data.number<std::uint16_t>("channel of a message");
  const auto topic = topic_of_channel_.find(channel);
  if (topic == topic_of_channel_.end()) {
    data.refuse(say("a message of channel {}, which no record before it describes", channel));
  }
  data.bytes(sizeof(std::uint32_t), "sequence of a message");
  const auto recorded_ns = data.number<std::uint64_t>("log time of a message");
  data.bytes(sizeof(std::uint64_t), "publish time of a message");
  const Place place = data.place_at(data.position());
  // A time beyond the year 2262 is no stamp: the clouds carry their own.
  const auto bounded_ns = std::min<std::uint64_t>(recorded_ns, std::numeric_limits<std::int64_t>::max());
  BagMessage message{topic->second, static_cast<std::int64_t>(bounded_ns), data.bytes(data.left(), "message"), place};
  packed_.unpack(topics_[topic->second], &message);
  return message;
}

void McapBag::finish(const ByteCursor& cursor) {
  if (!footer_seen_) cursor.refuse(tr("the file ends without a footer: it was cut, or its recorder did not close it"));
}

}  // namespace pose_wall::tools
