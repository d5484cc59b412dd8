// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/ply_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "io/frames/ascii_points.hpp"
#include "io/frames/field_aliases.hpp"
#include "io/frames/ply_header.hpp"
#include "io/frames/text_cursor.hpp"
#include "io/frames/wide_times.hpp"
#include "io/language/language.hpp"

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

// CloudCompare puts "scalar_" before what it writes and keeps capitals: "scalar_Time". Names that would be there twice
// stay.
std::vector<std::string> names_of(const std::vector<PlyProperty>& properties) {
  constexpr std::string_view kMark = "scalar_";
  std::vector<std::string> names;
  for (const PlyProperty& property : properties) names.push_back(property.name);
  for (std::string& name : names) {
    if (name.rfind(kMark, 0) != 0) continue;
    std::string bare = name.substr(kMark.size());
    std::transform(bare.begin(), bare.end(), bare.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (field_role(bare) == FieldRole::kNone || field_role(bare) == FieldRole::kCoordinate) continue;
    if (std::find(names.begin(), names.end(), bare) == names.end()) name = bare;
  }
  return names;
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
        advance(items * field_type_bytes(property.type));
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
    const std::uint32_t size = field_type_bytes(type);
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
  const std::vector<PlyProperty>& properties = header.elements[vertex].properties;
  const std::vector<std::string> names = names_of(properties);
  for (std::size_t i = 0; i < properties.size(); ++i) {
    const PlyProperty& property = properties[i];
    layout.fields.push_back({names[i], {layout.point_step, property.type}});
    layout.point_step += field_type_bytes(property.type);
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
  const std::vector<PlyProperty>& properties = header.elements[vertex].properties;
  const std::vector<std::string> names = names_of(properties);
  for (std::size_t i = 0; i < properties.size(); ++i) {
    const PlyProperty& property = properties[i];
    // Whole numbers of four bytes (a time in microseconds) do not fit a float32.
    const bool is_double =
        field_type_bytes(property.type) >= 4 && property.type != static_cast<std::uint32_t>(POSE_WALL_FIELD_FLOAT32);
    columns.push_back({names[i], 1, is_double});
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
