// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: scan, map, place and stop as messages, byte for byte or field by field as ROS defines them, under the sums
// and hashes by which other nodes know the types. Transforms form one tree, and that from the map leads to the place.

#include "apps/live/ros_messages/planar_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "io/bags/message_cursor.hpp"
#include "live/tf_message.hpp"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools::live {
namespace {

using pose_wall::test::view_of;
using namespace std::string_literals;

constexpr std::int64_t kPlanarStamp_ns = 1'700'000'000'000'000'007;

TEST(PlanarTypes, AreThoseThatOthersKnow) {
  // `rosmsg md5 TYPE` of ROS 1; hashes as `ros2 topic info -v` tells them.
  const std::map<std::string, std::pair<const RosType*, std::string>> known = {
      {"sensor_msgs/LaserScan", {&kLaserScanType, "90c7ef2dc6895d81024acba2ac42f369"}},
      {"nav_msgs/OccupancyGrid", {&kOccupancyGridType, "3381f2d731d4076ec5c71b0759edbe4e"}},
      {"geometry_msgs/PoseWithCovarianceStamped", {&kCovariantPoseType, "953b798c0f514ff060a53a3498ce6246"}},
      {"std_msgs/Bool", {&kBoolType, "8b94c1b53db61fb6aed406028ad6332a"}}};
  for (const auto& [name, type] : known) {
    EXPECT_EQ(type.first->name, name);
    EXPECT_EQ(type.first->md5, type.second) << name;
  }
  EXPECT_STREQ(kOccupancyGridType.hash, "RIHS01_8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7");
  EXPECT_EQ(kOccupancyGridType.dds_name(), "nav_msgs::msg::dds_::OccupancyGrid_");
}

RoadwayMap small_map() {
  RoadwayMap map;
  map.header_stamp_ns = kPlanarStamp_ns;
  map.width = 3, map.height = 1;
  map.resolution_m = 0.5;
  map.origin_x_m = -1.0, map.origin_y_m = 2.0;
  map.cells = {-1, 0, 100};
  return map;
}

// 1,700,000,000 is 0x6553F100; -1.0, 2.0 and 1.0 as doubles end in BF F0, 40 00 and 3F F0.
TEST(PlanarMessages, TheMapIsWhatOccupancyGridSaysByteForByte) {
  PlanarSettings settings;
  settings.map_frame = "/map";
  const std::string stamp = "\x00\xF1\x53\x65\x07\x00\x00\x00"s, zero(8, '\0');
  const std::string minus_one = "\0\0\0\0\0\0\xF0\xBF"s, two = "\0\0\0\0\0\0\0\x40"s, one = "\0\0\0\0\0\0\xF0\x3F"s;
  const std::string half = "\0\0\0\x3F"s, size = "\x03\0\0\0\x01\0\0\0"s;
  const std::string origin = minus_one + two + zero + zero + zero + zero + one;
  const std::string cells = "\x03\0\0\0\xFF\0\x64"s;
  EXPECT_EQ(PlanarMessages(MessageEncoding::kRos1, settings, "base_link").map(small_map()),
            "\0\0\0\0"s + stamp + "\x03\0\0\0map"s + stamp + half + size + origin + cells);
  // CDR: behind its head; texts end in zero; four bytes at multiples of four, eight at multiples of eight.
  EXPECT_EQ(PlanarMessages(MessageEncoding::kCdr, settings, "base_link").map(small_map()),
            "\0\1\0\0"s + stamp + "\x04\0\0\0map\0"s + stamp + half + size + "\0\0\0\0"s + origin + cells);
}

class PlanarMessagesOf : public testing::TestWithParam<MessageEncoding> {
 protected:
  PlanarMessagesOf() {
    news_.header_stamp_ns = kPlanarStamp_ns;
    news_.has_scan = true;
    news_.scan.struct_size = sizeof news_.scan;
    news_.scan.beams = 4;
    news_.scan.sensor = {1.5, 0.25, 0.0};
    news_.scan.angle_min_rad = -1.0, news_.scan.angle_step_rad = 0.5;
    news_.scan.range_min_m = 0.25, news_.scan.range_max_m = 30.0, news_.scan.sigma_m = 0.01;
    news_.range_m = {2.0F, INFINITY, NAN, 4.0F};
    news_.pose = pose_wall_planar_pose{3.0, -4.0, 0.5};
    news_.odometry = pose_wall_planar_pose{1.0, 2.0, 0.25};
    for (int k = 0; k < 9; ++k) news_.covariance[k] = k + 1;
  }
  PlanarMessages messages(const std::string& tf = "off") const {
    PlanarSettings settings;
    settings.tf = tf;
    return {GetParam(), settings, "/base_link"};
  }
  MessageCursor opened(const std::string& message, const std::string& frame) const {
    MessageCursor cursor(GetParam(), view_of(message), {});
    expect_header(&cursor, frame);
    return cursor;
  }
  static void expect_header(MessageCursor* cursor, const std::string& frame) {
    const std::uint32_t seq = cursor->is_cdr() ? 0 : cursor->number<std::uint32_t>("seq");
    EXPECT_EQ(seq, 0U);
    EXPECT_EQ(cursor->number<std::uint32_t>("sec"), 1'700'000'000U);
    EXPECT_EQ(cursor->number<std::uint32_t>("nsec"), 7U);
    EXPECT_EQ(cursor->text("frame_id"), frame);
  }
  struct Link {
    std::string parent, child;
    pose_wall_planar_pose pose;
  };
  std::vector<Link> links_of(const std::string& message) const {
    MessageCursor cursor(GetParam(), view_of(message), {});
    std::vector<Link> links(cursor.number<std::uint32_t>("transforms"));
    for (Link& link : links) {
      if (!cursor.is_cdr()) cursor.number<std::uint32_t>("seq");
      cursor.number<std::uint32_t>("sec");
      cursor.number<std::uint32_t>("nsec");
      link.parent = cursor.text("parent");
      link.child = cursor.text("child");
      double n[7];
      for (double& number : n) number = cursor.number<double>("transform");
      link.pose = {n[0], n[1], 2.0 * std::atan2(n[5], n[6])};
      EXPECT_EQ(n[2], 0.0);
      EXPECT_NEAR(n[5] * n[5] + n[6] * n[6], 1.0, 1e-12);
    }
    EXPECT_THROW(cursor.number<std::uint8_t>("end"), FrameError);
    return links;
  }

  RoadwayNews news_;
};

TEST_P(PlanarMessagesOf, ScanHasEveryBeamAndUnknownIsNoNumber) {
  const std::string message = messages().scan(news_);
  MessageCursor cursor = opened(message, "base_link_scan");
  for (const float expected : {-1.0F, 0.5F, 0.5F, 0.0F, 0.0F, 0.25F, 30.0F}) {
    EXPECT_EQ(cursor.number<float>("number"), expected);
  }
  ASSERT_EQ(cursor.number<std::uint32_t>("ranges"), 4U);
  EXPECT_EQ(cursor.number<float>("range"), 2.0F);
  EXPECT_EQ(cursor.number<float>("range"), INFINITY);
  EXPECT_TRUE(std::isnan(cursor.number<float>("range")));
  EXPECT_EQ(cursor.number<float>("range"), 4.0F);
  EXPECT_EQ(cursor.number<std::uint32_t>("intensities"), 0U);
  EXPECT_THROW(cursor.number<std::uint8_t>("end"), FrameError);
}

TEST_P(PlanarMessagesOf, PoseHasItsCovarianceInTheirPlaces) {
  const std::string message = messages().pose(news_);
  MessageCursor cursor = opened(message, "map");
  for (const double expected : {3.0, -4.0, 0.0, 0.0, 0.0, std::sin(0.25), std::cos(0.25)}) {
    EXPECT_EQ(cursor.number<double>("pose"), expected);
  }
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const auto ours = [](int axis) { return axis < 2 ? axis : axis == 5 ? 2 : -1; };
      const bool is_ours = ours(row) >= 0 && ours(column) >= 0;
      EXPECT_EQ(cursor.number<double>("covariance"), is_ours ? 3 * ours(row) + ours(column) + 1 : 0.0) << row << column;
    }
  }
  EXPECT_THROW(cursor.number<std::uint8_t>("end"), FrameError);
}

