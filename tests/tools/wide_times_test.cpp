// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: times that are whole numbers of 64 bits reach the engine, from every encoding of PCD and PLY, of either sign
// and byte order, with gaps between rows; what the engine does not take, and bytes that two fields share, stay alone.

#include "io/frames/wide_times.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "io/frames/pcd_reader.hpp"
#include "io/frames/ply_reader.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::uint64_t kEpoch_ns = 1'700'000'000'000'000'000U;
constexpr std::uint64_t kScan_ns = 100'000'000U;
constexpr double kRounding_ns = 256.0;

std::string pcd(const std::string& time_type, const std::string& data, const std::string& body) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z timestamp\nSIZE 4 4 4 8\nTYPE F F F " + time_type +
         "\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA " + data + "\n" + body;
}

std::string point(std::uint64_t time, bool big_endian = false) {
  return raw(1.0F, big_endian) + raw(2.0F, big_endian) + raw(3.0F, big_endian) + raw(time, big_endian);
}

std::string ply(const std::string& format, const std::string& time_type, const std::string& body) {
  return "ply\nformat " + format + " 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n" +
         "property " + time_type + " timestamp\nend_header\n" + body;
}

// One run of literal bytes is a valid LZF stream; 40 bytes take two.
std::string packed(const std::string& plain) {
  const std::string lzf = char(31) + plain.substr(0, 32) + char(plain.size() - 33) + plain.substr(32);
  return raw(static_cast<std::uint32_t>(lzf.size())) + raw(static_cast<std::uint32_t>(plain.size())) + lzf;
}

void expect_times(const Frame& frame, double first, double second, const std::string& what) {
  ASSERT_EQ(frame.cloud.time.type, static_cast<std::uint32_t>(POSE_WALL_FIELD_FLOAT64)) << what;
  EXPECT_NEAR(number_at(frame, frame.cloud.time, 0), first, kRounding_ns) << what;
  EXPECT_NEAR(number_at(frame, frame.cloud.time, 1), second, kRounding_ns) << what;
  EXPECT_EQ(number_at(frame, frame.cloud.z, 1), 3.0) << what;
}

TEST(WideTimes, ReachTheEngineFromEveryEncoding) {
  const std::uint64_t last_ns = kEpoch_ns + kScan_ns;
  const auto first = static_cast<double>(kEpoch_ns), second = static_cast<double>(last_ns);
  const std::string binary = point(kEpoch_ns) + point(last_ns);
  const std::string big = point(kEpoch_ns, true) + point(last_ns, true);
  const std::string ascii = "1 2 3 " + std::to_string(kEpoch_ns) + "\n1 2 3 " + std::to_string(last_ns) + "\n";
  const std::string columns =
      raw(1.0F) + raw(1.0F) + raw(2.0F) + raw(2.0F) + raw(3.0F) + raw(3.0F) + raw(kEpoch_ns) + raw(last_ns);
  for (const std::string type : {"U", "I"}) {
    expect_times(read_pcd(bytes_of(pcd(type, "binary", binary))), first, second, "PCD binary " + type);
    expect_times(read_pcd(bytes_of(pcd(type, "binary_compressed", packed(columns)))), first, second, "packed " + type);
    expect_times(read_pcd(bytes_of(pcd(type, "ascii", ascii))), first, second, "PCD ascii " + type);
  }
  for (const std::string type : {"uint64", "int64"}) {
    expect_times(read_ply(bytes_of(ply("binary_little_endian", type, binary))), first, second, "PLY little " + type);
    expect_times(read_ply(bytes_of(ply("binary_big_endian", type, big))), first, second, "PLY big " + type);
    expect_times(read_ply(bytes_of(ply("ascii", type, ascii))), first, second, "PLY ascii " + type);
  }
}

TEST(WideTimes, CountFromTheStampOrBeforeItAsTheFileSays) {
  const std::string before = point(static_cast<std::uint64_t>(-std::int64_t{kScan_ns})) + point(0);
  const Frame frame = read_pcd(bytes_of(pcd("I", "binary", before)));
  EXPECT_EQ(number_at(frame, frame.cloud.time, 0), -1e8);
  EXPECT_EQ(number_at(frame, frame.cloud.time, 1), 0.0);
  const Frame from_stamp = read_pcd(bytes_of(pcd("U", "binary", point(0) + point(kScan_ns))));
  EXPECT_EQ(number_at(from_stamp, from_stamp.cloud.time, 1), 1e8);
}

TEST(WideTimes, RowsWithGapsAreFollowed) {
  const std::string row = point(kEpoch_ns) + "gap" + point(kEpoch_ns + 512) + "end";
  PointLayout layout;
  layout.count = 2;
  layout.point_step = 20;
  layout.rows = 2;
  layout.row_step = 23;
  layout.fields = {{"x", {0, POSE_WALL_FIELD_FLOAT32}},
                   {"y", {4, POSE_WALL_FIELD_FLOAT32}},
                   {"z", {8, POSE_WALL_FIELD_FLOAT32}},
                   {"t", {12, kFieldUint64}},
                   {"valid", {12, kFieldBool}}};
  const auto narrowed = [&row](PointLayout of) {
    Bytes bytes = bytes_of(row);
    narrow_wide_fields(bytes.data(), &of);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  EXPECT_EQ(narrowed(layout), row) << "two fields share bytes: neither is changed";
  layout.fields.pop_back();
  const std::string changed = narrowed(layout);
  EXPECT_EQ(changed.substr(12, 8), raw(static_cast<double>(kEpoch_ns)));
  EXPECT_EQ(changed.substr(20, 3), "gap");
  EXPECT_EQ(changed.substr(35, 8), raw(static_cast<double>(kEpoch_ns + 512)));
}

TEST(WideTimes, OtherWideNumbersArePassedOverAndCoordinatesStayFloats) {
  const std::string head =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z id\nSIZE 4 4 4 8\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\n"
      "POINTS 1\nDATA binary\n";
  const Frame frame = read_pcd(bytes_of(head + point(7)));
  EXPECT_EQ(frame.cloud.time.type, static_cast<std::uint32_t>(POSE_WALL_FIELD_NONE));
  const std::string whole =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 8 4 4\nTYPE I F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\n"
      "DATA binary\n";
  EXPECT_TRUE(contains(refusal(read_pcd, whole + raw(std::int64_t{1}) + raw(1.0F) + raw(1.0F)), "must be a float"));
}

TEST(WideTimes, SurviveDamage) {
  EXPECT_TRUE(test::survives_damage(read_pcd, pcd("U", "binary", point(1) + point(2))));
  EXPECT_TRUE(test::survives_damage(read_ply, ply("binary_big_endian", "int64", point(1) + point(2))));
}

}  // namespace
}  // namespace pose_wall::tools
