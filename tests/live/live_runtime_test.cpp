// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: each result comes with the very frame that it measures, with its stamp and labelled points. With the
// extrinsic from tf nothing is measured before it is known. It is measured anew when the extrinsic changes, and no more
// when it is gone. Images can be asked for at any time. A recording played as fast as possible loses nothing.

#include <gtest/gtest.h>
#include <sched.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/live_runtime.hpp"
#include "apps/live/mqtt/last_value.hpp"
#include "apps/live/page/probes.hpp"
#include "live/frame_catcher.hpp"
#include "tools/test_files.hpp"

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;

// A road 5 m wide and 3.2 m high, seen from 1.2 m above its floor.
LiveFrame road_frame(std::int64_t stamp_ns, float aside_m = 0.0F) {
  std::vector<std::array<float, 4>> points;
  for (int ring = 0; ring < 64; ++ring) {
    for (int column = 0; column < 1024; ++column) {
      const double elevation = (-45.0 + 90.0 * ring / 63.0) * M_PI / 180.0, azimuth = 2.0 * M_PI * column / 1024;
      const double x = std::cos(elevation) * std::cos(azimuth), y = std::cos(elevation) * std::sin(azimuth);
      const double z = std::sin(elevation);
      const double to_side =
          y > 0 ? (2.5 - static_cast<double>(aside_m)) / y : (2.5 + static_cast<double>(aside_m)) / -y;
      // Each place of the machine has a noise of its own.
      const double noise = std::fmod(61.8034 * static_cast<double>(aside_m) + 0.754878 * column + 0.56984 * ring, 1.0);
      const double range = std::min(to_side, z > 0 ? 2.0 / z : z < 0 ? 1.2 / -z : 1e9) + 0.001 * noise;
      if (range > 25.0) continue;
      points.push_back(
          {static_cast<float>(range * x), static_cast<float>(range * y), static_cast<float>(range * z), 9});
    }
  }
  Bytes bytes(points.size() * sizeof points[0]);
  std::memcpy(bytes.data(), points.data(), bytes.size());
  PointLayout layout;
  layout.count = static_cast<std::uint32_t>(points.size());
  layout.point_step = sizeof points[0];
  layout.fields = {
      {"x", {0, POSE_WALL_FIELD_FLOAT32}}, {"y", {4, POSE_WALL_FIELD_FLOAT32}}, {"z", {8, POSE_WALL_FIELD_FLOAT32}}};
  LiveFrame frame;
  frame.frame = describe_frame(std::move(bytes), layout);
  frame.stamp_ns = stamp_ns + 7;
  frame.frame.cloud.stamp_ns = stamp_ns;
  return frame;
}

class Collected {
 public:
  void add(const std::shared_ptr<const LiveResult>& result) {
    const std::lock_guard<std::mutex> locked(lock_);
    results_.push_back(result);
  }
  // Of frames, not of silence.
  std::vector<std::shared_ptr<const LiveResult>> measured() const {
    const std::lock_guard<std::mutex> locked(lock_);
    std::vector<std::shared_ptr<const LiveResult>> frames;
    for (const auto& result : results_) {
      if (result->publication.cause == POSE_WALL_RUNTIME_FRAME) frames.push_back(result);
    }
    return frames;
  }

 private:
  mutable std::mutex lock_;
  std::vector<std::shared_ptr<const LiveResult>> results_;
};

