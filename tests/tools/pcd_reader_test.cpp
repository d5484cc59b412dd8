// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: PCD files of every encoding give the points they hold, described in place where the format allows it;
// headers that lie are refused with both figures or corrected by the bytes. Does not prove: what the engine makes of
// it.

#include "io/frames/pcd_reader.hpp"

#include <gtest/gtest.h>

#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;
using ::testing::Test;

std::string header(const std::string& fields, const std::string& size, const std::string& type,
                   const std::string& count, const std::string& points, const std::string& data) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + size + "\nTYPE " +
         type + "\nCOUNT " + count + "\nWIDTH 0\nHEIGHT 0\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS " + points + "\nDATA " +
         data + "\n";
}

std::string xyz_header(const std::string& points, const std::string& data) {
  return header("x y z", "4 4 4", "F F F", "1 1 1", points, data);
}

std::string xyz(float x, float y, float z) {
  return raw(x) + raw(y) + raw(z);
}

// LZF without compression: runs of up to 32 literal bytes behind a byte that holds their number less one.
std::string lzf_literals(const std::string& plain) {
  std::string packed;
  for (std::size_t at = 0; at < plain.size(); at += 32) {
    const std::string run = plain.substr(at, 32);
    packed += static_cast<char>(run.size() - 1) + run;
  }
  return packed;
}

std::string packed_body(const std::string& plain) {
  const std::string packed = lzf_literals(plain);
  return raw(static_cast<std::uint32_t>(packed.size())) + raw(static_cast<std::uint32_t>(plain.size())) + packed;
}

TEST(PcdReader, BinaryIsDescribedInPlace) {
  const std::string head = xyz_header("2", "binary");
  const Frame frame = read_pcd(bytes_of(head + xyz(1, 2, 3) + xyz(-4, 5.5F, 6)));
  EXPECT_EQ(static_cast<const std::byte*>(frame.cloud.data), frame.bytes.data() + head.size());
  EXPECT_EQ(frame.cloud.struct_size, sizeof(pose_wall_cloud));
  EXPECT_EQ(frame.cloud.width, 2U);
  EXPECT_EQ(frame.cloud.height, 1U);
  EXPECT_EQ(frame.cloud.point_step, 12U);
  EXPECT_EQ(number_at(frame, frame.cloud.x, 1), -4.0);
  EXPECT_EQ(number_at(frame, frame.cloud.y, 1), 5.5);
  EXPECT_EQ(number_at(frame, frame.cloud.z, 0), 3.0);
  EXPECT_EQ(frame.cloud.intensity.type, static_cast<std::uint32_t>(POSE_WALL_FIELD_NONE));
}

TEST(PcdReader, PaddingFieldsAndMixedTypesGiveOffsets) {
  const std::string head =
      header("_ z intensity _ y t x", "1 4 2 1 8 4 8", "U F U U F U F", "3 1 1 4 1 1 1", "1", "binary");
  const std::string point =
      "abc" + raw(3.0F) + raw(std::uint16_t{77}) + "defg" + raw(2.0) + raw(std::uint32_t{9}) + raw(1.0);
  const Frame frame = read_pcd(bytes_of(head + point));
  EXPECT_EQ(frame.cloud.point_step, point.size());
  EXPECT_EQ(number_at(frame, frame.cloud.x, 0), 1.0);
  EXPECT_EQ(number_at(frame, frame.cloud.y, 0), 2.0);
  EXPECT_EQ(number_at(frame, frame.cloud.z, 0), 3.0);
  EXPECT_EQ(frame.cloud.intensity.offset, 7U);
  EXPECT_EQ(frame.cloud.intensity.type, static_cast<std::uint32_t>(POSE_WALL_FIELD_UINT16));
  EXPECT_EQ(frame.cloud.time.type, static_cast<std::uint32_t>(POSE_WALL_FIELD_UINT32));
}

