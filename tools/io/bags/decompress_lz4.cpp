// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/decompress.hpp"

#if POSE_WALL_HAS_LZ4
#include <fmt/format.h>
#include <lz4frame.h>

#include <memory>

#include "io/language/language.hpp"

namespace pose_wall::tools {

Bytes decompress_lz4(ByteView compressed, std::uint64_t size) {
  LZ4F_dctx* opened = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&opened, LZ4F_VERSION)) != 0) throw FrameError(tr("lz4: no memory"));
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(opened,
                                                                                     LZ4F_freeDecompressionContext);
  GrowingBlock block(size);
  std::size_t read = 0;
  std::size_t expected = 1;  // 0 when the frame is complete
  while (expected != 0) {
    const ByteView room = block.room();
    std::size_t out = room.size;
    std::size_t in = compressed.size - read;
    expected =
        LZ4F_decompress(context.get(), const_cast<std::byte*>(room.data), &out, compressed.data + read, &in, nullptr);
    if (LZ4F_isError(expected) != 0) throw FrameError(fmt::format("lz4: {}", LZ4F_getErrorName(expected)));
    read += in;
    block.fill(out);
    if (expected != 0 && in == 0 && out == 0) {
      throw FrameError(block.is_full() ? say("lz4: more than the {} bytes announced come out of it", size)
                                       : std::string("lz4: the compressed bytes end too early"));
    }
  }
  if (read != compressed.size) throw FrameError(say("lz4: {} bytes follow its end", compressed.size - read));
  return block.take();
}

}  // namespace pose_wall::tools

#else

namespace pose_wall::tools {

Bytes decompress_lz4(ByteView /*compressed*/, std::uint64_t /*size*/) {
  throw FrameError(missing_support("lz4", "liblz4-dev", "POSE_WALL_READ_LZ4"));
}

}  // namespace pose_wall::tools

#endif
