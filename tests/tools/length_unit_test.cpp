// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: --unit scales the points of every kind of file, in both byte orders and both float types; a cloud in
// millimetres is asked about, one in metres is not, however far it reaches.

#include <gtest/gtest.h>

#include "bag_files.hpp"
#include "io/frames/length_unit.hpp"
#include "io/frames/ply_reader.hpp"
#include "packet_files.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

Frame ply_frame(bool big_endian, bool is_double) {
  const std::string type = is_double ? "double" : "float";
  std::string text = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                     "_endian 1.0\nelement vertex 2\nproperty uchar ring\nproperty " + type + " x\nproperty " + type +
                     " y\nproperty " + type + " z\nend_header\n";
  for (const double number : {1000.0, 2000.0, 3000.0, -4000.0, 5000.0, -6000.0}) {
    if (number == 1000.0 || number == -4000.0) text += 'r';
    text += is_double ? raw(number, big_endian) : raw(static_cast<float>(number), big_endian);
  }
  return read_ply(bytes_of(text));
}

TEST(LengthUnit, ScalesBothByteOrdersAndBothTypes) {
  for (const bool big_endian : {false, true}) {
    for (const bool is_double : {false, true}) {
      Frame frame = ply_frame(big_endian, is_double);
      scale_points(&frame, metres_of("mm"));
      EXPECT_NEAR(number_at(frame, frame.cloud.x, 1), -4.0, 1e-6) << big_endian << is_double;
      EXPECT_NEAR(number_at(frame, frame.cloud.z, 1), -6.0, 1e-6) << big_endian << is_double;
      EXPECT_NEAR(number_at(frame, frame.cloud.y, 0), 2.0, 1e-6) << big_endian << is_double;
      EXPECT_EQ(frame.bytes[frame.bytes.size() - frame.cloud.point_step], std::byte{'r'}) << "other fields stay";
    }
  }
  EXPECT_DOUBLE_EQ(metres_of("ft"), 0.3048);
  EXPECT_DOUBLE_EQ(metres_of(""), 1.0);
}

TEST(LengthUnit, RangesNearlyAllBeyondTheirLimitAreAskedAbout) {
  using Units = std::vector<std::string>;
  EXPECT_EQ(likely_units(4982.0, 1.0, 30.0), Units{"mm"});
  EXPECT_EQ(likely_units(600.0, 1.0, 30.0), (Units{"mm", "cm"}));
  EXPECT_EQ(likely_units(60.0, 1.0, 30.0), Units{"cm"});
  EXPECT_EQ(likely_units(45.0, 0.9, 30.0), Units{}) << "a tenth of the points lies within";
  EXPECT_EQ(likely_units(45.0, 1.0, 30.0), Units{}) << "0.45 m would be a box";
  EXPECT_EQ(likely_units(1e7, 1.0, 30.0), Units{}) << "10 km in millimetres";
}

std::string road_in_millimetres(const TempFolder& folder) {
  EXPECT_EQ(command({"sim", "-q", "-n", "2", "--sensor", "vlp16", "--scene", "clean", "--set", "unit_scale=1000", "-o",
                     folder.file("road")})
                .exit_status,
            0);
  return folder.file("road/frames");
}

TEST(RunVerb, AsksWhetherTheFileIsInMillimetresAndReadsItSo) {
  const TempFolder folder;
  const std::string frames = road_in_millimetres(folder);
  test::Ran ran = command({"run", "-c", folder.file("road/pose_wall.yaml"), "-o", folder.file("o.csv"), frames});
  EXPECT_EQ(ran.exit_status, 0);
  EXPECT_TRUE(contains(ran.errors, "are they in mm? --unit mm reads them so.")) << ran.errors;
  ran = command({"run", "-c", folder.file("road/pose_wall.yaml"), "--unit", "mm", "-o", folder.file("o.csv"), frames});
  EXPECT_FALSE(contains(ran.errors, "--unit")) << ran.errors;
  const CsvTable table = test::table_of(folder.file("o.csv"));
  EXPECT_NEAR(table.number(0, *table.find_column("d_lf_raw")), 2.5, 0.1);
  ran = command({"run", "--unit", "inch", frames});
  EXPECT_EQ(ran.exit_status, 2);
  EXPECT_TRUE(contains(ran.errors, "m, mm, cm, ft")) << ran.errors;
}

TEST(FrameSequence, ScalesTheCloudsOfABag) {
  const TempFolder folder;
  InputOptions options;
  options.unit = "cm";
  const std::string bag =
      test::mcap({{"/points", "sensor_msgs/msg/PointCloud2"}}, {{0, test::cdr_message(test::CloudMessage())}}, nullptr);
  FrameSequence frames({folder.write("a.mcap", bag)}, options);
  const std::optional<SourcedFrame> frame = frames.next();
  ASSERT_TRUE(frame && frame->frame);
  EXPECT_NEAR(number_at(*frame->frame, frame->frame->cloud.z, 0), 0.03, 1e-6);
}

#if POSE_WALL_HAS_PCAP
TEST(FrameSequence, PacketsTellTheirUnitThemselves) {
  const TempFolder folder;
  InputOptions options;
  options.unit = "mm";
  std::vector<std::string> payloads(4, test::payload_of(test::VelodynePacket()));
  const std::string file = folder.write("a.pcap", test::capture_of(payloads));
  EXPECT_THROW(FrameSequence({file}, options), std::invalid_argument);
}
#endif

}  // namespace
}  // namespace pose_wall::tools
