// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/outputs/output_folder.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"

namespace pose_wall::tools {
namespace {

// The path itself, or the nearest folder above it that is there.
std::filesystem::path existing_part(std::filesystem::path path) {
  std::error_code ignored;
  while (path.has_relative_path() && !std::filesystem::exists(path, ignored)) path = path.parent_path();
  return path;
}

}  // namespace

void make_output_folder(const std::string& path, std::string_view option) {
  if (path == "-") {
    throw std::invalid_argument(
        fmt::format("{} -: this is not written to standard output; a folder is allowed", option));
  }
  std::error_code error;
  const std::filesystem::path there = existing_part(path);
  if (!there.empty() && std::filesystem::exists(there, error) && !std::filesystem::is_directory(there, error)) {
    throw std::invalid_argument(
        fmt::format("{} {}: {} is a file; allowed is a folder, one that is there or one that can be made", option, path,
                    there.string()));
  }
  std::filesystem::create_directories(path, error);
  if (error)
    throw std::runtime_error(say("{} {}: cannot be made a folder: {}", option, path, system_error_text(error.value())));
}

}  // namespace pose_wall::tools
