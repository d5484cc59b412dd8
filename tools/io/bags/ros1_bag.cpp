// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/ros1_bag.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::string_view kRosbagMagic = "#ROSBAG V2.0\n";

struct RosbagOp {
  enum : std::uint8_t {
    kMessage = 0x02,
    kBagHeader = 0x03,
    kIndexData = 0x04,
    kChunk = 0x05,
    kChunkInfo = 0x06,
    kConnection = 0x07
  };
};

// "name=value" entries, each behind its length.
std::map<std::string_view, ByteCursor> fields_of(ByteCursor header) {
  std::map<std::string_view, ByteCursor> fields;
  while (header.left() > 0) {
    const std::size_t length_bytes = 4;
    const Place place = header.place_at(header.position() + length_bytes);
    const ByteView entry = header.counted_bytes("field of a record's header");
    const std::size_t equals = text_of(entry).find('=');
    if (equals == std::string_view::npos) header.refuse(tr("a field of a record's header has no '='"));
    const Place value{place.offset + equals + 1, place.inside};
    fields.insert_or_assign(text_of(entry).substr(0, equals),
                            ByteCursor({entry.data + equals + 1, entry.size - equals - 1}, value));
  }
  return fields;
}

ByteCursor& required(std::map<std::string_view, ByteCursor>& fields, std::string_view name, const ByteCursor& header) {
  const auto field = fields.find(name);
  if (field == fields.end()) header.refuse(say("the record's header has no field '{}'", name));
  return field->second;
}

template <typename Number>
Number required_number(std::map<std::string_view, ByteCursor>& fields, const char* name, const ByteCursor& header) {
  return required(fields, name, header).number<Number>(name);
}

std::string text_field(std::map<std::string_view, ByteCursor>& fields, std::string_view name,
                       const ByteCursor& header) {
  ByteCursor& field = required(fields, name, header);
  return std::string(text_of(field.bytes(field.left(), name)));
}

}  // namespace

void Ros1Bag::start(ByteCursor& cursor) {
  const std::string_view found = text_of(cursor.bytes(std::min(cursor.left(), kRosbagMagic.size()), "magic"));
  if (found != kRosbagMagic) {
    throw FrameError(say("offset 0: a ROS bag of version 2.0 begins with '#ROSBAG V2.0', this file with '{}'",
                         found.substr(0, found.find('\n'))));
  }
  header_seen_ = false;
  connections_indexed_ = 0;
  chunks_indexed_ = 0;
}

BagRecord Ros1Bag::cut_record(ByteCursor& cursor) const {
  BagRecord record;
  record.offset = cursor.place_at(cursor.position()).offset;
  const auto header_bytes = cursor.number<std::uint32_t>("length of a record's header");
  // Zeros behind a power cut: one fault, and not one for every eight bytes of them.
  if (header_bytes == 0) cursor.refuse(tr("a record without a header: what follows is no record"));
  const Place header_place = cursor.place_at(cursor.position());
  record.header = ByteCursor(cursor.bytes(header_bytes, "a record's header"), header_place);
  const auto data_bytes = cursor.number<std::uint32_t>("length of a record's data");
  const Place data_place = cursor.place_at(cursor.position());
  const std::uint64_t held = std::min<std::uint64_t>(data_bytes, cursor.left());
  record.data = ByteCursor(cursor.bytes(held, "a record's data"), data_place);
  record.missing = data_bytes - held;
  return record;
}

std::optional<BagMessage> Ros1Bag::interpret(BagRecord& record, bool in_chunk) {
  Fields fields = fields_of(record.header);
  const auto op = required_number<std::uint8_t>(fields, "op", record.header);
  if (op != RosbagOp::kChunk) require_whole(record, "record");
  if (!header_seen_ && op != RosbagOp::kBagHeader) record.header.refuse(tr("the first record is no bag header"));
  switch (op) {
    case RosbagOp::kBagHeader:
      note_bag_header(fields);
      break;
    case RosbagOp::kChunk: {
      if (in_chunk) record.header.refuse(tr("a chunk within a chunk"));
      const std::string compression = text_field(fields, "compression", record.header);
      enter_chunk(record, compression, required_number<std::uint32_t>(fields, "size", record.header));
      break;
    }
    case RosbagOp::kConnection:
      note_connection(record, fields, in_chunk);
      break;
    case RosbagOp::kMessage:
      return message_of(record, fields);
    case RosbagOp::kChunkInfo:
      ++chunks_indexed_;
      break;
    default:  // index data, and what later versions may add
      break;
  }
  return std::nullopt;
}

void Ros1Bag::note_bag_header(Fields& fields) {
  const ByteCursor here{ByteView{}};
  index_offset_ = required_number<std::uint64_t>(fields, "index_pos", here);
  connections_announced_ = required_number<std::uint32_t>(fields, "conn_count", here);
  chunks_announced_ = required_number<std::uint32_t>(fields, "chunk_count", here);
  header_seen_ = true;
}

void Ros1Bag::note_connection(const BagRecord& record, Fields& fields, bool in_chunk) {
  if (!in_chunk) ++connections_indexed_;
  const auto connection = required_number<std::uint32_t>(fields, "conn", record.header);
  if (topic_of_connection_.count(connection) != 0) return;
  BagTopic topic;
  topic.name = text_field(fields, "topic", record.header);
  Fields details = fields_of(record.data);
  topic.type = text_field(details, "type", record.data);
  topic.encoding = MessageEncoding::kRos1;
  topic_of_connection_[connection] = topics_.size();
  topics_.push_back(std::move(topic));
}

std::optional<BagMessage> Ros1Bag::message_of(const BagRecord& record, Fields& fields) const {
  const auto connection = required_number<std::uint32_t>(fields, "conn", record.header);
  const auto topic = topic_of_connection_.find(connection);
  if (topic == topic_of_connection_.end()) {
    record.header.refuse(say("a message of connection {}, which no record before it describes", connection));
  }
  ByteCursor& time = required(fields, "time", record.header);
  const auto seconds = time.number<std::uint32_t>("time");
  const auto nanoseconds = time.number<std::uint32_t>("time");
  ByteCursor data = record.data;
  const Place place = data.place_at(0);
  return BagMessage{topic->second, std::int64_t{seconds} * 1'000'000'000 + nanoseconds,
                    data.bytes(data.left(), "message"), place};
}

void Ros1Bag::finish(const ByteCursor& cursor) {
  if (!header_seen_) cursor.refuse(tr("the bag ends before its header"));
  if (index_offset_ == 0) cursor.refuse(tr("the bag has no index: its recorder did not close it"));
  if (connections_indexed_ < connections_announced_ || chunks_indexed_ < chunks_announced_) {
    cursor.refuse(
        say("the file is cut: its header announces {} connections and {} chunks in the index, {} "
            "and {} are there",
            connections_announced_, chunks_announced_, connections_indexed_, chunks_indexed_));
  }
}

}  // namespace pose_wall::tools
