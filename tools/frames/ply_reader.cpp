// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frames/ply_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "frames/ascii_points.hpp"
#include "frames/ply_header.hpp"
#include "frames/text_cursor.hpp"
#include "language/language.hpp"

namespace pose_wall::tools {
namespace {

std::size_t vertex_index(const PlyHeader& header) {
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const PlyElement& element) { return element.name == "vertex"; });
  if (vertex == header.elements.end()) throw FrameError(tr("PLY: there is no element vertex"));
  for (const PlyProperty& property : vertex->properties) {
    if (property.is_list()) {
      throw FrameError(
          say("PLY: property '{}' of element vertex is a list; only single values are read there", property.name));
    }
  }
  return static_cast<std::size_t>(vertex - header.elements.begin());
}

// Binary lists before the points: their lengths are data, so every step is checked against the end.
class BinaryWalk {
 public:
  BinaryWalk(const Bytes& bytes, std::size_t offset, bool big_endian)
      : bytes_(bytes), offset_(offset), big_endian_(big_endian) {}

  void pass_element(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      const std::size_t start = offset_;
      for (const PlyProperty& property : element.properties) {
        const std::uint64_t items = property.is_list() ? take_length(property.length_type) : 1;
        advance(items * field_bytes(property.type));
      }
      if (offset_ == start) return;  // an element without properties takes no bytes, whatever its count
    }
  }

  std::size_t offset() const { return offset_; }

 private:
  void advance(std::uint64_t step) {
    if (step > bytes_.size() - offset_) throw FrameError(tr("PLY: the file ends before element vertex"));
    offset_ += static_cast<std::size_t>(step);
  }

  std::uint64_t take_length(std::uint32_t type) {
    const std::size_t start = offset_;
    const std::uint32_t size = field_bytes(type);
    advance(size);
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t from = start + (big_endian_ ? i : size - 1 - i);
      length = length << 8U | std::to_integer<std::uint64_t>(bytes_[from]);
    }
    return length;
  }

  const Bytes& bytes_;
  std::size_t offset_;
  bool big_endian_;
};

Frame read_binary(Bytes bytes, const PlyHeader& header, std::size_t vertex) {
  PointLayout layout;
  layout.big_endian = header.encoding == PlyEncoding::kBinaryBigEndian;
  BinaryWalk walk(bytes, header.data_offset, layout.big_endian);
  for (std::size_t i = 0; i < vertex; ++i) walk.pass_element(header.elements[i]);
  layout.data_offset = walk.offset();
  for (const PlyProperty& property : header.elements[vertex].properties) {
    layout.fields.push_back({property.name, {layout.point_step, property.type}});
    layout.point_step += field_bytes(property.type);
  }
  if (layout.point_step == 0) throw FrameError(tr("PLY: element vertex has no properties"));
  layout.count = count_points(header.elements[vertex].count, bytes.size() - layout.data_offset, layout.point_step);
  return describe_frame(std::move(bytes), layout);
}

Frame read_ascii(const Bytes& bytes, const PlyHeader& header, std::size_t vertex) {
  TextCursor cursor(as_text(bytes), header.data_offset, header.lines);
  for (std::size_t i = 0; i < vertex; ++i) {
    for (std::uint64_t k = 0; k < header.elements[i].count; ++k) {
      if (!cursor.next_line()) throw FrameError(tr("PLY: the file ends before element vertex"));
    }
  }
  std::vector<AsciiColumn> columns;
  for (const PlyProperty& property : header.elements[vertex].properties) {
    const bool is_double = property.type == POSE_WALL_FIELD_FLOAT64 || property.type == POSE_WALL_FIELD_INT32 ||
                           property.type == POSE_WALL_FIELD_UINT32;
    columns.push_back({property.name, 1, is_double});
  }
  return parse_ascii_points(cursor, columns, header.elements[vertex].count);
}

}  // namespace

Frame read_ply(Bytes bytes) {
  const PlyHeader header = parse_ply_header(bytes);
  const std::size_t vertex = vertex_index(header);
  if (header.encoding == PlyEncoding::kAscii) return read_ascii(bytes, header, vertex);
  return read_binary(std::move(bytes), header, vertex);
}

}  // namespace pose_wall::tools
