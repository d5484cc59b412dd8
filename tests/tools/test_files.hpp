// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Files of frames made in memory, frames read back as numbers, and damage done to files.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "io/frames/frame.hpp"

namespace pose_wall::tools::test {

inline Bytes bytes_of(const std::string& text) {
  Bytes bytes(text.size());
  if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

// A number as it stands in memory (little-endian on every machine the tests run on), or turned round.
template <typename Number>
std::string raw(Number number, bool big_endian = false) {
  std::string text(sizeof number, '\0');
  std::memcpy(text.data(), &number, sizeof number);
  if (big_endian) std::reverse(text.begin(), text.end());
  return text;
}

// What the engine would read at `field` of a point.
inline double number_at(const Frame& frame, const pose_wall_field& field, std::uint32_t point) {
  const auto* start =
      static_cast<const char*>(frame.cloud.data) + std::size_t{point} * frame.cloud.point_step + field.offset;
  std::string text(start, field.type == POSE_WALL_FIELD_FLOAT64 ? 8 : 4);
  if (frame.cloud.big_endian != 0) std::reverse(text.begin(), text.end());
  if (field.type == POSE_WALL_FIELD_FLOAT64) {
    double number = 0;
    std::memcpy(&number, text.data(), sizeof number);
    return number;
  }
  float number = 0;
  std::memcpy(&number, text.data(), sizeof number);
  return static_cast<double>(number);
}

// Message of the FrameError that reading gives; empty when it is read.
template <typename Reader>
std::string refusal(Reader read, const std::string& file) {
  try {
    const Frame frame = read(bytes_of(file));
    // Every byte that is described lies within the frame's own bytes.
    const auto* end = frame.bytes.data() + frame.bytes.size();
    const auto* data = static_cast<const std::byte*>(frame.cloud.data);
    if (frame.cloud.data_bytes > static_cast<std::size_t>(end - data)) return "describes more than it holds";
    return "";
  } catch (const FrameError& error) {
    return error.what();
  }
}

// Cuts the file at every length and flips bytes of it: whatever comes out, it is a frame within its bytes or a
// FrameError. Anything else (another exception, a read past the end under a sanitizer) fails the test.
template <typename Reader>
bool survives_damage(Reader read, const std::string& file) {
  for (std::size_t length = 0; length < file.size(); ++length) {
    if (refusal(read, file.substr(0, length)) == "describes more than it holds") return false;
  }
  std::mt19937 random(7);
  for (int round = 0; round < 4000; ++round) {
    std::string damaged = file;
    for (int flips = 0; flips < 1 + round % 3; ++flips) {
      damaged[random() % damaged.size()] = static_cast<char>(random());
    }
    if (refusal(read, damaged) == "describes more than it holds") return false;
  }
  return true;
}

// All of a file; empty where there is none.
inline std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A folder of its own for each test, gone afterwards.
class TempFolder {
 public:
  TempFolder() {
    std::random_device seed;
    path_ = std::filesystem::temp_directory_path() / ("pose_wall_test_" + std::to_string(seed()));
    std::filesystem::create_directories(path_);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace pose_wall::tools::test