TEST(PcdReader, AsciiAndCompressedHoldTheSamePointsAsBinary) {
  const std::string ascii = xyz_header("3", "ascii") + "1 2 3\n\n -4\t5.5 +6 \nnan NaN -inf\n7 8 9\n";
  const std::string columns =
      raw(1.0F) + raw(-4.0F) + raw(0.1F) + raw(2.0F) + raw(5.5F) + raw(0.2F) + raw(3.0F) + raw(6.0F) + raw(0.3F);
  const Frame from_ascii = read_pcd(bytes_of(ascii));
  const Frame from_packed = read_pcd(bytes_of(xyz_header("3", "binary_compressed") + packed_body(columns)));
  ASSERT_EQ(from_ascii.cloud.width, 3U);
  ASSERT_EQ(from_packed.cloud.width, 3U);
  for (const Frame* frame : {&from_ascii, &from_packed}) {
    EXPECT_EQ(number_at(*frame, frame->cloud.x, 0), 1.0);
    EXPECT_EQ(number_at(*frame, frame->cloud.x, 1), -4.0);
    EXPECT_EQ(number_at(*frame, frame->cloud.y, 1), 5.5);
    EXPECT_EQ(number_at(*frame, frame->cloud.z, 1), 6.0);
  }
  EXPECT_TRUE(std::isnan(number_at(from_ascii, from_ascii.cloud.x, 2)));
  EXPECT_EQ(number_at(from_packed, from_packed.cloud.z, 2), static_cast<double>(0.3F));
}

TEST(PcdReader, CrlfHeadersAndOldVersionsAreRead) {
  const std::string old =
      "VERSION .5\r\nCOLUMNS x y z\r\nSIZE 4 4 4\r\nTYPE F F F\r\nWIDTH 1\r\nHEIGHT 1\r\nDATA ascii\r\n1 2 3\r\n";
  const Frame frame = read_pcd(bytes_of(old));
  ASSERT_EQ(frame.cloud.width, 1U);
  EXPECT_EQ(number_at(frame, frame.cloud.z, 0), 3.0);
}

TEST(PcdReader, BoolsAndSmallLettersAreRead) {
  const std::string body = xyz(1, 2, 3) + "\x01" + xyz(4, 5, 6) + std::string("\x00", 1);
  EXPECT_EQ(
      read_pcd(bytes_of(header("x y z valid", "4 4 4 1", "F F F B", "1 1 1 1", "2", "binary") + body)).cloud.width, 2U);
  const Frame frame = read_pcd(bytes_of(
      "version 0.7\nfields x y z ring\nsize 4 4 4 1\ntype f f f u\ncount 1 1 1 1\nwidth 2\nheight 1\npoints 2\n"
      "data Binary\n" +
      body));
  EXPECT_EQ(number_at(frame, frame.cloud.x, 1), 4.0);
  EXPECT_EQ(frame.cloud.ring.type, static_cast<std::uint32_t>(POSE_WALL_FIELD_UINT8));
  EXPECT_TRUE(contains(refusal(read_pcd, header("x y z b", "4 4 4 4", "F F F B", "1 1 1 1", "0", "binary")), "SIZE 4"));
}

TEST(PcdReader, MoreBytesThanPointsAreIgnoredAndZeroPointsAreCountedByBytes) {
  const std::string body = xyz(1, 2, 3) + xyz(4, 5, 6);
  EXPECT_EQ(read_pcd(bytes_of(xyz_header("1", "binary") + body)).cloud.width, 1U);
  EXPECT_EQ(read_pcd(bytes_of(xyz_header("0", "binary") + body)).cloud.width, 2U);
  EXPECT_EQ(read_pcd(bytes_of(xyz_header("0", "ascii") + "1 2 3\n4 5 6\n")).cloud.width, 2U);
  EXPECT_EQ(read_pcd(bytes_of(xyz_header("0", "binary"))).cloud.width, 0U);
}

TEST(PcdReader, MissingPointsNameBothFigures) {
  const std::string binary = refusal(read_pcd, xyz_header("7", "binary") + xyz(1, 2, 3));
  EXPECT_TRUE(contains(binary, "7 points") && contains(binary, "hold 1")) << binary;
  const std::string ascii = refusal(read_pcd, xyz_header("7", "ascii") + "1 2 3\n");
  EXPECT_TRUE(contains(ascii, "7 points") && contains(ascii, "1 lines")) << ascii;
  const std::string packed = refusal(read_pcd, xyz_header("7", "binary_compressed") + packed_body(xyz(1, 2, 3)));
  EXPECT_TRUE(contains(packed, "84 bytes") && contains(packed, "12")) << packed;
}

