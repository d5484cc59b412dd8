// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Frame files of any format to one file of bare points, for pose_wall_digest, which has no library to read formats
// with:
//
//   pose_wall_to_xyz OUT FRAME...      one frame after the other: a uint32 count, then x y z as float32

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <vector>

#include "io/frames/load_frame.hpp"

namespace {

using pose_wall::tools::Frame;

template <typename Number>
float number_at(const std::byte* at, bool swapped) {
  std::byte bytes[sizeof(Number)];
  std::copy_n(at, sizeof bytes, bytes);
  if (swapped) std::reverse(bytes, bytes + sizeof bytes);
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<float>(number);
}

std::vector<float> points_of(const Frame& frame) {
  const pose_wall_cloud& cloud = frame.cloud;
  const bool swapped = cloud.big_endian != 0;  // the machine this runs on is little-endian
  const std::size_t row_step = cloud.row_step != 0 ? cloud.row_step : std::size_t{cloud.width} * cloud.point_step;
  std::vector<float> out;
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      const std::byte* point = static_cast<const std::byte*>(cloud.data) + row * row_step + column * cloud.point_step;
      for (const pose_wall_field& f : {cloud.x, cloud.y, cloud.z}) {
        out.push_back(f.type == POSE_WALL_FIELD_FLOAT64 ? number_at<double>(point + f.offset, swapped)
                                                        : number_at<float>(point + f.offset, swapped));
      }
    }
  }
  return out;
}

void append(const char* path, std::ofstream* file) {
  const std::vector<float> points = points_of(pose_wall::tools::load_frame(path));
  const auto count = static_cast<std::uint32_t>(points.size() / 3);
  file->write(reinterpret_cast<const char*>(&count), sizeof count);
  file->write(reinterpret_cast<const char*>(points.data()),
              static_cast<std::streamsize>(points.size() * sizeof(float)));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: pose_wall_to_xyz OUT FRAME...\n", stderr);
    return EXIT_FAILURE;
  }
  std::ofstream file(argv[1], std::ios::binary);
  for (int i = 2; i < argc; ++i) {
    try {
      append(argv[i], &file);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", argv[i], error.what());
      return EXIT_FAILURE;
    }
  }
  file.flush();
  return file ? EXIT_SUCCESS : EXIT_FAILURE;
}
