// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a slow viewer gets the newest messages and what it missed is counted; a large channel keeps no small one
// waiting; who comes later gets what is kept for it. Every request gets its effect or a refusal in words. Pages of
// other origins are known. The pose in the road is that of the planes, and a frame that measures nothing draws nothing.
// Does not prove: anything of sockets and readers of others: foxglove_peer.py, recorder_peer.py.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/live/channels/live_messages.hpp"
#include "apps/live/foxglove/origins.hpp"
#include "apps/live/foxglove/viewer_talk.hpp"

namespace pose_wall::tools::live {
namespace {

using Json = nlohmann::ordered_json;

class ViewerTalkTest : public ::testing::Test {
 protected:
  ViewerTalkTest() {
    EXPECT_EQ(text()["op"], "serverInfo");
    EXPECT_EQ(text()["channels"].size(), 3U);
  }
  Json text() {
    const auto message = talk_.next();
    return message && message->is_text ? Json::parse(*message->body) : Json();
  }
  // Subscription and content: "7:a"; "" where nothing is new.
  std::string data() {
    const auto message = talk_.next();
    if (!message || message->is_text || message->head.size() != 13 || message->head[0] != 1) return "";
    return std::to_string(static_cast<unsigned char>(message->head[1])) + ":" + *message->body;
  }
  void ask(const std::string& request) { talk_.hear(request, true); }
  std::string refusal() {
    const Json answer = text();
    return answer.contains("message") ? answer["message"].get<std::string>() : "";
  }

  const std::vector<McapChannel> channels_{{"/a", "json", "A", "jsonschema", "{}"},
                                           {"/b", "json", "B", "jsonschema", "{}"},
                                           {"/map", "cdr", "M", "ros2msg", "uint8 a"}};
  ViewerBoard board_{{{}, {2, false}, {1, true}}};
  ViewerCounts counts_;
  ViewerTalk talk_{channels_, "session", board_, counts_, [] {}};
};

TEST_F(ViewerTalkTest, TheNewestComesAndWhatWasMissedIsCounted) {
  board_.put(0, "before", 1);
  ask(R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1}]})");
  EXPECT_EQ(data(), "") << "what came before it subscribed is not news";
  for (const char* content : {"x", "y", "z"}) board_.put(0, content, 2);
  EXPECT_EQ(data(), "7:z");
  EXPECT_EQ(data(), "");
  EXPECT_EQ(counts_.skipped, 2U);
  EXPECT_EQ(counts_.sent, 1U);
}

// On a slow line a cloud takes seconds: results that came meanwhile go first, all of them.
TEST_F(ViewerTalkTest, WhatIsSmallGoesBeforeWhatIsLarge) {
  const std::string cloud(1000, 'c');
  ask(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1},{"id":2,"channelId":2}]})");
  std::string order;
  for (int i = 0; i < 3; ++i) {
    board_.put(0, cloud, 1);
    for (const char* const result : {"r", "s"}) board_.put(1, result + std::to_string(i), 1);
    for (int k = 0; k < 3; ++k) order += data().substr(0, 4) + " ";
  }
  EXPECT_EQ(order, "1:cc 2:r0 2:s0 2:r1 2:s1 1:cc 2:r2 2:s2 1:cc ");
  EXPECT_EQ(counts_.skipped, 0U);
}

TEST_F(ViewerTalkTest, WhoSubscribesLaterMakesUpForNothing) {
  ask(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2}]})");
  for (int i = 0; i < 5; ++i) {
    board_.put(1, "result", 1);
    EXPECT_EQ(data(), "1:result");
  }
  ask(R"({"op":"subscribe","subscriptions":[{"id":2,"channelId":1}]})");
  std::string order;
  for (int i = 0; i < 3; ++i) {
    board_.put(0, "later ", 1);
    board_.put(1, "result", 1);
    for (int k = 0; k < 2; ++k) order += data() + " ";
  }
  EXPECT_EQ(order, "2:later  1:result 2:later  1:result 2:later  1:result ");
}

