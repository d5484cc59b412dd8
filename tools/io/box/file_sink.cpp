// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/box/file_sink.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace pose_wall::tools {

FileSink::FileSink(const std::string& path)
    : file_(open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH)) {
  if (file_ < 0) throw std::runtime_error(path + ": " + std::strerror(errno));
  struct stat about {};
  if (fstat(file_, &about) == 0 && about.st_size == 0) return;
  close(file_);
  throw std::runtime_error(path + ": is there already and may be an incident's: move it away, or name another file");
}

FileSink::~FileSink() {
  if (file_ >= 0) close(file_);
}

std::int32_t FileSink::write(void* user, std::uint64_t offset, const void* bytes, std::uint64_t count) {
  const int file = static_cast<FileSink*>(user)->file_;
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = pwrite(file, from, count, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return -1;
    from += written;
    offset += static_cast<std::uint64_t>(written);
    count -= static_cast<std::uint64_t>(written);
  }
  return 0;
}

}  // namespace pose_wall::tools
