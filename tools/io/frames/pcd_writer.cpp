// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/pcd_writer.hpp"

#include <fmt/format.h>

#include <string>

#include "io/frames/whole_file.hpp"

namespace pose_wall::tools {
namespace {

// fields, sizes, types, counts: words of as many columns as a point has.
std::string head(const char* fields, const char* sizes, const char* types, const char* counts, std::size_t count,
                 std::int64_t stamp_ns) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\n# stamp_ns {5}\nVERSION 0.7\nFIELDS {0}\nSIZE {1}\nTYPE {2}\n"
      "COUNT {3}\nWIDTH {4}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {4}\nDATA binary\n",
      fields, sizes, types, counts, count, stamp_ns);
}

template <typename Number>
void append(const Number* numbers, std::size_t count, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(numbers), count * sizeof(Number));
}

}  // namespace

void write_pcd_binary(const std::filesystem::path& file, const float* xyz_intensity, std::size_t count,
                      std::int64_t stamp_ns) {
  std::string bytes = head("x y z intensity", "4 4 4 4", "F F F F", "1 1 1 1", count, stamp_ns);
  append(xyz_intensity, 4 * count, &bytes);
  write_whole_file(file, bytes);
}

void write_timed_pcd_binary(const std::filesystem::path& file, const float* xyz_intensity, const std::uint32_t* time_ns,
                            const std::uint16_t* ring, std::size_t count, std::int64_t stamp_ns) {
  std::string bytes = head("x y z intensity t ring", "4 4 4 4 4 2", "F F F F U U", "1 1 1 1 1 1", count, stamp_ns);
  for (std::size_t i = 0; i < count; ++i) {
    append(&xyz_intensity[4 * i], 4, &bytes);
    append(&time_ns[i], 1, &bytes);
    append(&ring[i], 1, &bytes);
  }
  write_whole_file(file, bytes);
}

}  // namespace pose_wall::tools
