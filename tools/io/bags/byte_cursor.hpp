// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Reads numbers and blocks out of bytes that are not trusted: every step is checked against the end, and what is
// missing is said with the place where it was looked for.

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "io/frames/frame.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {

struct ByteView {
  const std::byte* data = nullptr;
  std::size_t size = 0;
};

inline std::string_view text_of(const ByteView& bytes) {
  return {reinterpret_cast<const char*>(bytes.data), bytes.size};
}

// Up to four bytes that are known to be there, the lowest first.
inline std::uint32_t little_endian_at(ByteView bytes, std::size_t offset, std::size_t size) {
  std::uint32_t number = 0;
  for (std::size_t i = size; i-- > 0;) number = number << 8U | std::to_integer<std::uint32_t>(bytes.data[offset + i]);
  return number;
}

// Where bytes lie, for messages: at an offset of the file, or within something that has no offset of its own there
// (a chunk that was decompressed, a row of a database).
struct Place {
  std::uint64_t offset = 0;
  std::string inside;  // "chunk at offset 4117"

  std::string text(std::uint64_t position) const {
    return inside.empty() ? fmt::format("offset {}", offset + position)
                          : say("{}, byte {} of its content", inside, offset + position);
  }
};

class ByteCursor {
 public:
  explicit ByteCursor(ByteView bytes, Place place = {}) : bytes_(bytes), place_(std::move(place)) {}

  std::size_t position() const { return position_; }
  std::size_t left() const { return bytes_.size - position_; }
  std::string where() const { return place_.text(position_); }
  Place place_at(std::size_t position) const { return {place_.offset + position, place_.inside}; }

  void set_big_endian(bool big_endian) { turned_round_ = big_endian != host_is_big_endian(); }

  [[noreturn]] void refuse(const std::string& why) const { throw FrameError(fmt::format("{}: {}", where(), why)); }

  ByteView bytes(std::uint64_t size, std::string_view what) {
    if (size > left()) refuse(say("{} takes {} bytes, but {} are left", what, size, left()));
    const ByteView block{bytes_.data + position_, static_cast<std::size_t>(size)};
    position_ += block.size;
    return block;
  }

  template <typename Number>
  Number number(std::string_view what) {
    const ByteView block = bytes(sizeof(Number), what);
    std::array<std::byte, sizeof(Number)> raw;
    std::copy_n(block.data, raw.size(), raw.begin());
    if (turned_round_) std::reverse(raw.begin(), raw.end());
    Number number;
    std::memcpy(&number, raw.data(), sizeof number);
    return number;
  }

  // A block behind its length in 32 bits.
  ByteView counted_bytes(std::string_view what) { return bytes(number<std::uint32_t>(what), what); }

 private:
  ByteView bytes_;
  Place place_;
  std::size_t position_ = 0;
  bool turned_round_ = host_is_big_endian();
};

}  // namespace pose_wall::tools
