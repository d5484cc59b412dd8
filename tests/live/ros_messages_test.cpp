// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a result as messages, read field by field as the definitions have them. What is invalid is NaN, and held
// values are as they are told. The levelled frame comes only where it was measured, and turns the way the header says.

#include "apps/live/ros_messages/ros_messages.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "io/bags/message_cursor.hpp"
#include "io/bags/point_cloud2.hpp"
#include "live/tf_message.hpp"

namespace pose_wall::tools::live {
namespace {

using pose_wall::test::view_of;

// A day of 2023, odd to the nanosecond: a double would lose the 7.
constexpr std::int64_t kStamp_ns = 1'700'000'000'000'000'007;

class RosMessagesOf : public testing::TestWithParam<MessageEncoding> {
 protected:
  RosMessagesOf() {
    result_.header_stamp_ns = kStamp_ns;
    result_.publication.cause = POSE_WALL_RUNTIME_FRAME;
    result_.publication.frame = 41;
    result_.publication.index = 43;
    result_.publication.age_ns = 250'000'000;
    result_.publication.thinning = 1;
    result_.publication.held_thinning = 2;
    pose_wall_result& r = result_.publication.result;
    r.confidence = 0.5;
    r.floor.found = 1;
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      r.quantity[q].value = 0.25 * (q + 1);
      r.quantity[q].state = POSE_WALL_VALID;
    }
    r.quantity[POSE_WALL_YAW].state = POSE_WALL_INVALID;
    r.quantity[POSE_WALL_D_RF].state = POSE_WALL_INVALID;
    r.quantity[POSE_WALL_D_RF].reasons = POSE_WALL_R_WALL_SHORT | POSE_WALL_R_WALL_LEANS;
    r.quantity[POSE_WALL_D_RB].state = POSE_WALL_HELD;
    for (int i = 0; i < 3; ++i) r.R_level_base[4 * i] = 1.0;
  }

