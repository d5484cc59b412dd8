// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The bytes of a ROS message as either serialisation lays them out: ROS 1 without gaps, ROS 2 as CDR.

#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "bags/bag_reader.hpp"
#include "bags/byte_cursor.hpp"

namespace pose_wall::tools {

class MessageCursor {
 public:
  MessageCursor(MessageEncoding encoding, ByteView message, const Place& place)
      : cursor_(message, place), is_cdr_(encoding == MessageEncoding::kCdr) {
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

  ByteView block(std::string_view what) { return cursor_.bytes(number<std::uint32_t>(what), what); }

  bool is_cdr() const { return is_cdr_; }
  [[noreturn]] void refuse(const std::string& why) const { cursor_.refuse(why); }

 private:
  void read_encapsulation() {
    const ByteView head = cursor_.bytes(4, "head of a CDR message");
    const auto kind = std::to_integer<unsigned>(head.data[0]) << 8U | std::to_integer<unsigned>(head.data[1]);
    if (kind > 1) cursor_.refuse(fmt::format("CDR of kind {:04x}; 0000 and 0001 are read", kind));
    cursor_.set_big_endian(kind == 0);
    start_ = cursor_.position();
  }

  // CDR puts numbers at multiples of their size, counted from behind its head.
  void align(std::size_t size, std::string_view what) {
    if (!is_cdr_) return;
    const std::size_t beyond = (cursor_.position() - start_) % size;
    if (beyond != 0) cursor_.bytes(size - beyond, what);
  }

  ByteCursor cursor_;
  bool is_cdr_;
  std::size_t start_ = 0;
};

}  // namespace pose_wall::tools
