// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a file holds, by the bytes it begins with. Its name does not count.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pose_wall::tools {

enum class FileContent {
  kEmpty,
  kUnknown,  // no bytes that a known format begins with: bare numbers, or a file too short to tell
  kPcd,
  kPly,
  kText,
  kRos1Bag,
  kMcap,
  kSqlite,
  kCapture,
  kForeign  // a known format that is not read: foreign_advice() says what to do
};

// The first 4 KiB, or fewer; empty where the file cannot be read.
std::string beginning_of(const std::filesystem::path& file);

FileContent content_of(std::string_view beginning);

// "PCD", "a ROS 1 bag"; empty for kEmpty, kUnknown and kForeign.
std::string content_name(FileContent content);

// Of kForeign: "this is a gzip archive; unpack it first: gunzip FILE".
std::string foreign_advice(std::string_view beginning);

// True where the content leaves the ending of the name to decide.
bool ending_decides(FileContent content);

}  // namespace pose_wall::tools
