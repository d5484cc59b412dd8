// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "csv/csv_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace pose_wall::tools {

CsvTable read_csv_file(const std::string& file) {
  return in_csv_file(file, [&file] {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) throw CsvError("this is a folder; a table of CSV is allowed");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
      throw CsvError(fmt::format("cannot be opened for reading: {}{}", std::strerror(errno),
                                 file == "-" ? "; standard input is /dev/stdin" : ""));
    }
    return CsvTable::parse(stream);
  });
}

}  // namespace pose_wall::tools
