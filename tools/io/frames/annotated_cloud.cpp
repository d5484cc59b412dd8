// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/annotated_cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string_view>

#include "io/frames/frame.hpp"
#include "io/picture/palette.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::string_view kMark = "pose_wall annotated cloud";

std::uint32_t rgb_of(std::uint8_t label) {
  const std::string digits(picture::label_colour(label).substr(1));
  return static_cast<std::uint32_t>(std::stoul(digits, nullptr, 16));
}

double height_over(const pose_wall_plane& plane, const double (&p_m)[3]) {
  if (plane.found == 0) return std::numeric_limits<double>::quiet_NaN();
  return plane.normal[0] * p_m[0] + plane.normal[1] * p_m[1] + plane.normal[2] * p_m[2] + plane.d_m;
}

// The floor's plane is given in base, the walls' in the levelled frame.
double residual_m(std::uint8_t label, const double (&p_base_m)[3], const pose_wall_result& result) {
  if (label == POSE_WALL_LABEL_FLOOR) return height_over(result.floor, p_base_m);
  if (label == POSE_WALL_LABEL_OTHER) return std::numeric_limits<double>::quiet_NaN();
  double p_level_m[3];
  for (std::size_t row = 0; row < 3; ++row) {
    const double* const R_row = &result.R_level_base[3 * row];
    p_level_m[row] = R_row[0] * p_base_m[0] + R_row[1] * p_base_m[1] + R_row[2] * p_base_m[2];
  }
  return height_over(label == POSE_WALL_LABEL_LEFT ? result.left : result.right, p_level_m);
}

// Little-endian, whatever machine writes it.
template <typename Number>
void append(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  if (host_is_big_endian()) std::reverse(std::begin(raw), std::end(raw));
  bytes.append(raw, sizeof raw);
}

void append_point(std::string& bytes, const AnnotatedPoint& p, CloudFormat format) {
  for (const float coordinate_m : {p.x_base_m, p.y_base_m, p.z_base_m}) append(bytes, coordinate_m);
  if (format == CloudFormat::kPcd) {
    append(bytes, p.label);
    append(bytes, p.residual_m);
    append(bytes, p.rgb);
    return;
  }
  for (const int shift : {16, 8, 0}) bytes += static_cast<char>(p.rgb >> shift & 255U);
  append(bytes, static_cast<float>(p.label));
  append(bytes, p.residual_m);
}

// PCL keeps colours in the bytes of a float; viewers look for just that.
std::string pcd_head(std::size_t count, const std::string& comment) {
  return fmt::format(
      "# .PCD v0.7 - {0}\n# {1}\nVERSION 0.7\nFIELDS x y z label residual_m rgb\nSIZE 4 4 4 4 4 4\nTYPE F F F U F F\n"
      "COUNT 1 1 1 1 1 1\nWIDTH {2}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {2}\nDATA binary\n",
      kMark, comment, count);
}

// Of a PLY CloudCompare opens with what is called scalar_, and Open3D drops a label that is no float.
std::string ply_head(std::size_t count, const std::string& comment) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\ncomment {}\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property float scalar_label\nproperty float scalar_residual_m\nend_header\n",
      kMark, comment, count);
}

}  // namespace

std::vector<AnnotatedPoint> annotated_points(const pose_wall_points& points, const pose_wall_result& result) {
  std::vector<AnnotatedPoint> all;
  all.reserve(points.count);
  for (std::uint32_t i = 0; i < points.count; ++i) {
    const double p_base_m[3] = {points.x_base_m[i], points.y_base_m[i], points.z_base_m[i]};
    const std::uint8_t label = points.label[i];
    all.push_back({points.x_base_m[i], points.y_base_m[i], points.z_base_m[i], label,
                   static_cast<float>(residual_m(label, p_base_m, result)), rgb_of(label)});
  }
  return all;
}

std::string annotated_cloud(const std::vector<AnnotatedPoint>& points, CloudFormat format, const std::string& comment) {
  std::string line = comment;
  // A line break in a name would end the comment.
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  std::string file = format == CloudFormat::kPcd ? pcd_head(points.size(), line) : ply_head(points.size(), line);
  for (const AnnotatedPoint& point : points) append_point(file, point, format);
  return file;
}

bool is_annotated_cloud(const std::string& beginning) {
  return beginning.find(kMark) != std::string::npos;
}

}  // namespace pose_wall::tools