TEST_F(ViewerTalkTest, AMapIsThereForThoseWhoComeLater) {
  board_.put(2, "old", 1);
  board_.put(2, "map", 1);
  ask(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":3}]})");
  EXPECT_EQ(data(), "1:map");
  EXPECT_EQ(counts_.skipped, 0U);
}

TEST_F(ViewerTalkTest, SubscribersAreKnownUntilTheyLeave) {
  EXPECT_FALSE(board_.has_subscribers(0));
  ask(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1},{"id":2,"channelId":1}]})");
  ask(R"({"op":"unsubscribe","subscriptionIds":[1]})");
  EXPECT_TRUE(board_.has_subscribers(0));
  ask(R"({"op":"unsubscribe","subscriptionIds":[2]})");
  EXPECT_FALSE(board_.has_subscribers(0));
  {
    ViewerTalk other(channels_, "session", board_, counts_, [] {});
    other.hear(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1}]})", true);
    EXPECT_TRUE(board_.has_subscribers(0));
  }
  EXPECT_FALSE(board_.has_subscribers(0)) << "who has gone subscribes to nothing";
  EXPECT_EQ(counts_.viewers, 1U);
}

TEST_F(ViewerTalkTest, WhatCannotBeIsRefusedInWords) {
  ask(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1}]})");
  EXPECT_EQ(refusal(), "");
  const std::pair<const char*, const char*> wrong[] = {
      {"{", "no JSON of the protocol"},
      {"[1]", "no JSON of the protocol"},
      {R"({"op":"subscribe"})", "no JSON of the protocol"},
      {R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})", "no JSON of the protocol"},
      {R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1}]})", "subscription 1: the number is taken"},
      {R"({"op":"subscribe","subscriptions":[{"id":2,"channelId":0}]})", "there is no channel 0"},
      {R"({"op":"subscribe","subscriptions":[{"id":2,"channelId":4}]})", "there is no channel 4"},
      {R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})", "subscription 4294967296"},
      {R"({"op":"unsubscribe","subscriptionIds":[9]})", "there is no subscription 9"},
      {R"({"op":"setParameters"})", "setParameters: pose_walld knows"}};
  for (const auto& [request, why] : wrong) {
    ask(request);
    EXPECT_NE(refusal().find(why), std::string::npos) << request;
  }
  talk_.hear("\x01", false);
  EXPECT_EQ(refusal(), "nothing can be sent to pose_walld");
  EXPECT_EQ(counts_.refused, std::size(wrong) + 1);
  std::string many = R"({"op":"subscribe","subscriptions":[)";
  for (int id = 2; id < 100; ++id)
    many += std::string(id > 2 ? "," : "") + R"({"id":)" + std::to_string(id) + R"(,"channelId":1})";
  ask(many + "]}");
  EXPECT_NE(refusal().find("64 are the most"), std::string::npos);
}

TEST(Origins, ThoseOfThisMachineOfFoxgloveAndTheNamedOneAreAdmitted) {
  for (const char* origin : {"", "file://", "https://app.foxglove.dev", "http://localhost", "http://localhost:8080",
                             "http://127.0.0.1:8080", "http://[::1]:8080", "http://mine:80"}) {
    EXPECT_TRUE(is_admitted_origin(origin, "http://mine:80")) << origin;
  }
  for (const char* origin :
       {"null", "https://app.foxglove.dev.evil.example", "http://app.foxglove.dev", "http://localhost.evil.example",
        "http://127.0.0.1.evil.example:80", "http://mine:80", "localhost", "http://", "http://[::1"}) {
    EXPECT_FALSE(is_admitted_origin(origin, "http://other")) << origin;
  }
  EXPECT_FALSE(is_admitted_origin("http://mine", "")) << "no key names nobody";
}