  // The header is read and compared; the cursor stands behind it.
  MessageCursor opened(const std::string& message) const {
    MessageCursor cursor(GetParam(), view_of(message), {});
    expect_header(&cursor);
    return cursor;
  }
  static void expect_header(MessageCursor* cursor) {
    const std::uint32_t seq = cursor->is_cdr() ? 0 : cursor->number<std::uint32_t>("seq");
    EXPECT_EQ(seq, 0U);
    EXPECT_EQ(cursor->number<std::uint32_t>("sec"), 1'700'000'000U);
    EXPECT_EQ(cursor->number<std::uint32_t>("nsec"), 7U);
    EXPECT_EQ(cursor->text("frame_id"), "base_link");
  }

  LiveResult result_;
  RosMessages messages_{GetParam(), "/base_link"};
};

TEST_P(RosMessagesOf, AttitudeHasNanForWhatIsInvalid) {
  const std::string message = messages_.attitude(result_);
  MessageCursor cursor = opened(message);
  EXPECT_EQ(cursor.number<double>("x"), 0.25);
  EXPECT_EQ(cursor.number<double>("y"), 0.5);
  EXPECT_TRUE(std::isnan(cursor.number<double>("z")));
  EXPECT_THROW(cursor.number<std::uint8_t>("end"), FrameError);
}

TEST_P(RosMessagesOf, DistancesAreLabelledAndHeldOnesAreTold) {
  const std::string message = messages_.distances(result_);
  MessageCursor cursor(GetParam(), view_of(message), {});
  ASSERT_EQ(cursor.number<std::uint32_t>("dims"), 1U);
  EXPECT_EQ(cursor.text("label"), "d_lf d_lb d_rf d_rb");
  EXPECT_EQ(cursor.number<std::uint32_t>("size"), 4U);
  EXPECT_EQ(cursor.number<std::uint32_t>("stride"), 4U);
  EXPECT_EQ(cursor.number<std::uint32_t>("data_offset"), 0U);
  ASSERT_EQ(cursor.number<std::uint32_t>("data"), 4U);
  EXPECT_EQ(cursor.number<float>("d_lf"), 1.0F);
  EXPECT_EQ(cursor.number<float>("d_lb"), 1.25F);
  EXPECT_TRUE(std::isnan(cursor.number<float>("d_rf")));
  EXPECT_EQ(cursor.number<float>("d_rb"), 1.75F) << "held";
  EXPECT_THROW(cursor.number<std::uint8_t>("end"), FrameError);
}

TEST_P(RosMessagesOf, StateHasAllThatThePublicationHas) {
  const std::string message = messages_.state(result_);
  MessageCursor cursor = opened(message);
  EXPECT_EQ(cursor.number<std::uint8_t>("told_by"), POSE_WALL_RUNTIME_FRAME);
  EXPECT_EQ(cursor.number<std::uint64_t>("frame"), 41U);
  EXPECT_EQ(cursor.number<std::uint64_t>("publication"), 43U);
  EXPECT_EQ(cursor.number<double>("age_s"), 0.25);
  EXPECT_EQ(cursor.number<std::uint32_t>("thinning"), 1U);
  EXPECT_EQ(cursor.number<std::uint32_t>("held_thinning"), 2U);
  EXPECT_EQ(cursor.number<double>("confidence"), 0.5);
  EXPECT_EQ(cursor.number<std::uint32_t>("frame_reasons"), 0U);
  EXPECT_EQ(cursor.text("frame_reasons_text"), "");
  cursor.number<std::uint32_t>("source_id");
  cursor.number<std::uint32_t>("config_crc32");
  ASSERT_EQ(cursor.number<std::uint32_t>("values"), std::uint32_t{POSE_WALL_QUANTITIES});
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& value = result_.publication.result.quantity[q];
    EXPECT_EQ(cursor.text("name"), pose_wall_quantity_name(q));
    EXPECT_EQ(cursor.number<std::uint8_t>("state"), value.state);
    const double told = cursor.number<double>("value");
    EXPECT_EQ(std::isnan(told), value.state == POSE_WALL_INVALID);
    for (const char* number : {"level", "raw", "raw level", "sigma", "confidence", "age"})
      cursor.number<double>(number);
    EXPECT_EQ(cursor.number<std::uint32_t>("reasons"), value.reasons);
    const std::string names(cursor.text("reasons_text"));
    EXPECT_EQ(names.find("wall_short") != std::string::npos, q == POSE_WALL_D_RF) << names;
    cursor.text("cause");
  }
  EXPECT_THROW(cursor.number<std::uint8_t>("end"), FrameError);
}

// Roll 0.2: the floor's normal in base is (0, sin 0.2, cos 0.2), and the levelled frame's z points along it.
TEST_P(RosMessagesOf, TheLevelledFramesZIsTheFloorsNormal) {
  pose_wall_result& r = result_.publication.result;
  const double c = std::cos(0.2), s = std::sin(0.2);
  const double R_level_base[9] = {1, 0, 0, 0, c, -s, 0, s, c};  // Rx(0.2)
  std::copy(std::begin(R_level_base), std::end(R_level_base), std::begin(r.R_level_base));
  ASSERT_TRUE(RosMessages::has_level(result_));
  const std::string message = messages_.level_transform(result_);
  MessageCursor cursor(GetParam(), view_of(message), {});
  ASSERT_EQ(cursor.number<std::uint32_t>("transforms"), 1U);
  expect_header(&cursor);
  EXPECT_EQ(cursor.text("child_frame_id"), "base_link_level");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(cursor.number<double>("translation"), 0.0);
  double q[4];
  for (double& part : q) part = cursor.number<double>("rotation");
  const Eigen::Vector3d z_base = Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(z_base.x(), 0.0, 1e-15);
  EXPECT_NEAR(z_base.y(), s, 1e-15);
  EXPECT_NEAR(z_base.z(), c, 1e-15);
}

TEST_P(RosMessagesOf, ThereIsNoLevelWhereNoneWasMeasured) {
  EXPECT_TRUE(RosMessages::has_level(result_));
  LiveResult silence = result_, held = result_, no_floor = result_;
  silence.publication.cause = POSE_WALL_RUNTIME_SILENCE;
  held.publication.result.quantity[POSE_WALL_PITCH].state = POSE_WALL_HELD;
  no_floor.publication.result.floor.found = 0;
  EXPECT_FALSE(RosMessages::has_level(silence));
  EXPECT_FALSE(RosMessages::has_level(held));
  EXPECT_FALSE(RosMessages::has_level(no_floor));
}

// Read by the decoder of clouds, which knows nothing of the writer.
TEST_P(RosMessagesOf, LabelledPointsAreACloud) {
  auto points = std::make_shared<LabelledPoints>();
  points->x_base_m = {1.0F, 4.0F};
  points->y_base_m = {2.0F, 5.0F};
  points->z_base_m = {3.0F, 6.0F};
  points->label = {POSE_WALL_LABEL_FLOOR, POSE_WALL_LABEL_RIGHT};
  result_.points = points;
  const std::string message = messages_.points(result_);
  const DecodedCloud cloud = decode_point_cloud2(GetParam(), view_of(message), {});
  EXPECT_EQ(cloud.stamp_ns, kStamp_ns);
  EXPECT_EQ(cloud.source.frame_id, "base_link");
  ASSERT_EQ(cloud.frame.cloud.width * cloud.frame.cloud.height, 2U);
  ASSERT_EQ(cloud.frame.fields.size(), 4U);
  EXPECT_EQ(cloud.frame.fields[3].name, "label");
  const auto* bytes = static_cast<const char*>(cloud.frame.cloud.data) + cloud.frame.cloud.point_step;
  float y_m = 0.0F;
  std::memcpy(&y_m, bytes + cloud.frame.cloud.y.offset, sizeof y_m);
  EXPECT_EQ(y_m, 5.0F);
  EXPECT_EQ(bytes[cloud.frame.fields[3].where.offset], POSE_WALL_LABEL_RIGHT);
}

INSTANTIATE_TEST_SUITE_P(EitherRos, RosMessagesOf, testing::Values(MessageEncoding::kRos1, MessageEncoding::kCdr));

}  // namespace
}  // namespace pose_wall::tools::live