// Zeros would make it exact to who fuses it.
TEST_P(PlanarMessagesOf, APoseWhoseCovarianceIsNotKnownHasNoWeight) {
  std::fill(std::begin(news_.covariance), std::end(news_.covariance), 0.0);
  const std::string message = messages().pose(news_);
  MessageCursor cursor = opened(message, "map");
  for (int k = 0; k < 7; ++k) cursor.number<double>("pose");
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const bool is_variance = row == column && (row < 2 || row == 5);
      EXPECT_EQ(cursor.number<double>("covariance"), is_variance ? 1e6 : 0.0) << row << column;
    }
  }
}

TEST_P(PlanarMessagesOf, TransformsLeadFromTheMapToTheBase) {
  const std::vector<Link> off = links_of(messages().transforms(news_));
  ASSERT_EQ(off.size(), 1U);
  EXPECT_EQ(off[0].parent + " " + off[0].child, "base_link_level base_link_scan");
  EXPECT_EQ(off[0].pose.x_m, 1.5);
  const std::vector<Link> base = links_of(messages("base").transforms(news_));
  ASSERT_EQ(base.size(), 2U);
  EXPECT_EQ(base[1].parent + " " + base[1].child, "map base_link");
  EXPECT_NEAR(base[1].pose.yaw_rad, 0.5, 1e-12);
  const std::vector<Link> odom = links_of(messages("odom").transforms(news_));
  ASSERT_EQ(odom.size(), 3U);
  EXPECT_EQ(odom[1].parent + " " + odom[1].child, "map odom");
  EXPECT_EQ(odom[2].parent + " " + odom[2].child, "odom base_link");
  const pose_wall_planar_pose whole = combined(odom[1].pose, odom[2].pose);
  EXPECT_NEAR(whole.x_m, 3.0, 1e-12);
  EXPECT_NEAR(whole.y_m, -4.0, 1e-12);
  EXPECT_NEAR(whole.yaw_rad, 0.5, 1e-12);
  // Without a place nothing is said of the map.
  news_.pose.reset();
  EXPECT_EQ(links_of(messages("base").transforms(news_)).size(), 1U);
  news_.has_scan = false;
  EXPECT_EQ(messages("base").transforms(news_), "");
}