TEST(PcdReader, SizesThatNoFileCouldFillAllocateNothing) {
  const std::string huge = header("x y z", "4 4 4", "F F F", "1 1 1", "300000000", "binary_compressed");
  const std::string lie = raw(std::uint32_t{4}) + raw(std::uint32_t{3'600'000'000U}) + "abcd";
  EXPECT_TRUE(contains(refusal(read_pcd, huge + lie), "cannot hold"));
  EXPECT_TRUE(contains(refusal(read_pcd, xyz_header("4000000000", "ascii")), "0 lines"));
  const std::string wide = header("x y z pad", "4 4 4 1", "F F F U", "1 1 1 99999999", "1", "binary");
  EXPECT_TRUE(contains(refusal(read_pcd, wide), "COUNT"));
}

TEST(PcdReader, DamagedCompressionIsRefused) {
  std::string body = packed_body(xyz(1, 2, 3));
  body[8] = static_cast<char>(0xFF);  // a reference to before the start
  EXPECT_TRUE(contains(refusal(read_pcd, xyz_header("1", "binary_compressed") + body), "damaged"));
  EXPECT_TRUE(contains(refusal(read_pcd, xyz_header("1", "binary_compressed") + "abc"), "8 bytes of sizes"));
  const std::string whole = packed_body(xyz(1, 2, 3));
  const std::string torn = whole.substr(0, whole.size() - 1);
  EXPECT_TRUE(contains(refusal(read_pcd, xyz_header("1", "binary_compressed") + torn), "13 bytes announced, 12 bytes"));
}

struct BadHeader {
  const char* name;
  std::string file;
  const char* message;
};

TEST(PcdReader, HeadersThatDoNotFitAreRefusedWithTheirFault) {
  const std::string body = xyz(1, 2, 3);
  const BadHeader cases[] = {
      {"no header", "hello", "no DATA line"},
      {"empty file", "", "no PCD header: the file is empty"},
      {"x missing", header("a y z", "4 4 4", "F F F", "1 1 1", "1", "binary") + body, "'x' is missing"},
      {"X large", header("X Y Z", "4 4 4", "F F F", "1 1 1", "1", "ascii") + "1 2 3\n",
       "'x' is missing; fields present: X, Y, Z (x, y and z are written small)"},
      {"unknown names", header("a b c", "4 4 4", "F F F", "1 1 1", "1", "ascii") + "1 2 3\n",
       "'x' is missing; fields present: a, b, c"},
      {"x twice", header("x x z", "4 4 4", "F F F", "1 1 1", "1", "binary") + body, "'x' appears twice"},
      {"x whole number", header("x y z", "4 4 4", "I F F", "1 1 1", "1", "binary") + body, "must be a float"},
      {"x twofold", header("x y z", "4 4 4", "F F F", "2 1 1", "0", "binary"), "must be a float"},
      {"few sizes", header("x y z", "4 4", "F F F", "1 1 1", "1", "binary") + body, "SIZE has 2 values for 3 FIELDS"},
      {"odd type", header("x y z", "4 4 4", "F F Q", "1 1 1", "1", "binary") + body, "TYPE 'Q'"},
      {"odd size", header("x y z", "4 4 3", "F F F", "1 1 1", "1", "binary") + body, "SIZE 3"},
      {"half float", header("x y z", "4 4 2", "F F F", "1 1 1", "1", "binary") + body, "SIZE 2"},
      {"count zero", header("x y z", "4 4 4", "F F F", "1 1 0", "1", "binary") + body, "COUNT is '0'"},
      {"points negative", xyz_header("-1", "binary") + body, "POINTS is '-1'"},
      {"points no number", xyz_header("many", "binary") + body, "POINTS is 'many'"},
      {"odd data", xyz_header("1", "zipped") + body, "DATA is 'zipped'"},
      {"odd version", "VERSION 0.8\nDATA ascii\n", "version '0.8'"},
      {"entry twice", "VERSION 0.7\nVERSION 0.7\nDATA ascii\n", "line 2: VERSION appears twice"},
      {"few values", xyz_header("1", "ascii") + "1 2\n", "line 12: 2 values, 3 expected"},
      {"no number", xyz_header("1", "ascii") + "1 2 three\n", "line 12: 'three' is not a number"},
  };
  for (const BadHeader& bad : cases) {
    const std::string message = refusal(read_pcd, bad.file);
    EXPECT_TRUE(contains(message, bad.message)) << bad.name << ": " << message;
  }
}

}  // namespace
}  // namespace pose_wall::tools
