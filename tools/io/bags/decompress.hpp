// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Blocks of bags, decompressed.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/bags/byte_cursor.hpp"

namespace pose_wall::tools {

// `method` as bags name it: "lz4" (frames), "zstd" or "bz2". Gives exactly `size` bytes, or throws FrameError; what
// follows the end of the compressed stream is refused as well. Memory is taken as content comes out, not on the word
// of `size`.
Bytes decompress(std::string_view method, ByteView compressed, std::uint64_t size);

// Of one library each; only called with what their method is named for.
Bytes decompress_lz4(ByteView compressed, std::uint64_t size);
Bytes decompress_zstd(ByteView compressed, std::uint64_t size);
Bytes decompress_bzip2(ByteView compressed, std::uint64_t size);

// What comes out of the frame of zstd at the beginning, by its own head. Throws FrameError where that does not say it.
std::uint64_t zstd_content_bytes(ByteView compressed);

// "this build cannot read WHAT: install PACKAGE, configure with -DOPTION=ON and build again"
std::string missing_support(std::string_view what, std::string_view package, std::string_view option);

// The content of a block as it comes out: grows by steps up to what was announced.
class GrowingBlock {
 public:
  explicit GrowingBlock(std::uint64_t size_max) : size_max_(size_max) {}

  // Room for more; nothing when the announced size is reached.
  ByteView room();
  void fill(std::size_t bytes) { filled_ += bytes; }
  bool is_full() const { return filled_ == size_max_; }
  std::size_t filled() const { return filled_; }

  // Throws FrameError unless exactly the announced size came out.
  Bytes take();

 private:
  std::uint64_t size_max_;
  std::size_t filled_ = 0;
  Bytes bytes_;
};

}  // namespace pose_wall::tools