// What is put, by channel; wants all.
class Kept final : public ChannelOut {
 public:
  bool wants(ChannelNumber) const override { return true; }
  void put(ChannelNumber channel, std::string message) override { messages[channel] = std::move(message); }
  Json json(ChannelNumber channel) const { return Json::parse(messages.at(channel)); }
  std::map<ChannelNumber, std::string> messages;
};

// Level, `left_m` to the left of the middle of a road 6 m wide, 1.5 m above its floor, turned to the left by
// `turned_rad`.
LiveResult standing(const LoadedConfig& loaded, double left_m, double turned_rad) {
  LiveResult result;
  result.config = *loaded.config.get();
  result.frame_id = "lidar";
  result.publication.cause = POSE_WALL_RUNTIME_FRAME;
  pose_wall_result& r = result.publication.result;
  for (int i = 0; i < 3; ++i) r.R_level_base[4 * i] = 1.0;
  for (pose_wall_value& value : r.quantity) value.state = POSE_WALL_VALID;
  r.quantity[POSE_WALL_YAW].value = -turned_rad;
  r.floor = {};
  r.floor.found = r.left.found = r.right.found = 1;
  r.floor.normal[2] = 1.0;
  r.floor.d_m = 1.5;
  r.floor.extent_max_m = 8.0;
  r.left.d_m = 3.0 - left_m;
  r.right.d_m = 3.0 + left_m;
  for (pose_wall_plane* const wall : {&r.left, &r.right}) {
    const double side = wall == &r.left ? -1.0 : 1.0;
    wall->normal[0] = side * std::sin(turned_rad);
    wall->normal[1] = side * std::cos(turned_rad);
    wall->extent_min_m = -5.0;
    wall->extent_max_m = 7.0;
  }
  for (int i = 0; i < 4; ++i) r.quantity[POSE_WALL_D_LF + i].value = i < 2 ? r.left.d_m : r.right.d_m;
  return result;
}

TEST(LiveMessages, ThePoseInTheRoadIsThatOfThePlanes) {
  const LoadedConfig loaded = load_config("", {});
  LiveMessages messages(loaded);
  Kept kept;
  messages.tell(standing(loaded, 0.4, 0.1), &kept);
  const Json pose = kept.json(kPoseChannel)["pose"];
  EXPECT_NEAR(pose["position"]["x"], 0.0, 1e-3);
  EXPECT_NEAR(pose["position"]["y"], 0.4, 1e-3) << "left of the middle";
  EXPECT_NEAR(pose["position"]["z"], 1.5, 1e-3);
  EXPECT_NEAR(pose["orientation"]["z"], std::sin(0.05), 1e-9) << "turned to the left";
  EXPECT_NEAR(pose["orientation"]["w"], std::cos(0.05), 1e-9);
}

TEST(LiveMessages, WallsAreDrawnWhereTheyStand) {
  const LoadedConfig loaded = load_config("", {});
  LiveMessages messages(loaded);
  Kept kept;
  messages.tell(standing(loaded, 0.4, 0.1), &kept);
  const Json scene = kept.json(kSceneChannel);
  ASSERT_EQ(scene["entities"].size(), 1U);
  const Json road = scene["entities"][0];
  ASSERT_EQ(road["triangles"].size(), 3U) << "floor and walls";
  for (const Json& point : road["triangles"][0]["points"]) {
    const double left_m = -std::sin(-0.1) * point["x"].get<double>() + std::cos(-0.1) * point["y"].get<double>();
    EXPECT_TRUE(std::abs(left_m - 2.6) < 1e-3 || std::abs(left_m + 3.4) < 1e-3) << "the floor ends at the walls";
  }
  for (const std::size_t wall : {1U, 2U}) {
    const double side = wall == 1 ? 1.0 : -1.0, distance_m = wall == 1 ? 2.6 : 3.4;
    const Json points = road["triangles"][wall]["points"];
    ASSERT_EQ(points.size(), 4U);
    for (const Json& point : points) {
      const double x = point["x"], y = point["y"], z = point["z"];
      EXPECT_NEAR(side * (-std::sin(-0.1) * x + std::cos(-0.1) * y), distance_m, 1e-3);
      EXPECT_TRUE(std::abs(z + 1.25) < 1e-3 || std::abs(z - 1.0) < 1e-3) << "the band of walls above the floor: " << z;
    }
  }
  ASSERT_EQ(road["lines"].size(), 1U);
  const Json ends = road["lines"][0]["points"];
  ASSERT_EQ(ends.size(), 8U) << "four distances";
  for (std::size_t i = 0; i < 4; ++i) {
    const Json from = ends[2U * i], to = ends[2U * i + 1];
    const double dx = to["x"].get<double>() - from["x"].get<double>();
    const double dy = to["y"].get<double>() - from["y"].get<double>();
    EXPECT_NEAR(std::hypot(dx, dy), i < 2 ? 2.6 : 3.4, 1e-3);
    EXPECT_EQ(dy > 0.0, i < 2) << "left is left";
  }
  EXPECT_EQ(road["lines"][0]["colors"].size(), 8U);
  EXPECT_EQ(road["texts"].size(), 4U);
}

