// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fields of a ROS message one after another, as either serialisation lays them out.

#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/bags/bag_reader.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {

class MessageCursor {
 public:
  MessageCursor(MessageEncoding encoding, ByteView message, const Place& place)
      : cursor_(message, place), is_cdr_(encoding == MessageEncoding::kCdr) {
    if (encoding == MessageEncoding::kOther) cursor_.refuse(tr("a message that is neither CDR nor of ROS 1"));
    if (is_cdr_) read_encapsulation();
  }

  template <typename Number>
  Number number(std::string_view what) {
    align(sizeof(Number), what);
    return cursor_.number<Number>(what);
  }

  std::string_view text(std::string_view what) {
    const ByteView bytes = block(what);
    std::string_view text = text_of(bytes);
    // CDR counts the zero that ends a text.
    if (is_cdr_ && !text.empty() && text.back() == '\0') text.remove_suffix(1);
    return text;
  }

  // Behind its length.
  ByteView block(std::string_view what) { return cursor_.bytes(number<std::uint32_t>(what), what); }

  // Of a length that the type of the message says.
  ByteView bytes(std::size_t size, std::string_view what) { return cursor_.bytes(size, what); }

  // CDR puts numbers, and what begins with one, at multiples of their size, counted from behind its head.
  void align(std::size_t size, std::string_view what) {
    if (!is_cdr_) return;
    const std::size_t beyond = (cursor_.position() - start_) % size;
    if (beyond != 0) cursor_.bytes(size - beyond, what);
  }

  std::int64_t stamp_ns(std::string_view what) {
    // ROS 2 has signed seconds; what ROS 1 counts above them ends in 2106.
    const std::int64_t seconds =
        is_cdr_ ? std::int64_t{number<std::int32_t>(what)} : std::int64_t{number<std::uint32_t>(what)};
    const auto nanoseconds = number<std::uint32_t>(what);
    if (nanoseconds >= 1'000'000'000) {
      refuse(say("{} has {} nanoseconds; less than 1000000000 are allowed", what, nanoseconds));
    }
    return seconds * 1'000'000'000 + nanoseconds;
  }

  std::size_t left() const { return cursor_.left(); }
  bool is_cdr() const { return is_cdr_; }
  bool is_big_endian() const { return is_big_endian_; }
  [[noreturn]] void refuse(const std::string& why) const { cursor_.refuse(why); }

 private:
  void read_encapsulation() {
    const ByteView head = cursor_.bytes(4, "head of a CDR message");
    const auto kind = std::to_integer<unsigned>(head.data[0]) << 8U | std::to_integer<unsigned>(head.data[1]);
    if (kind > 1) cursor_.refuse(say("CDR of kind {:04x}; 0000 and 0001 are read", kind));
    is_big_endian_ = kind == 0;
    cursor_.set_big_endian(is_big_endian_);
    start_ = cursor_.position();
  }

  ByteCursor cursor_;
  bool is_cdr_;
  bool is_big_endian_ = false;
  std::size_t start_ = 0;
};

struct MessageHeader {
  std::int64_t stamp_ns = 0;  // 0: none
  std::string_view frame_id;  // as long as the message's bytes
};

inline MessageHeader read_header(MessageCursor& message) {
  if (!message.is_cdr()) message.number<std::uint32_t>("header.seq");
  MessageHeader header;
  header.stamp_ns = message.stamp_ns("header.stamp");
  header.frame_id = message.text("header.frame_id");
  return header;
}

}  // namespace pose_wall::tools
