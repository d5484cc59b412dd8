// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/decompress.hpp"

#if POSE_WALL_HAS_BZIP2
#include <bzlib.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

class BzipStream {
 public:
  explicit BzipStream(ByteView compressed) {
    // The library takes its input by a pointer to non-const, but only reads.
    stream_.next_in = reinterpret_cast<char*>(const_cast<std::byte*>(compressed.data));
    stream_.avail_in = static_cast<unsigned>(compressed.size);
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw FrameError(tr("bz2: no memory"));
  }
  BzipStream(const BzipStream&) = delete;
  BzipStream& operator=(const BzipStream&) = delete;
  ~BzipStream() { BZ2_bzDecompressEnd(&stream_); }

  // Bytes written into the room; `status` is BZ_OK, BZ_STREAM_END or an error.
  std::size_t step(ByteView room, int& status) {
    const auto size = static_cast<unsigned>(std::min<std::size_t>(room.size, std::numeric_limits<unsigned>::max()));
    stream_.next_out = reinterpret_cast<char*>(const_cast<std::byte*>(room.data));
    stream_.avail_out = size;
    status = BZ2_bzDecompress(&stream_);
    return size - stream_.avail_out;
  }

  std::size_t left() const { return stream_.avail_in; }

 private:
  bz_stream stream_{};
};

}  // namespace

Bytes decompress_bzip2(ByteView compressed, std::uint64_t size) {
  if (compressed.size > std::numeric_limits<unsigned>::max()) throw FrameError(tr("bz2: the block is too large"));
  BzipStream stream(compressed);
  GrowingBlock block(size);
  int status = BZ_OK;
  while (status != BZ_STREAM_END) {
    const std::size_t in_before = stream.left();
    const std::size_t out = stream.step(block.room(), status);
    if (status != BZ_OK && status != BZ_STREAM_END) throw FrameError(say("bz2: damaged (error {})", status));
    block.fill(out);
    if (status == BZ_OK && out == 0 && stream.left() == in_before) {
      throw FrameError(block.is_full() ? say("bz2: more than the {} bytes announced come out of it", size)
                                       : std::string("bz2: the compressed bytes end too early"));
    }
  }
  if (stream.left() != 0) throw FrameError(say("bz2: {} bytes follow its end", stream.left()));
  return block.take();
}

}  // namespace pose_wall::tools

#else

namespace pose_wall::tools {

Bytes decompress_bzip2(ByteView /*compressed*/, std::uint64_t /*size*/) {
  throw FrameError(missing_support("bz2", "libbz2-dev", "POSE_WALL_READ_BZIP2"));
}

}  // namespace pose_wall::tools

#endif