class LiveRuntimeTest : public ::testing::Test {
 protected:
  void open(const std::vector<std::string>& settings, bool wants_points = false) {
    runtime_ = std::make_unique<LiveRuntime>(
        load_config("", settings), [] { return BlackBox{}; },
        [this](const std::shared_ptr<const LiveResult>& result) {
          while (holds_up_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
          collected_.add(result);
        },
        [wants_points] { return wants_points; });
    runtime_->start();
  }

  Collected collected_;
  std::atomic<bool> holds_up_{false};  // the worker, where it posts
  std::unique_ptr<LiveRuntime> runtime_;
};

TEST_F(LiveRuntimeTest, EachResultComesWithItsFrame) {
  open({}, true);
  for (int i = 0; i < 10; ++i) {
    runtime_->take(road_frame(i * 100'000'000, 0.01F * static_cast<float>(i)));  // repeats would be a frozen sensor's
    runtime_->wait_idle();
  }
  runtime_->stop();
  const auto results = collected_.measured();
  ASSERT_EQ(results.size(), 10U);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const LiveResult& result = *results[i];
    ASSERT_TRUE(result.frame);
    EXPECT_EQ(result.publication.result.stamp_ns, static_cast<std::int64_t>(i) * 100'000'000);
    EXPECT_EQ(result.frame->stamp_ns, result.publication.result.stamp_ns + 7) << "the header's stamp goes along";
    EXPECT_EQ(result.frame->frame_id, "lidar") << "lidar_frame, where the source has none";
    // Nobody knows how the machine moved in the first, whose points have no times.
    const std::uint32_t state = result.publication.result.quantity[POSE_WALL_YAW].state;
    EXPECT_EQ(state, i == 0 ? POSE_WALL_DEGRADED : POSE_WALL_VALID) << i;
    ASSERT_TRUE(result.points);
    EXPECT_EQ(result.points->label.size(), result.points->x_base_m.size());
    EXPECT_GT(std::count(result.points->label.begin(), result.points->label.end(), POSE_WALL_LABEL_LEFT), 500);
  }
}

// Whatever the source is, for it is the runtime that looks.
TEST_F(LiveRuntimeTest, TimesOfNoUseStandInTheHealthUntilTheyAreGood) {
  open({});
  const auto take = [this](std::int64_t i, std::uint32_t time_at) {
    LiveFrame frame = road_frame(i * 100'000'000, 0.01F * static_cast<float>(i % 7));
    frame.frame.cloud.time = {time_at, POSE_WALL_FIELD_FLOAT32};
    runtime_->take(std::move(frame));
    runtime_->wait_idle();
  };
  for (std::int64_t i = 0; i < 2; ++i) take(i, 12);  // what is of all points the same
  EXPECT_EQ(fact(runtime_->health(), "times of points"), "one_time");
  EXPECT_EQ(runtime_->health().grade, Grade::kWarning);
  for (std::int64_t i = 2; i < 32; ++i) take(i, 0);  // x, of 50 m: as ms a scan of 0.05 s
  EXPECT_EQ(fact(runtime_->health(), "times of points"), "good");
  EXPECT_EQ(runtime_->health().summary.find("of no use"), std::string::npos) << runtime_->health().summary;
}

// Of this process's threads, those that go before all usual work.
int urgent_threads() {
  int count = 0;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    if (sched_getscheduler(std::stoi(thread.path().filename())) == SCHED_FIFO) ++count;
  }
  return count;
}

TEST_F(LiveRuntimeTest, TheWorkerGoesBeforeOtherWorkOrHealthSaysWhyNot) {
  const int before = urgent_threads();
  open({"worker_priority=1"});
  runtime_->take(road_frame(0, 0.0F));
  runtime_->wait_idle();
  const auto facts = runtime_->health().facts;
  const bool is_refused =
      std::any_of(facts.begin(), facts.end(), [](const auto& fact) { return fact.first == "worker_priority refused"; });
  EXPECT_EQ(urgent_threads() - before, is_refused ? 0 : 1);
  runtime_->stop();
}

TEST_F(LiveRuntimeTest, NobodyWantsPointsNobodyGetsThem) {
  open({});
  runtime_->take(road_frame(0));
  runtime_->wait_idle();
  runtime_->stop();
  ASSERT_EQ(collected_.measured().size(), 1U);
  EXPECT_FALSE(collected_.measured()[0]->points);
}

