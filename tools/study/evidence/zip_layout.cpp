// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/evidence/zip_layout.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <stdexcept>

#include "io/language/language.hpp"
#include "study/evidence/manifest.hpp"

namespace pose_wall::tools::evidence {
namespace {

// Signatures, sizes and offsets of APPNOTE.TXT 6.3.10, sections 4.3.7 to 4.3.16.
constexpr std::uint32_t kLocalMark = 0x04034b50, kListMark = 0x02014b50, kEndMark = 0x06054b50;
constexpr std::uint32_t kEnd64Mark = 0x06064b50, kLocator64Mark = 0x07064b50;
constexpr std::size_t kLocalBytes = 30, kListBytes = 46, kEndBytes = 22, kEnd64Bytes = 56, kLocator64Bytes = 20;
constexpr std::uint64_t kIn64_16 = 0xFFFF, kIn64_32 = 0xFFFFFFFF;  // the number stands in a field of Zip64
constexpr std::uint16_t kZip64Field = 0x0001;
constexpr std::uint64_t kListBytesMost = 1U << 26;  // 64 MB: some 500,000 members, far beyond what a manifest tells

[[noreturn]] void refuse_layout(const std::string& why) {
  throw std::runtime_error(why);
}

std::uint64_t number_in(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint64_t number = 0;
  if (at + count > bytes.size()) refuse_layout(tr("it is no zip, or it was cut off"));
  for (std::size_t i = count; i-- > 0;) number = number << 8U | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

// Of a file, the part that is asked for.
class Parts {
 public:
  explicit Parts(const std::filesystem::path& file) : in_(file, std::ios::binary) {
    in_.seekg(0, std::ios::end);
    const std::streamoff size = in_.tellg();
    size_ = size < 0 ? 0 : static_cast<std::uint64_t>(size);
  }

  std::uint64_t size() const { return size_; }

  std::string at(std::uint64_t from, std::uint64_t count) {
    if (from > size_ || count > size_ - from) refuse_layout(tr("it is no zip, or it was cut off"));
    std::string bytes(count, '\0');
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(from));
    in_.read(bytes.data(), static_cast<std::streamsize>(count));
    if (in_.gcount() != static_cast<std::streamsize>(count)) refuse_layout(tr("it is no zip, or it was cut off"));
    return bytes;
  }

 private:
  std::ifstream in_;
  std::uint64_t size_ = 0;
};

struct List {
  std::uint64_t from = 0, bytes = 0, count = 0;
  std::uint64_t end = 0;  // what follows the list begins here
};

struct Row {
  std::string name;
  std::uint64_t packed_bytes = 0, from = 0;
  bool has_descriptor = false;  // sizes behind the data, once more
};

List list_of_64(Parts& parts, std::uint64_t locator_from) {
  const std::string locator = parts.at(locator_from, kLocator64Bytes);
  if (number_in(locator, 0, 4) != kLocator64Mark) refuse_layout(tr("it is no zip, or it was cut off"));
  List list;
  list.end = number_in(locator, 8, 8);
  const std::string end = parts.at(list.end, kEnd64Bytes);
  if (number_in(end, 0, 4) != kEnd64Mark) refuse_layout(tr("it is no zip, or it was cut off"));
  if (list.end + kEnd64Bytes != locator_from) refuse_layout(tr("bytes lie in it that belong to no member"));
  list.count = number_in(end, 32, 8);
  list.bytes = number_in(end, 40, 8);
  list.from = number_in(end, 48, 8);
  return list;
}

List find_list(Parts& parts) {
  if (parts.size() < kEndBytes) refuse_layout(tr("it is no zip, or it was cut off"));
  const std::uint64_t end_from = parts.size() - kEndBytes;
  const std::string end = parts.at(end_from, kEndBytes);
  if (number_in(end, 0, 4) != kEndMark || number_in(end, 20, 2) != 0) {
    refuse_layout(tr("it is no zip, it was cut off, or bytes follow its end"));
  }
  List list{number_in(end, 16, 4), number_in(end, 12, 4), number_in(end, 10, 2), end_from};
  const bool is_64 = list.from == kIn64_32 || list.bytes == kIn64_32 || list.count == kIn64_16;
  if (is_64 && end_from >= kLocator64Bytes) list = list_of_64(parts, end_from - kLocator64Bytes);
  if (list.bytes > kListBytesMost) refuse_layout(tr("its list of members is longer than any of an evidence"));
  if (list.from > list.end || list.bytes != list.end - list.from) {
    refuse_layout(tr("bytes lie in it that belong to no member"));
  }
  return list;
}

// What a row tells in its field of Zip64: those of the three numbers that say so, in this order.
void take_zip64(const std::string& extra, bool has_bytes, Row* row) {
  std::size_t at = 0;
  while (at + 4 <= extra.size()) {
    const std::uint64_t id = number_in(extra, at, 2), count = number_in(extra, at + 2, 2);
    at += 4;
    if (id != kZip64Field) {
      at += count;
      continue;
    }
    if (has_bytes) at += 8;
    if (row->packed_bytes == kIn64_32) row->packed_bytes = number_in(extra, at, 8), at += 8;
    if (row->from == kIn64_32) row->from = number_in(extra, at, 8);
    return;
  }
}

std::vector<Row> rows_of(Parts& parts, const List& list) {
  const std::string bytes = parts.at(list.from, list.bytes);
  std::vector<Row> rows;
  std::size_t at = 0;
  while (at < bytes.size()) {
    if (number_in(bytes, at, 4) != kListMark) refuse_layout(tr("its list of members is damaged"));
    const std::uint64_t name = number_in(bytes, at + 28, 2), extra = number_in(bytes, at + 30, 2);
    if (number_in(bytes, at + 32, 2) != 0) refuse_layout(tr("a member has a comment, which is none of an evidence"));
    const std::size_t next = at + kListBytes + name + extra;
    if (next > bytes.size()) refuse_layout(tr("its list of members is damaged"));
    Row row{bytes.substr(at + kListBytes, name), number_in(bytes, at + 20, 4), number_in(bytes, at + 42, 4),
            (number_in(bytes, at + 8, 2) & 8U) != 0};
    take_zip64(bytes.substr(at + kListBytes + name, extra), number_in(bytes, at + 24, 4) == kIn64_32, &row);
    rows.push_back(row);
    at = next;
  }
  if (rows.size() != list.count) refuse_layout(tr("its list of members is damaged"));
  return rows;
}

// Where its data ends. Sizes behind them take 12 to 24 bytes, and may have a signature and 64 bits.
void expect_end(const Row& row, std::uint64_t end, std::uint64_t next) {
  const std::uint64_t gap = next - end;
  const bool is_descriptor = row.has_descriptor && (gap == 12 || gap == 16 || gap == 20 || gap == 24);
  if (end > next || (gap != 0 && !is_descriptor)) refuse_layout(tr("bytes lie in it that belong to no member"));
}

void walk_members(Parts& parts, const List& list, std::vector<Row> rows) {
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.from < b.from; });
  if (list.from != 0 && (rows.empty() || rows.front().from != 0)) {
    refuse_layout(tr("bytes lie in it that belong to no member"));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const std::uint64_t next = i + 1 < rows.size() ? rows[i + 1].from : list.from;
    const std::string head = parts.at(row.from, kLocalBytes);
    if (number_in(head, 0, 4) != kLocalMark) refuse_layout(tr("its list of members is damaged"));
    const std::uint64_t name = number_in(head, 26, 2), extra = number_in(head, 28, 2);
    const std::string own_name = parts.at(row.from + kLocalBytes, name);
    if (own_name != row.name) {
      refuse_layout(say("a member has two names: '{}' and '{}'", shown_name(row.name), shown_name(own_name)));
    }
    const std::uint64_t data = row.from + kLocalBytes + name + extra;
    if (row.packed_bytes > parts.size()) refuse_layout(tr("it is no zip, or it was cut off"));
    expect_end(row, data + row.packed_bytes, next);
  }
}

}  // namespace

std::vector<std::string> checked_layout(const std::filesystem::path& zip) {
  Parts parts(zip);
  const List list = find_list(parts);
  const std::vector<Row> rows = rows_of(parts, list);
  walk_members(parts, list, rows);
  std::vector<std::string> names;
  for (const Row& row : rows) names.push_back(row.name);
  return names;
}

}  // namespace pose_wall::tools::evidence
