// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frames/load_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <ios>
#include <string_view>
#include <system_error>
#include <utility>

#include "frames/kitti_reader.hpp"
#include "frames/pcd_reader.hpp"
#include "frames/ply_reader.hpp"

namespace pose_wall::tools {
namespace {

// Two thousand million bytes are a hundred times the largest frame of any sensor on the market.
constexpr std::uintmax_t kFileBytesMax = 2'000'000'000;

using Reader = Frame (*)(Bytes);

struct Format {
  std::string_view ending;
  Reader read;
};

constexpr std::array<Format, 3> kFormats = {{{".pcd", read_pcd}, {".bin", read_kitti}, {".ply", read_ply}}};

const Format* find_format(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto format =
      std::find_if(kFormats.begin(), kFormats.end(), [&ending](const Format& known) { return known.ending == ending; });
  return format != kFormats.end() ? &*format : nullptr;
}

// What a file begins with tells more than how it is called.
Reader reader_by_content(const Bytes& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 16));
  const auto begins_with = [text](std::string_view words) { return text.substr(0, words.size()) == words; };
  if (begins_with("# .PCD") || begins_with("VERSION ")) return read_pcd;
  if (begins_with("ply\n") || begins_with("ply\r\n")) return read_ply;
  return nullptr;
}

Bytes read_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw FrameError("not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw FrameError(error.message());
  if (size > kFileBytesMax) {
    throw FrameError(fmt::format("{} bytes; a frame file of at most {} bytes is read", size, kFileBytesMax));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FrameError(fmt::format("cannot be opened for reading: {}", std::strerror(errno)));
  Bytes bytes(static_cast<std::size_t>(size));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::uintmax_t>(file.gcount()) != size) {
    throw FrameError(fmt::format("only {} of {} bytes could be read", file.gcount(), size));
  }
  return bytes;
}

}  // namespace

std::string frame_endings_text() {
  return ".pcd, .bin (KITTI), .ply";
}

bool has_frame_ending(const std::filesystem::path& path) {
  return find_format(path) != nullptr;
}

Frame load_frame(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    const std::filesystem::path target = std::filesystem::read_symlink(path, error);  // empty where it is no link
    if (target.empty()) throw FrameError("not there: no such file or folder");
    throw FrameError(fmt::format("not there: it is a link to {}, which leads to no file", target.string()));
  }
  Bytes bytes = read_bytes(path);
  if (const Reader read = reader_by_content(bytes)) return read(std::move(bytes));
  const Format* format = find_format(path);
  if (format == nullptr) {
    throw FrameError(fmt::format("unknown ending '{}'; {} are read, and bags and captures by their content",
                                 path.extension().string(), frame_endings_text()));
  }
  return format->read(std::move(bytes));
}

}  // namespace pose_wall::tools