TEST_F(LiveRuntimeTest, NothingIsMeasuredBeforeTheTransformIsKnownAndAfterItIsGone) {
  open({"source=ros1", "extrinsic_from=tf"});
  runtime_->take(road_frame(0));
  EXPECT_EQ(fact(runtime_->health(), "dropped, no transform yet"), "1");
  EXPECT_NE(runtime_->health().summary.find("waits for the transform"), std::string::npos);

  Extrinsic extrinsic;
  extrinsic.y_m = 0.5;
  runtime_->set_extrinsic(extrinsic);
  runtime_->take(road_frame(100'000'000));
  runtime_->wait_idle();
  runtime_->set_extrinsic(extrinsic);
  EXPECT_EQ(fact(runtime_->health(), "opened"), "2") << "the same transform again changes nothing";

  // A source tells it with every cloud; the runtime is opened anew at most every two seconds.
  extrinsic.y_m = -0.5;
  ASSERT_TRUE(becomes_true([&] {
    runtime_->set_extrinsic(extrinsic);
    return fact(runtime_->health(), "opened") == "3";
  }));
  runtime_->take(road_frame(200'000'000));
  runtime_->wait_idle();
  runtime_->set_extrinsic(std::nullopt);
  runtime_->take(road_frame(300'000'000));
  runtime_->stop();

  const auto results = collected_.measured();
  ASSERT_EQ(results.size(), 2U);
  const auto d_lf = [&](std::size_t i) { return results[i]->publication.result.quantity[POSE_WALL_D_LF].value; };
  EXPECT_NEAR(d_lf(0), 3.0, 0.01) << "base is half a metre to the right of the sensor";
  EXPECT_NEAR(d_lf(1), 2.0, 0.01);
  EXPECT_EQ(fact(runtime_->health(), "dropped, no transform yet"), "2");
}

// The obstacle stop sees them so.
TEST_F(LiveRuntimeTest, FramesAreWatchedAsTheyComeWithTheExtrinsicThatHolds) {
  std::vector<std::pair<std::int64_t, double>> seen;
  runtime_ = std::make_unique<LiveRuntime>(
      load_config("", {"source=ros1", "extrinsic_from=tf", "frame_points_max=1000"}), [] { return BlackBox{}; },
      [this](const std::shared_ptr<const LiveResult>& result) { collected_.add(result); }, [] { return false; });
  runtime_->watch_frames([&seen](const std::shared_ptr<const LiveFrame>& frame, const pose_wall_config& config) {
    double y_m = 0.0;
    ASSERT_EQ(pose_wall_config_get_number(&config, "extrinsic_y", &y_m), POSE_WALL_OK);
    seen.emplace_back(frame->frame.cloud.stamp_ns, y_m);
  });
  runtime_->start();
  runtime_->take(road_frame(0));
  EXPECT_TRUE(seen.empty()) << "nobody knows yet where the sensor stands";
  Extrinsic extrinsic;
  extrinsic.y_m = 0.5;
  runtime_->set_extrinsic(extrinsic);
  runtime_->take(road_frame(100'000'000));
  runtime_->stop();
  EXPECT_EQ(seen, (std::vector<std::pair<std::int64_t, double>>{{100'000'000, 0.5}})) << "though the engine refuses it";
  EXPECT_TRUE(collected_.measured().empty());
}

TEST_F(LiveRuntimeTest, ATransformOutOfRangeIsRefusedAndNothingIsMeasured) {
  open({"source=ros1", "extrinsic_from=tf"});
  Extrinsic far;
  far.x_m = 1e6;
  runtime_->set_extrinsic(far);
  runtime_->take(road_frame(0));
  runtime_->stop();
  EXPECT_TRUE(collected_.measured().empty());
}