TEST(LiveMessages, AFrameThatMeasuresNothingDrawsNothing) {
  const LoadedConfig loaded = load_config("", {});
  LiveMessages messages(loaded);
  Kept kept;
  LiveResult result = standing(loaded, 0.0, 0.0);
  for (pose_wall_value& value : result.publication.result.quantity) value.state = POSE_WALL_HELD;
  messages.tell(result, &kept);
  EXPECT_EQ(kept.messages.count(kPoseChannel), 0U);
  for (const Json& entity : kept.json(kSceneChannel)["entities"]) {
    for (const char* part : {"lines", "triangles", "texts"}) EXPECT_TRUE(entity[part].empty()) << entity["id"];
  }
  ASSERT_EQ(kept.json(kTransformChannel)["transforms"].size(), 1U) << "the sensor stands where it stands";
  EXPECT_EQ(kept.json(kTransformChannel)["transforms"][0]["child_frame_id"], "lidar");
}

TEST(LiveMessages, TheLogTellsWhatFaresOtherwise) {
  const LoadedConfig loaded = load_config("", {});
  LiveMessages messages(loaded);
  Kept kept;
  PartHealth part{"runtime", Grade::kGood, "measures", {}};
  messages.tell({part}, 1'500'000'000, &kept);
  EXPECT_EQ(kept.json(kLogChannel)["level"], 2);
  EXPECT_EQ(kept.json(kLogChannel)["timestamp"]["nsec"], 500'000'000);
  kept.messages.clear();
  part.add("frames", 7);
  messages.tell({part}, 2'500'000'000, &kept);
  EXPECT_EQ(kept.messages.count(kLogChannel), 0U) << "facts change all the time";
  part.grade = Grade::kBad;
  messages.tell({part}, 3'500'000'000, &kept);
  EXPECT_EQ(kept.json(kLogChannel)["level"], 4);
  EXPECT_EQ(kept.json(kLogChannel)["name"], "runtime");
}

TEST(LiveMessages, AMapGoesOutOncePerVersion) {
  const LoadedConfig loaded = load_config("", {"planar=map"});
  EXPECT_EQ(live_channels(loaded).size(), kChannels);
  EXPECT_EQ(live_channels(load_config("", {})).size(), kStopChannel);
  LiveMessages messages(loaded);
  Kept kept;
  RoadwayNews news;
  auto map = std::make_shared<RoadwayMap>();
  map->version = 3;
  news.map = map;
  messages.tell(news, &kept);
  EXPECT_EQ(kept.messages.count(kMapChannel), 1U);
  kept.messages.clear();
  messages.tell(news, &kept);
  EXPECT_EQ(kept.messages.count(kMapChannel), 0U);
}

}  // namespace
}  // namespace pose_wall::tools::live
