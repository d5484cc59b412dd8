// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a frame's file that was cut off, at any byte, is refused with a reason, or gives the first of its points as
// they stood: none is made up. Which lengths are taken is part of the table. Two cuts cannot be told: a KITTI file has
// no header, so one that ends between two points is a shorter one; and as many texts are written without an end to
// their last line, the last number of the last point may have lost its last digits.

#include <gtest/gtest.h>

#include <set>

#include "io/frames/bare_points.hpp"
#include "io/frames/load_frame.hpp"
#include "io/frames/pcd_reader.hpp"
#include "io/frames/ply_reader.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

struct Format {
  const char* name;
  Frame (*read)(Bytes);
  std::string whole;
  std::set<std::size_t> lengths_taken;
  bool last_number_may_be_short = false;
};

void PrintTo(const Format& format, std::ostream* out) {
  *out << format.name;
}

std::string pcd(const std::string& data) {
  return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
         "POINTS 3\nDATA " +
         data + "\n";
}

std::string ply(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
}

std::string points(bool big_endian = false) {
  std::string text;
  for (const float number : {1.25F, 2.5F, 3.75F, -4.25F, 5.5F, 6.75F, 7.25F, -8.5F, 9.75F})
    text += raw(number, big_endian);
  return text;
}

std::string columns() {
  std::string text;
  for (const float number : {1.25F, -4.25F, 7.25F, 2.5F, 5.5F, -8.5F, 3.75F, 6.75F, 9.75F}) text += raw(number);
  return text;
}

const char* const kAscii = "1.25 2.5 3.75\n-4.25 5.5 6.75\n7.25 -8.5 9.75\n";

// LZF of runs of literal bytes alone.
std::string lzf_packed(const std::string& plain) {
  std::string body;
  for (std::size_t at = 0; at < plain.size(); at += 32) {
    const std::string run = plain.substr(at, 32);
    body += static_cast<char>(run.size() - 1) + run;
  }
  return raw(static_cast<std::uint32_t>(body.size())) + raw(static_cast<std::uint32_t>(plain.size())) + body;
}

std::string kitti() {
  std::string text;
  for (const float number : {1.25F, 2.5F, 3.75F, 1.0F, -4.25F, 5.5F, 6.75F, 1.0F, 7.25F, -8.5F, 9.75F, 1.0F}) {
    text += raw(number);
  }
  return text;
}

Frame read_xyzi(Bytes bytes) {
  return read_bare_points(std::move(bytes), *parse_bare_layout("xyzi"));
}

// Cut off within the last number, or just behind it.
Format text_format(const char* name, Frame (*read)(Bytes), const std::string& whole) {
  const std::size_t bytes = whole.size();
  return {name, read, whole, {bytes - 4, bytes - 3, bytes - 2, bytes - 1}, true};
}

std::vector<Format> formats() {
  return {text_format("pcd_ascii", read_pcd, pcd("ascii") + kAscii),
          {"pcd_binary", read_pcd, pcd("binary") + points(), {}},
          {"pcd_binary_compressed", read_pcd, pcd("binary_compressed") + lzf_packed(columns()), {}},
          text_format("ply_ascii", read_ply, ply("ascii") + kAscii),
          {"ply_binary_little_endian", read_ply, ply("binary_little_endian") + points(), {}},
          {"ply_binary_big_endian", read_ply, ply("binary_big_endian") + points(true), {}},
          {"bare_xyzi", read_xyzi, kitti(), {0, 16, 32}}};
}

class Truncation : public ::testing::TestWithParam<Format> {};

TEST_P(Truncation, AtEveryByteIsRefusedOrGivesTheFirstPoints) {
  const Format& f = GetParam();
  const Frame whole = f.read(bytes_of(f.whole));
  ASSERT_EQ(whole.cloud.width, 3U);
  std::set<std::size_t> taken;
  for (std::size_t length = 0; length < f.whole.size(); ++length) {
    try {
      const Frame cut = f.read(bytes_of(f.whole.substr(0, length)));
      taken.insert(length);
      ASSERT_LE(cut.cloud.width, 3U);
      for (std::uint32_t i = 0; i < cut.cloud.width; ++i) {
        EXPECT_EQ(number_at(cut, cut.cloud.x, i), number_at(whole, whole.cloud.x, i)) << length;
        EXPECT_EQ(number_at(cut, cut.cloud.y, i), number_at(whole, whole.cloud.y, i)) << length;
        if (f.last_number_may_be_short && i == 2) continue;
        EXPECT_EQ(number_at(cut, cut.cloud.z, i), number_at(whole, whole.cloud.z, i)) << length;
      }
    } catch (const FrameError& error) {
      EXPECT_STRNE(error.what(), "") << length;
    }
  }
  EXPECT_EQ(taken, f.lengths_taken);
}

INSTANTIATE_TEST_SUITE_P(Formats, Truncation, ::testing::ValuesIn(formats()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(TruncationAscii, ATextWithoutAnEndToItsLastLineIsWhole) {
  const std::string text = pcd("ascii") + kAscii;
  const Frame frame = read_pcd(bytes_of(text.substr(0, text.size() - 1)));
  ASSERT_EQ(frame.cloud.width, 3U);
  EXPECT_EQ(number_at(frame, frame.cloud.z, 2), 9.75);
}

}  // namespace
}  // namespace pose_wall::tools