TEST_F(LiveRuntimeTest, WithTheExtrinsicOfTheConfigTfChangesNothing) {
  open({"extrinsic_y=0.5"});
  runtime_->set_extrinsic(Extrinsic{});
  runtime_->take(road_frame(0));
  runtime_->wait_idle();
  runtime_->stop();
  EXPECT_NEAR(collected_.measured().at(0)->publication.result.quantity[POSE_WALL_D_LF].value, 3.0, 0.01);
}

TEST_F(LiveRuntimeTest, ImagesAreSoundBeforeWhileAndAfterItRuns) {
  open({});
  EXPECT_EQ(runtime_->image().verdict, static_cast<std::uint32_t>(POSE_WALL_INVALID));
  for (const int i : {0, 1}) {  // the first one's motion is not known
    runtime_->take(road_frame(i * 100'000'000, 0.01F * static_cast<float>(i)));
    runtime_->wait_idle();
  }
  EXPECT_EQ(runtime_->image().verdict, static_cast<std::uint32_t>(POSE_WALL_VALID));
  runtime_->stop();
  EXPECT_EQ(runtime_->image().verdict, static_cast<std::uint32_t>(POSE_WALL_INVALID));
  EXPECT_EQ(runtime_->image2().struct_size, sizeof(pose_wall_image2));
}

TEST_F(LiveRuntimeTest, TheNewestResultHasWhatItsFramesHeaderSays) {
  open({});
  EXPECT_FALSE(runtime_->newest().is_there());
  runtime_->take(road_frame(0));
  runtime_->wait_idle();
  const Newest first = runtime_->newest();
  ASSERT_TRUE(first.is_fresh());
  EXPECT_EQ(first.result.frame_id, "lidar");
  EXPECT_EQ(first.result.header_stamp_ns, 7);
  EXPECT_FALSE(first.result.frame);
  holds_up_ = true;
  runtime_->take(road_frame(100'000'000, 0.01F));
  ASSERT_TRUE(becomes_true([&] { return runtime_->newest().result.publication.frame == 1; }));
  EXPECT_EQ(runtime_->newest().result.header_stamp_ns, 100'000'007) << "before anybody was told of it";
  holds_up_ = false;
  ASSERT_TRUE(becomes_true([&] { return runtime_->newest().result.publication.cause == POSE_WALL_RUNTIME_SILENCE; }));
  const Newest silence = runtime_->newest();
  EXPECT_EQ(silence.result.header_stamp_ns, 100'000'007) << "of the last one that was measured";
  EXPECT_EQ(silence.result.frame_id, "");
  runtime_->stop();
  EXPECT_FALSE(runtime_->newest().is_there());
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// By each way that asks, for a result that one of them calls stale must be so to all.
TEST_F(LiveRuntimeTest, AWorkerThatIsHeldUpSteersNothingAnywhereFourTenthsOfASecondLater) {
  open({});
  runtime_->take(road_frame(0));
  runtime_->wait_idle();
  const auto moment = [this] {
    Moment now;
    now.parts = {runtime_->health()};
    now.newest = runtime_->newest();
    now.now_ns = monotonic_ns();
    return now;
  };
  const auto may_steer = [](const Moment& now) { return last_value(now.newest, now.now_ns, wall_ns()).json; };
  holds_up_ = true;
  runtime_->take(road_frame(100'000'000, 0.01F));
  ASSERT_TRUE(becomes_true([&] { return runtime_->newest().result.publication.frame == 1; }));
  const Moment fresh = moment();
  ASSERT_TRUE(fresh.newest.is_fresh()) << "it was published just now";
  EXPECT_TRUE(ready_probe(fresh).is_well);
  EXPECT_EQ(count_of(metrics_text(fresh), "pose_wall_may_steer{value=\"yaw\"} 1\n"), 1U);
  EXPECT_NE(may_steer(fresh).find(R"("state":"live")"), std::string::npos);

  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  const Moment held = moment();
  EXPECT_FALSE(ready_probe(held).is_well);
  const std::string metrics = metrics_text(held);
  EXPECT_EQ(count_of(metrics, "pose_wall_may_steer{value="), std::size_t{POSE_WALL_QUANTITIES});
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::string name = pose_wall_quantity_name(q);
    EXPECT_EQ(count_of(metrics, "pose_wall_may_steer{value=\"" + name + "\"} 0\n"), 1U);
    EXPECT_EQ(held.newest.result.publication.result.quantity[q].state, POSE_WALL_INVALID);
  }
  EXPECT_EQ(count_of(metrics, "pose_wall_angle_radians{"), 0U);
  EXPECT_NE(may_steer(held).find(R"("may_steer":[])"), std::string::npos);
  EXPECT_NE(may_steer(held).find(R"("state":"stale")"), std::string::npos);
  EXPECT_EQ(runtime_->image().verdict, static_cast<std::uint32_t>(POSE_WALL_INVALID));
  EXPECT_EQ(held.parts[0].grade, Grade::kBad);
  holds_up_ = false;
  runtime_->stop();
}