TEST_P(PlanarMessagesOf, StopIsTrueForEverythingButPermission) {
  const std::string head = GetParam() == MessageEncoding::kCdr ? "\0\1\0\0"s : "";
  StopNews news;
  for (const std::uint32_t state : {0U, 1U, 2U, 3U, 77U}) {
    news.result.state = state;
    EXPECT_EQ(messages().stop(news), head + (state == 1 || state == 2 ? '\0' : '\1')) << state;
  }
}

TEST_P(PlanarMessagesOf, StopStateHasWhatTheAnswerHas) {
  StopNews news;
  news.header_stamp_ns = kPlanarStamp_ns;
  news.rounds = 258;
  news.result.state = POSE_WALL_PLANAR_STOP_SLOW;
  news.result.frames = 1;
  news.result.now_ns = 350'000'000, news.result.stamp_ns = 100'000'000;
  news.result.allowed_speed_m_s = 0.5;
  news.result.reasons = POSE_WALL_PLANAR_STOP_R_THING | POSE_WALL_PLANAR_STOP_R_LOW;
  news.result.nearest_m[0] = 3.0, news.result.nearest_m[1] = -1.0, news.result.nearest_distance_m = 0.75;
  news.result.time_to_contact_s = 8.0;
  const std::string message = messages().stop_state(news);
  MessageCursor cursor = opened(message, "base_link");
  EXPECT_EQ(cursor.number<std::uint8_t>("state"), 1U);
  EXPECT_EQ(cursor.number<std::uint64_t>("heartbeat"), 258U);
  EXPECT_EQ(cursor.number<double>("age_s"), 0.25);
  EXPECT_EQ(cursor.number<double>("allowed"), 0.5);
  EXPECT_EQ(cursor.number<std::uint32_t>("reasons"), news.result.reasons);
  EXPECT_EQ(cursor.text("reasons_text"), "thing, low");
  for (const double expected : {8.0, 3.0, -1.0, 0.75}) EXPECT_EQ(cursor.number<double>("number"), expected);
  EXPECT_THROW(cursor.number<std::uint8_t>("end"), FrameError);
}

INSTANTIATE_TEST_SUITE_P(EitherRos, PlanarMessagesOf, testing::Values(MessageEncoding::kRos1, MessageEncoding::kCdr));

}  // namespace
}  // namespace pose_wall::tools::live
