// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Writes a ROS message in either serialisation, little-endian: ROS 1 without gaps, ROS 2 as CDR behind its head.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "io/bags/bag_reader.hpp"
#include "io/bags/byte_cursor.hpp"

namespace pose_wall::tools {

class MessageWriter {
 public:
  // kRos1 or kCdr.
  explicit MessageWriter(MessageEncoding encoding) : is_cdr_(encoding == MessageEncoding::kCdr) {
    if (is_cdr_) bytes_.assign({'\0', '\1', '\0', '\0'});
    head_ = bytes_.size();
  }

  template <typename Number>
  void number(Number number) {
    // CDR puts numbers at multiples of their size, counted from behind its head.
    if (is_cdr_) bytes_.append((sizeof number - (bytes_.size() - head_) % sizeof number) % sizeof number, '\0');
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    if (host_is_big_endian()) std::reverse(raw, raw + sizeof number);
    bytes_.append(raw, sizeof number);
  }

  void text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size() + (is_cdr_ ? 1 : 0)));
    bytes_.append(text);
    if (is_cdr_) bytes_.push_back('\0');
  }

  void block(std::string_view bytes) {
    number(static_cast<std::uint32_t>(bytes.size()));
    bytes_.append(bytes);
  }

  void count(std::size_t items) { number(static_cast<std::uint32_t>(items)); }

  bool is_cdr() const { return is_cdr_; }
  std::string take() { return std::move(bytes_); }

 private:
  bool is_cdr_;
  std::string bytes_;
  std::size_t head_ = 0;
};

}  // namespace pose_wall::tools