TEST_F(LiveRuntimeTest, ACloudThatIsTooLargeIsNamed) {
  open({"frame_points_max=1000"});
  runtime_->take(road_frame(0));
  runtime_->stop();
  EXPECT_EQ(fact(runtime_->health(), "last refusal"), pose_wall_runtime_status_text(POSE_WALL_RUNTIME_E_LARGE));
}

class Replay : public ::testing::Test {
 protected:
  // Ascii frames of three points, named by their stamps.
  std::string folder_with(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      folder_.write(name,
                    "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\n"
                    "DATA ascii\n1 2 3\n");
    }
    return folder_.path();
  }

  test::TempFolder folder_;
};

TEST_F(Replay, AtSpeedZeroWaitsForEachFrameAndEnds) {
  ReplayPlan plan;
  plan.inputs = {folder_with({"a0.pcd", "a1.pcd", "a2.pcd"})};
  plan.speed = 0.0;
  const auto source = make_replay_source(plan);
  FrameCatcher catcher;
  source->start(catcher);
  ASSERT_TRUE(becomes_true([&] { return source->is_finished(); }));
  source->stop();
  EXPECT_EQ(catcher.frames().size(), 3U);
  EXPECT_GE(catcher.idle_waits(), 3U);
}

TEST_F(Replay, RepeatedGoesOnInTime) {
  ReplayPlan plan;
  plan.inputs = {folder_with({"a0.pcd", "a1.pcd", "a2.pcd"})};
  plan.speed = 1000.0;
  plan.repeat = true;
  const auto source = make_replay_source(plan);
  FrameCatcher catcher;
  source->start(catcher);
  ASSERT_TRUE(catcher.wait_for_frames(8));
  source->stop();
  EXPECT_FALSE(source->is_finished() && catcher.frames().size() < 8);
  for (std::size_t i = 1; i < catcher.frames().size(); ++i) {
    EXPECT_GT(catcher.frames()[i].stamp_ns, catcher.frames()[i - 1].stamp_ns) << i;
  }
}

TEST_F(Replay, WhatCannotBeReadIsNamedAndTheRestIsPlayed) {
  ReplayPlan plan;
  plan.inputs = {folder_with({"a0.pcd", "a1.pcd"})};
  folder_.write("a2.pcd", "no cloud");
  plan.speed = 0.0;
  const auto source = make_replay_source(plan);
  FrameCatcher catcher;
  source->start(catcher);
  ASSERT_TRUE(becomes_true([&] { return source->is_finished(); }));
  EXPECT_EQ(catcher.frames().size(), 2U);
  EXPECT_EQ(fact(source->health(), "unreadable"), "1");
  plan.inputs = {"/nowhere"};
  EXPECT_THROW(make_replay_source(plan), std::runtime_error);
}

}  // namespace
}  // namespace pose_wall::tools::live
