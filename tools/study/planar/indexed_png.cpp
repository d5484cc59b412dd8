// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// PNG: ISO/IEC 15948. Its stream: RFC 1950 and 1951, fixed codes, repetitions of the last byte only. Each row is
// written as its difference from the row above, so most bytes of a map are repeated zeros.

#include "study/planar/indexed_png.hpp"

#include <cstddef>
#include <utility>

#include "io/bags/crc32.hpp"

namespace pose_wall::tools {
namespace {

void add_big_endian(std::string* bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes->push_back(static_cast<char>(word >> shift & 0xFFU));
}

void add_chunk(std::string* png, const std::string& kind, const std::string& content) {
  add_big_endian(png, static_cast<std::uint32_t>(content.size()));
  const std::string checked = kind + content;
  *png += checked;
  add_big_endian(png, crc32({reinterpret_cast<const std::byte*>(checked.data()), checked.size()}));
}

// Bits from the lowest on.
class BitStream {
 public:
  void add(std::uint32_t bits, int count) {
    for (int k = 0; k < count; ++k) add_bit(bits >> k & 1U);
  }
  // Huffman codes begin with their highest bit.
  void add_code(std::uint32_t code, int count) {
    for (int k = count - 1; k >= 0; --k) add_bit(code >> k & 1U);
  }
  std::string take() {
    if (filled_ > 0) bytes_.push_back(static_cast<char>(byte_));
    return std::move(bytes_);
  }

 private:
  void add_bit(std::uint32_t bit) {
    byte_ |= bit << filled_;
    if (++filled_ < 8) return;
    bytes_.push_back(static_cast<char>(byte_));
    byte_ = 0;
    filled_ = 0;
  }
  std::string bytes_;
  std::uint32_t byte_ = 0;
  int filled_ = 0;
};

// RFC 1951, 3.2.6.
void add_symbol(BitStream* stream, std::uint32_t symbol) {
  if (symbol < 144) return stream->add_code(0x30U + symbol, 8);
  if (symbol < 256) return stream->add_code(0x190U + symbol - 144, 9);
  if (symbol < 280) return stream->add_code(symbol - 256, 7);
  stream->add_code(0xC0U + symbol - 280, 8);
}

// The last byte again, 3 to 258 times: RFC 1951, 3.2.5.
void add_repeat(BitStream* stream, std::uint32_t length) {
  constexpr std::uint32_t kLongest = 258;
  std::uint32_t symbol = 285;
  if (length < kLongest) {
    std::uint32_t base = 3;
    int extra = 0;
    for (symbol = 257;; ++symbol) {
      extra = symbol < 265 ? 0 : static_cast<int>((symbol - 261) / 4);
      if (length < base + (1U << extra)) break;
      base += 1U << extra;
    }
    add_symbol(stream, symbol);
    stream->add(length - base, extra);
  } else {
    add_symbol(stream, symbol);
  }
  stream->add_code(0, 5);  // one byte back
}

std::string deflated(const std::string& bytes) {
  constexpr std::size_t kShortest = 3;
  constexpr std::size_t kLongest = 258;
  BitStream stream;
  stream.add(1, 1);  // the only block
  stream.add(1, 2);  // fixed codes
  for (std::size_t at = 0; at < bytes.size();) {
    std::size_t same = 0;
    while (at > 0 && same < kLongest && at + same < bytes.size() && bytes[at + same] == bytes[at - 1]) ++same;
    if (same >= kShortest) {
      add_repeat(&stream, static_cast<std::uint32_t>(same));
      at += same;
    } else {
      add_symbol(&stream, static_cast<unsigned char>(bytes[at]));
      ++at;
    }
  }
  add_symbol(&stream, 256);
  return stream.take();
}

std::uint32_t adler32(const std::string& bytes) {
  constexpr std::uint32_t kPrime = 65521;
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char byte : bytes) {
    a = (a + static_cast<unsigned char>(byte)) % kPrime;
    b = (b + a) % kPrime;
  }
  return b << 16U | a;
}

// Rows of two bits a pixel, each behind its filter.
std::string rows_of(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& pixels) {
  constexpr char kUp = 2;  // the difference from the row above
  const std::size_t row_bytes = (std::size_t{width} + 3) / 4;
  std::string rows;
  std::vector<unsigned char> above(row_bytes), row(row_bytes);
  for (std::size_t y = 0; y < height; ++y) {
    row.assign(row_bytes, 0);
    for (std::size_t x = 0; x < width; ++x) {
      const unsigned pixel = pixels[y * width + x] & 3U;
      row[x / 4] = static_cast<unsigned char>(row[x / 4] | pixel << (6U - 2U * (x % 4)));
    }
    rows.push_back(kUp);
    for (std::size_t k = 0; k < row_bytes; ++k) rows.push_back(static_cast<char>(row[k] - above[k]));
    above = row;
  }
  return rows;
}

}  // namespace

std::string indexed_png(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& pixels,
                        const std::array<Rgb, 4>& colours) {
  std::string png = "\x89PNG\r\n\x1a\n";
  std::string head;
  add_big_endian(&head, width);
  add_big_endian(&head, height);
  head += std::string("\x02\x03\x00\x00\x00", 5);  // two bits, by palette
  add_chunk(&png, "IHDR", head);
  std::string palette;
  for (const Rgb& colour : colours) {
    for (const std::uint8_t part : {colour.red, colour.green, colour.blue}) palette.push_back(static_cast<char>(part));
  }
  add_chunk(&png, "PLTE", palette);
  const std::string rows = rows_of(width, height, pixels);
  std::string stream = "\x78\x01" + deflated(rows);
  add_big_endian(&stream, adler32(rows));
  add_chunk(&png, "IDAT", stream);
  add_chunk(&png, "IEND", "");
  return png;
}

}  // namespace pose_wall::tools
