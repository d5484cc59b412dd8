// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: PLY files of all three encodings give their vertices, wherever element vertex stands, and bad ones are
// refused.

#include "frames/ply_reader.hpp"

#include <gtest/gtest.h>

#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using test::bytes_of;
using test::contains;
using test::number_at;
using test::raw;
using test::refusal;

std::string vertex_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment made by a test\nelement vertex 2\nproperty uchar red\nproperty float x\nproperty double y\n"
         "property float z\nproperty ushort intensity\nend_header\n";
}

std::string vertex(float x, double y, float z, bool big) {
  return "r" + raw(x, big) + raw(y, big) + raw(z, big) + raw(std::uint16_t{500}, big);
}

TEST(PlyReader, BothByteOrdersAreDescribedInPlace) {
  for (const bool big : {false, true}) {
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    const Frame frame = read_ply(bytes_of(vertex_header(format) + vertex(1, 2, 3, big) + vertex(-4, 0.1, 6, big)));
    ASSERT_EQ(frame.cloud.width, 2U);
    EXPECT_EQ(frame.cloud.big_endian, big ? 1U : 0U);
    EXPECT_EQ(frame.cloud.point_step, 19U);
    EXPECT_EQ(number_at(frame, frame.cloud.x, 1), -4.0);
    EXPECT_EQ(number_at(frame, frame.cloud.y, 1), 0.1);
    EXPECT_EQ(number_at(frame, frame.cloud.z, 1), 6.0);
    EXPECT_EQ(frame.cloud.intensity.type, static_cast<std::uint32_t>(POSE_WALL_FIELD_UINT16));
  }
}

TEST(PlyReader, AsciiWithCrlf) {
  const Frame frame = read_ply(bytes_of(
      "ply\r\nformat ascii 1.0\r\nelement camera 1\r\nproperty float f\r\nelement vertex 1\r\nproperty float x\r\n"
      "property float y\r\nproperty double z\r\nend_header\r\n35\r\n1 2 0.1\r\n"));
  ASSERT_EQ(frame.cloud.width, 1U);
  EXPECT_EQ(number_at(frame, frame.cloud.y, 0), 2.0);
  EXPECT_EQ(number_at(frame, frame.cloud.z, 0), 0.1);
}

TEST(PlyReader, ListsInElementsBeforeTheVerticesArePassedOver) {
  for (const bool big : {false, true}) {
    const std::string head =
        std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
        " 1.0\nelement face 2\nproperty list uchar int index\nproperty uchar flag\nelement empty 9\n"
        "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "element face2 1\nproperty list ushort double w\nend_header\n";
    const std::string faces = std::string("\x02") + "aaaabbbb" + "f" + std::string("\x00", 1) + "f";
    const std::string point = raw(1.0F, big) + raw(2.0F, big) + raw(3.0F, big);
    const Frame frame = read_ply(bytes_of(head + faces + point + "tail"));
    ASSERT_EQ(frame.cloud.width, 1U);
    EXPECT_EQ(number_at(frame, frame.cloud.x, 0), 1.0);
    EXPECT_EQ(number_at(frame, frame.cloud.z, 0), 3.0);
    EXPECT_TRUE(contains(refusal(read_ply, head + std::string("\xFF") + "aaaa"), "ends before element vertex"));
  }
}

TEST(PlyReader, BadFilesAreRefusedWithTheirFault) {
  const std::string little = vertex_header("binary_little_endian");
  const std::pair<std::string, const char*> cases[] = {
      {"", "no PLY header: the file is empty"},
      {"plyx\n", "not 'ply'"},
      {"ply\nformat ascii 1.0\n", "no end_header"},
      {"ply\nend_header\n", "format is missing"},
      {"ply\nformat ascii 2.0\n", "line 2: PLY version '2.0'"},
      {"ply\nformat text 1.0\n", "format 'text'"},
      {"ply\nformat ascii 1.0\nend_header\n", "no element vertex"},
      {"ply\nformat ascii 1.0\nproperty float x\n", "line 3: property before"},
      {"ply\nformat ascii 1.0\nelement vertex few\n", "count 'few'"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n", "'quad' is no PLY type"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\n", "must be a whole number"},
      {"ply\nformat ascii 1.0\nsurprise\n", "unknown keyword 'surprise'"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int x\nend_header\n", "is a list"},
      {"ply\nformat binary_little_endian 1.0\nelement vertex 1\nend_header\n", "no properties"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float y\nend_header\n1\n", "'x' is missing"},
      {"ply\nformat ascii 1.0\nelement a 9\nproperty float f\nelement vertex 1\nproperty float x\nend_header\n1\n",
       "ends before element vertex"},
      {little + vertex(1, 2, 3, false), "declares 2 points of 19 bytes"},
  };
  for (const auto& [file, part] : cases) {
    const std::string message = refusal(read_ply, file);
    EXPECT_TRUE(contains(message, part)) << part << " | " << message;
  }
}

TEST(PlyReader, SurvivesDamage) {
  const std::string body = vertex(1, 2, 3, false) + vertex(4, 5, 6, false);
  EXPECT_TRUE(test::survives_damage(read_ply, vertex_header("binary_little_endian") + body));
  EXPECT_TRUE(test::survives_damage(read_ply, vertex_header("ascii") + "1 2 3 4 5\n1 2 3 4 5\n"));
  EXPECT_TRUE(test::survives_damage(read_ply,
                                    "ply\nformat binary_big_endian 1.0\nelement face 3\nproperty list uint int "
                                    "i\nelement vertex 1\nproperty float x\n"
                                    "property float y\nproperty float z\nend_header\n" +
                                        std::string(40, '\0')));
}

}  // namespace
}  // namespace pose_wall::tools
