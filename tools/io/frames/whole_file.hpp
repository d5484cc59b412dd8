// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Files as a whole: read at once; written so that they are there whole or not at all, whatever stops the program.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace pose_wall::tools {

// Where a file is written until it is whole: beside it, under a name that is nobody else's.
std::filesystem::path part_of(const std::filesystem::path& file);

// Writes its part, which then takes the file's place. Throws std::runtime_error that names the file.
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

// The same, and on the disk when it returns: a power cut leaves the file of before or this one. It waits for the disk.
void write_lasting_file(const std::filesystem::path& file, std::string_view bytes);

// Waits until a file's bytes, or a folder's names, are on the disk.
std::error_code sync_to_disk(const std::filesystem::path& path);

// Throws std::runtime_error that names the file.
std::string read_whole_file(const std::filesystem::path& file);

}  // namespace pose_wall::tools
