// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/csv/csv_file.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"

namespace pose_wall::tools {

CsvTable read_csv_file(const std::string& file) {
  return in_csv_file(file, [&file] {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) throw CsvError(tr("this is a folder; a table of CSV is allowed"));
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
      throw CsvError(say("cannot be opened for reading: {}{}", system_error_text(errno),
                         file == "-" ? tr("; standard input is /dev/stdin") : ""));
    }
    return CsvTable::parse(stream);
  });
}

}  // namespace pose_wall::tools
