// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A file that is written whole or not at all.

#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools {

class OutputFile {
 public:
  // Opens its part, so that what cannot be written is known before the work is done. Throws
  // std::invalid_argument when that fails or when the path is one of the inputs. option: what the path was given by.
  OutputFile(const std::string& path, const std::vector<std::filesystem::path>& inputs,
             const char* option = "--output");
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();  // without write(): what was there before stays

  // Then it takes the path's place. Throws std::runtime_error that names the file.
  void write(std::string_view text);

  // For who writes the part himself: where it is, and then it takes the path's place. Throws likewise.
  std::filesystem::path part() const;
  void take_part();

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

}  // namespace pose_wall::tools
