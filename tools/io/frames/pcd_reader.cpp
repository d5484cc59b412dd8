// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/pcd_reader.hpp"

#include <fmt/format.h>

#include <cstring>
#include <utility>

#include "io/frames/pcd_ascii.hpp"
#include "io/frames/pcd_compressed.hpp"
#include "io/frames/pcd_header.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

PointLayout layout_of(const PcdHeader& header) {
  PointLayout layout;
  layout.point_step = header.point_step;
  for (const PcdField& field : header.fields) {
    if (field.name != "_") layout.fields.push_back({field.name, {field.offset, field_type_of(field)}});
  }
  return layout;
}

Frame read_binary(Bytes bytes, const PcdHeader& header) {
  PointLayout layout = layout_of(header);
  layout.data_offset = header.data_offset;
  const std::uint64_t available = bytes.size() - header.data_offset;
  layout.count = count_points(points_or_held(header, available), available, header.point_step);
  return describe_frame(std::move(bytes), layout);
}

Frame read_compressed(const Bytes& bytes, const PcdHeader& header) {
  PointLayout layout = layout_of(header);
  Bytes points = decompress_pcd_points(bytes, header);
  layout.count = static_cast<std::uint32_t>(points.size() / header.point_step);
  return describe_frame(std::move(points), layout);
}

Frame read_points(Bytes bytes, const PcdHeader& header) {
  switch (header.encoding) {
    case PcdEncoding::kAscii:
      return parse_pcd_ascii(bytes, header);
    case PcdEncoding::kBinary:
      return read_binary(std::move(bytes), header);
    case PcdEncoding::kBinaryCompressed:
      return read_compressed(bytes, header);
  }
  throw FrameError(tr("PCD header: unknown encoding"));
}

}  // namespace

Frame read_pcd(Bytes bytes) {
  const PcdHeader header = parse_pcd_header(bytes);
  Frame frame = read_points(std::move(bytes), header);
  frame.stamp_ns = header.stamp_ns;
  return frame;
}

}  // namespace pose_wall::tools
