// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"

namespace pose_wall::tools {
namespace {

bool write_part(const std::filesystem::path& part, std::string_view bytes) {
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  return static_cast<bool>(out);
}

void write_file(const std::filesystem::path& file, std::string_view bytes, bool survives_power_cut) {
  const std::filesystem::path part = part_of(file);
  std::error_code error, ignored;
  const bool written = write_part(part, bytes);
  // First the bytes, then the name: or the name could be that of an empty file.
  if (written && survives_power_cut) error = sync_to_disk(part);
  if (written && !error) std::filesystem::rename(part, file, error);
  if (!written || error) {
    std::filesystem::remove(part, ignored);
    throw std::runtime_error(
        say("{}: cannot be written{}", file.string(), error ? ": " + system_error_text(error.value()) : ""));
  }
  // The file is whole by now. A file system that does not sync folders keeps their names in order by itself.
  const std::filesystem::path folder = file.parent_path();
  if (survives_power_cut) static_cast<void>(sync_to_disk(folder.empty() ? "." : folder));
}

}  // namespace

std::error_code sync_to_disk(const std::filesystem::path& path) {
  const int opened = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool is_synced = opened >= 0 && fsync(opened) == 0;
  const std::error_code error = is_synced ? std::error_code() : std::error_code(errno, std::generic_category());
  if (opened >= 0) close(opened);
  return error;
}

std::filesystem::path part_of(const std::filesystem::path& file) {
  return file.string() + ".pose_wall.part";
}

void write_whole_file(const std::filesystem::path& file, std::string_view bytes) {
  write_file(file, bytes, false);
}

void write_lasting_file(const std::filesystem::path& file, std::string_view bytes) {
  write_file(file, bytes, true);
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
