// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/decompress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// As for files of single frames: far beyond any chunk that recorders write.
constexpr std::uint64_t kBlockBytesMax = 2'000'000'000;
constexpr std::uint64_t kFirstBytes = 1U << 20U;

}  // namespace

std::string missing_support(std::string_view what, std::string_view package, std::string_view option) {
  return say("this build cannot read {}: install {}, configure with -D{}=ON and build again", what, package, option);
}

ByteView GrowingBlock::room() {
  if (filled_ == bytes_.size()) {
    bytes_.resize(static_cast<std::size_t>(
        std::min<std::uint64_t>(size_max_, std::max(kFirstBytes, 2 * std::uint64_t{filled_}))));
  }
  return {bytes_.data() + filled_, bytes_.size() - filled_};
}

Bytes GrowingBlock::take() {
  if (!is_full()) throw FrameError(say("{} bytes came out of it, {} were announced", filled_, size_max_));
  bytes_.resize(filled_);
  return std::move(bytes_);
}

Bytes decompress(std::string_view method, ByteView compressed, std::uint64_t size) {
  if (size > kBlockBytesMax) {
    throw FrameError(say("announces {} bytes; at most {} are allowed", size, kBlockBytesMax));
  }
  if (method == "lz4") return decompress_lz4(compressed, size);
  if (method == "zstd") return decompress_zstd(compressed, size);
  if (method == "bz2") return decompress_bzip2(compressed, size);
  throw FrameError(say("compression '{}' is unknown; none, lz4, zstd and bz2 are read", method));
}

}  // namespace pose_wall::tools
