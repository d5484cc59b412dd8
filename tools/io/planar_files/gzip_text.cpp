// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/planar_files/gzip_text.hpp"

#include <fstream>
#include <memory>

#include "io/bags/decompress.hpp"
#include "io/frames/frame.hpp"
#include "io/language/language.hpp"

#if POSE_WALL_HAS_ZLIB
#include <zlib.h>
#endif

namespace pose_wall::tools {
namespace {

bool is_gzip(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FrameError(tr("cannot be read"));
  char magic[2] = {};
  in.read(magic, sizeof magic);
  return in.gcount() == 2 && magic[0] == '\x1f' && magic[1] == '\x8b';
}

[[noreturn]] void refuse_size(std::uint64_t bytes_max) {
  throw FrameError(say("more than {} MiB", bytes_max >> 20U));
}

std::string plain_text(const std::filesystem::path& file, std::uint64_t bytes_max) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : -1;
  if (size < 0) throw FrameError(tr("cannot be read"));
  if (static_cast<std::uint64_t>(size) > bytes_max) refuse_size(bytes_max);
  std::string text(static_cast<std::size_t>(size), '\0');
  in.seekg(0);
  in.read(text.data(), size);
  if (in.gcount() != size) throw FrameError(tr("cannot be read"));
  return text;
}

#if POSE_WALL_HAS_ZLIB

struct CloseGzip {
  void operator()(gzFile_s* file) const { gzclose(file); }
};

std::string unpacked_text(const std::filesystem::path& file, std::uint64_t bytes_max) {
  const std::unique_ptr<gzFile_s, CloseGzip> archive(gzopen(file.c_str(), "rb"));
  if (!archive) throw FrameError(tr("cannot be read"));
  constexpr unsigned kStep = 1U << 20U;
  std::string text;
  for (;;) {
    const std::size_t filled = text.size();
    text.resize(filled + kStep);
    const int got = gzread(archive.get(), text.data() + filled, kStep);
    text.resize(filled + static_cast<std::size_t>(got > 0 ? got : 0));
    if (text.size() > bytes_max) refuse_size(bytes_max);
    if (got < static_cast<int>(kStep)) break;
  }
  int status = Z_OK;
  gzerror(archive.get(), &status);
  if (status == Z_BUF_ERROR) throw FrameError(tr("gzip: the archive is cut off"));
  if (status != Z_OK && status != Z_STREAM_END) throw FrameError(say("gzip: damaged (error {})", status));
  return text;
}

#else

std::string unpacked_text(const std::filesystem::path& /*file*/, std::uint64_t /*bytes_max*/) {
  throw FrameError(missing_support("gzip", "zlib1g-dev", "POSE_WALL_READ_ZLIB"));
}

#endif

}  // namespace

std::string read_text_or_gzip(const std::filesystem::path& file, std::uint64_t bytes_max) {
  return is_gzip(file) ? unpacked_text(file, bytes_max) : plain_text(file, bytes_max);
}

}  // namespace pose_wall::tools
