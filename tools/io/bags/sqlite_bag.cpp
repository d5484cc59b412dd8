// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/sqlite_bag.hpp"

#include "io/bags/decompress.hpp"
#include "io/bags/packed_message.hpp"
#include "io/language/language.hpp"

#if POSE_WALL_HAS_SQLITE
#include <fmt/format.h>
#include <sqlite3.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <system_error>
#include <utility>

namespace pose_wall::tools {
namespace {

using Database = std::unique_ptr<sqlite3, decltype(&sqlite3_close)>;
using Statement = std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)>;

[[noreturn]] void refuse(sqlite3* database) {
  throw FrameError(fmt::format("SQLite: {}", database != nullptr ? sqlite3_errmsg(database) : "no memory"));
}

// Nothing is to be written beside a recording. Only a log that its recorder left behind needs the usual way.
std::string uri_of(const std::string& path) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    const bool plain = c == '/' || c == '.' || c == '-' || c == '_' || (c >= '0' && c <= '9') ||
                       (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  std::error_code error;
  const std::uintmax_t log_bytes = std::filesystem::file_size(path + "-wal", error);
  return uri + (!error && log_bytes > 0 ? "?mode=ro" : "?mode=ro&immutable=1");
}

Database open_database(const std::string& path) {
  sqlite3* opened = nullptr;
  const int status = sqlite3_open_v2(uri_of(path).c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  Database database(opened, sqlite3_close);
  if (status != SQLITE_OK) refuse(opened);
  // A file that was cut is refused as a whole unless its schema may be written; the opening for reading only stands.
  sqlite3_exec(opened, "PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON; PRAGMA writable_schema=ON;", nullptr,
               nullptr, nullptr);
  return database;
}

Statement prepare(const Database& database, const char* text) {
  sqlite3_stmt* prepared = nullptr;
  if (sqlite3_prepare_v2(database.get(), text, -1, &prepared, nullptr) != SQLITE_OK) refuse(database.get());
  return {prepared, sqlite3_finalize};
}

std::string text_column(const Statement& row, int column) {
  const auto* const text = sqlite3_column_text(row.get(), column);
  return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

// Bytes that the file is to have by its own head; 0 where that says nothing.
std::uint64_t bytes_announced(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Bytes head(32);
  file.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  if (!file) return 0;
  ByteCursor cursor({head.data(), head.size()});
  cursor.set_big_endian(true);
  cursor.bytes(16, "magic");
  const auto page_bytes = cursor.number<std::uint16_t>("page size");
  cursor.bytes(10, "head");
  const auto pages = cursor.number<std::uint32_t>("pages");
  return std::uint64_t{page_bytes == 1 ? 65536U : page_bytes} * pages;
}

class SqliteBag : public BagReader {
 public:
  explicit SqliteBag(const std::string& path)
      : database_(open_database(path)), bytes_(std::filesystem::file_size(path)), announced_(bytes_announced(path)) {
    read_topics();
    rewind();
  }

  std::optional<BagMessage> next() override;
  void rewind() override {
    rows_ = prepare(database_, "SELECT id, topic_id, timestamp, data FROM messages ORDER BY id");
    ended_ = false;
    has_ahead_ = false;
  }
  const std::vector<BagTopic>& topics() const override { return topics_; }

 private:
  void read_topics();
  BagMessage message_of_row();
  std::optional<BagMessage> next_of_cut();
  [[noreturn]] void refuse_cut() const;

  Database database_;
  Statement rows_{nullptr, sqlite3_finalize};
  bool ended_ = false;
  std::uint64_t bytes_ = 0, announced_ = 0;
  bool has_ahead_ = false;
  BagMessage ahead_;
  Bytes ahead_bytes_, given_bytes_;
  PackedMessage packed_;
  std::vector<BagTopic> topics_;
  std::map<std::int64_t, std::size_t> topic_of_id_;
};

void SqliteBag::read_topics() {
  const Statement rows = prepare(database_, "SELECT id, name, type, serialization_format FROM topics ORDER BY id");
  int status = sqlite3_step(rows.get());
  for (; status == SQLITE_ROW; status = sqlite3_step(rows.get())) {
    topic_of_id_[sqlite3_column_int64(rows.get(), 0)] = topics_.size();
    // Converters leave the format empty. ROS 2 has no other than CDR, and each message's head is checked.
    const std::string format = text_column(rows, 3);
    const bool is_cdr = format == "cdr" || format.empty();
    topics_.push_back(
        {text_column(rows, 1), text_column(rows, 2), is_cdr ? MessageEncoding::kCdr : MessageEncoding::kOther});
  }
  if (status != SQLITE_DONE) refuse(database_.get());
}

void SqliteBag::refuse_cut() const {
  throw FrameError(say("offset {}: the file is cut: its head announces {} bytes", bytes_, announced_));
}

BagMessage SqliteBag::message_of_row() {
  BagMessage message;
  const std::int64_t id = sqlite3_column_int64(rows_.get(), 0);
  const auto topic = topic_of_id_.find(sqlite3_column_int64(rows_.get(), 1));
  if (topic == topic_of_id_.end()) throw FrameError(say("message id {}: it is of no topic of the bag", id));
  message.topic = topic->second;
  message.recorded_ns = sqlite3_column_int64(rows_.get(), 2);
  message.place.inside = say("message id {}", id);
  message.data.data = static_cast<const std::byte*>(sqlite3_column_blob(rows_.get(), 3));
  message.data.size = static_cast<std::size_t>(sqlite3_column_bytes(rows_.get(), 3));
  if (sqlite3_errcode(database_.get()) == SQLITE_NOMEM) refuse(database_.get());
  packed_.unpack(topics_[message.topic], &message);
  return message;
}

std::optional<BagMessage> SqliteBag::next() {
  if (ended_) return std::nullopt;
  if (bytes_ < announced_) return next_of_cut();
  const int status = sqlite3_step(rows_.get());
  if (status == SQLITE_ROW) return message_of_row();
  ended_ = true;
  if (status != SQLITE_DONE) refuse(database_.get());
  return std::nullopt;
}

// SQLite takes what is missing of the last page for zeros. What lies on it is the last message that can be reached, so
// a message is given only when there is one behind it.
std::optional<BagMessage> SqliteBag::next_of_cut() {
  while (sqlite3_step(rows_.get()) == SQLITE_ROW) {
    BagMessage ahead = message_of_row();
    std::swap(given_bytes_, ahead_bytes_);
    ahead_bytes_.assign(ahead.data.data, ahead.data.data + ahead.data.size);
    std::swap(ahead, ahead_);
    if (std::exchange(has_ahead_, true)) {
      ahead.data.data = given_bytes_.data();
      return ahead;
    }
  }
  ended_ = true;
  refuse_cut();
}

}  // namespace

std::unique_ptr<BagReader> open_sqlite_bag(const std::string& path) {
  return std::make_unique<SqliteBag>(path);
}

}  // namespace pose_wall::tools

#else

namespace pose_wall::tools {

std::unique_ptr<BagReader> open_sqlite_bag(const std::string& /*path*/) {
  throw FrameError(missing_support("bags in SQLite (.db3)", "libsqlite3-dev", "POSE_WALL_READ_SQLITE"));
}

}  // namespace pose_wall::tools

#endif
