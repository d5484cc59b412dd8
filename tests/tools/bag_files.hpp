// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Bags written by hand, from the descriptions of their formats and not by the readers' own code: ROS 1 bags, MCAP, and
// clouds as messages of either.

#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#if POSE_WALL_HAS_SQLITE
#include <sqlite3.h>
#endif

#include "test_files.hpp"

namespace pose_wall::tools::test {

inline std::string with_length(const std::string& text) {
  return raw(static_cast<std::uint32_t>(text.size())) + text;
}

// A cloud of x y z float32 and ring uint16, 16 bytes a point.
struct CloudMessage {
  std::uint32_t sec = 1700000000, nsec = 0;
  std::uint32_t height = 1, width = 2;
  std::uint32_t row_step = 0;     // 0: width * point_step
  std::uint32_t point_step = 16;  // another one needs data
  bool big_endian_data = false;
  std::string data;  // empty: points (i, 2, 3)
  std::vector<std::string> names = {"x", "y", "z", "ring"};
  std::vector<std::uint8_t> types = {7, 7, 7, 4};
  std::vector<std::uint32_t> offsets = {0, 4, 8, 12};
  std::string frame_id = "lidar";

  std::uint32_t rows_step() const { return row_step != 0 ? row_step : width * point_step; }
  std::string bytes() const {
    if (!data.empty()) return data;
    std::string points;
    for (std::uint32_t row = 0; row < height; ++row) {
      std::string one;
      for (std::uint32_t i = 0; i < width; ++i) {
        one += raw(static_cast<float>(row * width + i) + static_cast<float>(nsec), big_endian_data) +
               raw(2.0F, big_endian_data) + raw(3.0F, big_endian_data) + raw(std::uint16_t(i), big_endian_data) + "--";
      }
      one.resize(rows_step(), '#');
      points += one;
    }
    return points;
  }
};

inline std::string ros1_message(const CloudMessage& cloud) {
  std::string text = raw(std::uint32_t{9}) + raw(cloud.sec) + raw(cloud.nsec) + with_length(cloud.frame_id) +
                     raw(cloud.height) + raw(cloud.width) + raw(static_cast<std::uint32_t>(cloud.names.size()));
  for (std::size_t i = 0; i < cloud.names.size(); ++i) {
    text += with_length(cloud.names[i]) + raw(cloud.offsets[i]) + raw(cloud.types[i]) + raw(std::uint32_t{1});
  }
  return text + raw(std::uint8_t{cloud.big_endian_data}) + raw(cloud.point_step) + raw(cloud.rows_step()) +
         with_length(cloud.bytes()) + raw(std::uint8_t{1});
}

// Common Data Representation: numbers at multiples of their size behind a head of four bytes.
class CdrWriter {
 public:
  explicit CdrWriter(bool big_endian) : big_endian_(big_endian), text_{'\0', big_endian ? '\0' : '\1', '\0', '\0'} {}

  template <typename Number>
  void put(Number number) {
    while ((text_.size() - 4) % sizeof number != 0) text_ += '\0';
    text_ += raw(number, big_endian_);
  }
  void put_text(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    text_ += text + '\0';
  }
  void put_bytes(const std::string& bytes) { text_ += bytes; }
  void put_block(const std::string& block) {
    put(static_cast<std::uint32_t>(block.size()));
    text_ += block;
  }
  const std::string& text() const { return text_; }

 private:
  bool big_endian_;
  std::string text_;
};

inline std::string cdr_message(const CloudMessage& cloud, bool big_endian = false) {
  CdrWriter out(big_endian);
  out.put(static_cast<std::int32_t>(cloud.sec));
  out.put(cloud.nsec);
  out.put_text(cloud.frame_id);
  out.put(cloud.height);
  out.put(cloud.width);
  out.put(static_cast<std::uint32_t>(cloud.names.size()));
  for (std::size_t i = 0; i < cloud.names.size(); ++i) {
    out.put_text(cloud.names[i]);
    out.put(cloud.offsets[i]);
    out.put(cloud.types[i]);
    out.put(std::uint32_t{1});
  }
  out.put(std::uint8_t{cloud.big_endian_data});
  out.put(cloud.point_step);
  out.put(cloud.rows_step());
  out.put_block(cloud.bytes());
  out.put(std::uint8_t{1});
  return out.text();
}

// One message of a bag to be written.
struct WrittenMessage {
  std::uint32_t topic;  // index into the topics
  std::string data;
};

// How chunks are stored: the name that the format has for it, and what does it.
struct Packing {
  std::string name;
  std::string (*pack)(const std::string&) = nullptr;
};

inline std::string ros1_record(const std::vector<std::pair<std::string, std::string>>& fields,
                               const std::string& data) {
  std::string header;
  for (const auto& [name, value] : fields) header += with_length(name + "=" + value);
  return with_length(header) + with_length(data);
}

// Topic 0 is the first cloud, others as they come; each message in a chunk of its own.
inline std::string ros1_bag(const std::vector<std::pair<std::string, std::string>>& topics,
                            const std::vector<WrittenMessage>& messages, const Packing& packing = {"none"}) {
  const auto op = [](char number) { return std::pair<std::string, std::string>("op", std::string(1, number)); };
  const auto connection = [&](std::uint32_t i) {
    return ros1_record({op(7), {"conn", raw(i)}, {"topic", topics[i].first}},
                       with_length("topic=" + topics[i].first) + with_length("type=" + topics[i].second));
  };
  std::string chunks;
  for (const WrittenMessage& message : messages) {
    const std::string time = raw(std::uint32_t{1700000000}) + raw(std::uint32_t{7});
    const std::string content =
        connection(message.topic) + ros1_record({op(2), {"conn", raw(message.topic)}, {"time", time}}, message.data);
    const std::string stored = packing.pack != nullptr ? packing.pack(content) : content;
    chunks += ros1_record(
        {op(5), {"compression", packing.name}, {"size", raw(static_cast<std::uint32_t>(content.size()))}}, stored);
    chunks += ros1_record({op(4), {"ver", raw(std::uint32_t{1})}, {"conn", raw(message.topic)}}, raw(std::uint32_t{0}));
  }
  std::string index;
  for (std::uint32_t i = 0; i < topics.size(); ++i) index += connection(i);
  for (std::size_t i = 0; i < messages.size(); ++i) index += ros1_record({op(6), {"ver", raw(std::uint32_t{1})}}, "");
  const std::string magic = "#ROSBAG V2.0\n";
  const auto head = [&](std::uint64_t index_offset) {
    return ros1_record({op(3),
                        {"index_pos", raw(index_offset)},
                        {"conn_count", raw(static_cast<std::uint32_t>(topics.size()))},
                        {"chunk_count", raw(static_cast<std::uint32_t>(messages.size()))}},
                       "      ");
  };
  return magic + head(magic.size() + head(0).size() + chunks.size()) + chunks + index;
}

inline std::string mcap_record(char op, const std::string& content) {
  return std::string(1, op) + raw(static_cast<std::uint64_t>(content.size())) + content;
}

// CRC-32 bit by bit.
inline std::uint32_t slow_crc32(const std::string& text) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? crc >> 1U ^ 0xEDB88320U : crc >> 1U;
  }
  return ~crc;
}

