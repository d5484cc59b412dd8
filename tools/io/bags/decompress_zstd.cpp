// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/decompress.hpp"

#if POSE_WALL_HAS_ZSTD
#include <fmt/format.h>
#include <zstd.h>

#include <memory>

#include "io/language/language.hpp"

namespace pose_wall::tools {

Bytes decompress_zstd(ByteView compressed, std::uint64_t size) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  if (!context) throw FrameError(tr("zstd: no memory"));
  GrowingBlock block(size);
  ZSTD_inBuffer in{compressed.data, compressed.size, 0};
  std::size_t expected = 1;  // 0 when the frame is complete
  while (expected != 0) {
    const ByteView room = block.room();
    ZSTD_outBuffer out{const_cast<std::byte*>(room.data), room.size, 0};
    const std::size_t in_before = in.pos;
    expected = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(expected) != 0) throw FrameError(fmt::format("zstd: {}", ZSTD_getErrorName(expected)));
    block.fill(out.pos);
    if (expected != 0 && in.pos == in_before && out.pos == 0) {
      throw FrameError(block.is_full() ? say("zstd: more than the {} bytes announced come out of it", size)
                                       : std::string("zstd: the compressed bytes end too early"));
    }
  }
  if (in.pos != in.size) throw FrameError(say("zstd: {} bytes follow its end", in.size - in.pos));
  return block.take();
}

std::uint64_t zstd_content_bytes(ByteView compressed) {
  const unsigned long long bytes = ZSTD_getFrameContentSize(compressed.data, compressed.size);
  if (bytes == ZSTD_CONTENTSIZE_ERROR) throw FrameError(tr("zstd: the head of its frame is damaged"));
  if (bytes == ZSTD_CONTENTSIZE_UNKNOWN) throw FrameError(tr("zstd: its frame does not say how much it holds"));
  return bytes;
}

}  // namespace pose_wall::tools

#else

namespace pose_wall::tools {

Bytes decompress_zstd(ByteView /*compressed*/, std::uint64_t /*size*/) {
  throw FrameError(missing_support("zstd", "libzstd-dev", "POSE_WALL_READ_ZSTD"));
}

std::uint64_t zstd_content_bytes(ByteView /*compressed*/) {
  throw FrameError(missing_support("zstd", "libzstd-dev", "POSE_WALL_READ_ZSTD"));
}

}  // namespace pose_wall::tools

#endif
