// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frames/whole_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "language/language.hpp"
#include "language/system_errors.hpp"

namespace pose_wall::tools {
namespace {

bool write_part(const std::filesystem::path& part, std::string_view bytes) {
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  return static_cast<bool>(out);
}

}  // namespace

std::filesystem::path part_of(const std::filesystem::path& file) {
  return file.string() + ".pose_wall.part";
}

void write_whole_file(const std::filesystem::path& file, std::string_view bytes) {
  const std::filesystem::path part = part_of(file);
  std::error_code error, ignored;
  const bool written = write_part(part, bytes);
  if (written) std::filesystem::rename(part, file, error);
  if (written && !error) return;
  std::filesystem::remove(part, ignored);
  throw std::runtime_error(
      say("{}: cannot be written{}", file.string(), error ? ": " + system_error_text(error.value()) : ""));
}

std::string read_whole_file(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.is_open() || in.bad() || (bytes.empty() && errno != 0)) {
    throw std::runtime_error(say("{}: cannot be read: {}", file.string(), system_error_text(errno)));
  }
  return bytes;
}

}  // namespace pose_wall::tools