inline std::string mcap_chunk(const std::string& records, const Packing& packing, std::uint32_t crc) {
  const std::string stored = packing.pack != nullptr ? packing.pack(records) : records;
  return mcap_record(6, raw(std::uint64_t{0}) + raw(std::uint64_t{0}) +
                            raw(static_cast<std::uint64_t>(records.size())) + raw(crc) + with_length(packing.name) +
                            raw(static_cast<std::uint64_t>(stored.size())) + stored);
}

// Without chunks when `packing` is null; else one chunk for each message.
inline std::string mcap(const std::vector<std::pair<std::string, std::string>>& topics,
                        const std::vector<WrittenMessage>& messages, const Packing* packing,
                        const std::string& encoding = "cdr") {
  const std::string magic("\x89MCAP0\r\n");
  std::string channels;
  for (std::uint16_t i = 0; i < topics.size(); ++i) {
    const auto schema = static_cast<std::uint16_t>(i + 1);
    channels += mcap_record(3, raw(schema) + with_length(topics[i].second) + with_length("ros2msg") + with_length(""));
    channels +=
        mcap_record(4, raw(i) + raw(schema) + with_length(topics[i].first) + with_length(encoding) + with_length(""));
  }
  std::string text = magic + mcap_record(1, with_length("ros2") + with_length("test")) + channels;
  for (const WrittenMessage& message : messages) {
    const std::string record =
        mcap_record(5, raw(static_cast<std::uint16_t>(message.topic)) + raw(std::uint32_t{0}) +
                           raw(std::uint64_t{1700000000000000007}) + raw(std::uint64_t{0}) + message.data);
    text += packing != nullptr ? mcap_chunk(channels + record, *packing, slow_crc32(channels + record)) : record;
  }
  return text + mcap_record(15, raw(std::uint32_t{0})) + channels +
         mcap_record(2, raw(std::uint64_t{0}) + raw(std::uint64_t{0}) + raw(std::uint32_t{0})) + magic;
}

#if POSE_WALL_HAS_SQLITE

// As rosbag2 writes it, by SQLite itself.
inline void write_sqlite_bag(const std::string& file, const std::vector<std::pair<std::string, std::string>>& topics,
                             const std::vector<WrittenMessage>& messages, const std::string& format = "cdr") {
  sqlite3* db = nullptr;
  sqlite3_open(file.c_str(), &db);
  const auto insert = [db](const char* text, const std::vector<std::string>& texts, const std::string* blob,
                           int topic) {
    sqlite3_stmt* row = nullptr;
    sqlite3_prepare_v2(db, text, -1, &row, nullptr);
    sqlite3_bind_int(row, 1, topic);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      sqlite3_bind_text(row, static_cast<int>(i) + 2, texts[i].data(), static_cast<int>(texts[i].size()),
                        SQLITE_TRANSIENT);
    }
    if (blob != nullptr) sqlite3_bind_blob(row, 2, blob->data(), static_cast<int>(blob->size()), SQLITE_TRANSIENT);
    sqlite3_step(row);
    sqlite3_finalize(row);
  };
  sqlite3_exec(db,
               "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);"
               "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);",
               nullptr, nullptr, nullptr);
  for (std::size_t i = 0; i < topics.size(); ++i) {
    insert("INSERT INTO topics VALUES(?, ?, ?, ?)", {topics[i].first, topics[i].second, format}, nullptr,
           static_cast<int>(i) + 1);
  }
  for (const WrittenMessage& message : messages) {
    insert("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, 1700000000000000007, ?)", {}, &message.data,
           static_cast<int>(message.topic) + 1);
  }
  sqlite3_close(db);
}

#endif

}  // namespace pose_wall::tools::test
