// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frames/pcd_writer.hpp"

#include <fmt/format.h>

#include <string>

#include "frames/whole_file.hpp"

namespace pose_wall::tools {

void write_pcd_binary(const std::filesystem::path& file, const float* xyz_intensity, std::size_t count,
                      std::int64_t stamp_ns) {
  std::string bytes = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\n# stamp_ns {1}\nVERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\n"
      "TYPE F F F F\nCOUNT 1 1 1 1\nWIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n",
      count, stamp_ns);
  bytes.append(reinterpret_cast<const char*>(xyz_intensity), 4 * sizeof(float) * count);
  write_whole_file(file, bytes);
}

}  // namespace pose_wall::tools
