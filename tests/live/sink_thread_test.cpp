// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a sink that hangs loses its own results, counted. It holds up neither who posts nor other sinks. What waits
// at a stop is still taken.

#include <gtest/gtest.h>

#include "apps/live/sink_thread.hpp"
#include "live/frame_catcher.hpp"

namespace pose_wall::tools::live {
namespace {

using pose_wall::test::becomes_true;
using pose_wall::test::fact;

// What became of a sink, for those who gave it away.
struct Seen {
  std::vector<std::uint64_t> taken;
  bool started = false, stopped = false;
};

class GatedSink final : public Sink {
 public:
  GatedSink(std::shared_ptr<Seen> seen, std::mutex* gate, std::size_t backlog)
      : seen_(std::move(seen)), gate_(gate), backlog_(backlog) {}
  void start() override { seen_->started = true; }
  void take(const LiveResult& result) override {
    const std::lock_guard<std::mutex> locked(*gate_);
    seen_->taken.push_back(result.publication.index);
  }
  void stop() override { seen_->stopped = true; }
  PartHealth health() const override { return {"sink", Grade::kGood, "runs", {}}; }
  std::size_t backlog() const override { return backlog_; }

 private:
  std::shared_ptr<Seen> seen_;
  std::mutex* gate_;
  std::size_t backlog_;
};

std::shared_ptr<const LiveResult> result_number(std::uint64_t index) {
  auto result = std::make_shared<LiveResult>();
  result->publication.index = index;
  return result;
}

TEST(SinkThread, AHangingSinkLosesItsOldestAndHoldsUpNobody) {
  std::mutex gate, open;
  const auto slow_seen = std::make_shared<Seen>(), quick_seen = std::make_shared<Seen>();
  SinkThread slow(std::make_unique<GatedSink>(slow_seen, &gate, 2));
  SinkThread quick(std::make_unique<GatedSink>(quick_seen, &open, 200));
  slow.start();
  quick.start();
  gate.lock();
  for (std::uint64_t i = 0; i < 100; ++i) {
    slow.post(result_number(i));
    quick.post(result_number(i));
  }
  EXPECT_TRUE(becomes_true([&] { return fact(quick.health(), "results taken") == "100"; }));
  gate.unlock();
  slow.stop();
  quick.stop();
  ASSERT_GE(slow_seen->taken.size(), 2U);
  EXPECT_EQ(slow_seen->taken.back(), 99U) << "the newest is never the one that is lost";
  EXPECT_EQ(slow_seen->taken[slow_seen->taken.size() - 2], 98U);
  EXPECT_EQ(fact(slow.health(), "results lost to slowness"), std::to_string(100 - slow_seen->taken.size()));
  EXPECT_EQ(fact(quick.health(), "results lost to slowness"), "0");
}

TEST(SinkThread, WhatWaitsAtAStopIsTakenAndNothingAfterIt) {
  std::mutex gate;
  const auto seen = std::make_shared<Seen>();
  SinkThread sink(std::make_unique<GatedSink>(seen, &gate, 10));
  sink.start();
  EXPECT_TRUE(seen->started);
  for (std::uint64_t i = 0; i < 5; ++i) sink.post(result_number(i));
  sink.stop();
  sink.post(result_number(5));
  sink.stop();
  EXPECT_EQ(seen->taken, (std::vector<std::uint64_t>{0, 1, 2, 3, 4}));
  EXPECT_TRUE(seen->stopped);
}

// A gate holds the sink, so that all results wait; what the mailbox holds alive is told by the clouds' own counts.
class CloudSink final : public Sink {
 public:
  explicit CloudSink(bool wants) : wants_(wants) {}
  void start() override {}
  void take(const LiveResult& result) override {
    if (result.frame) ++clouds;
    if (result.points) ++points;
    frame_id = result.frame_id;
  }
  void stop() override {}
  PartHealth health() const override {
    PartHealth health;
    health.add("clouds", clouds);
    health.add("points", points);
    health.add("frame_id", frame_id);
    return health;
  }
  std::size_t backlog() const override { return 20; }
  bool wants_clouds() const override { return wants_; }
  bool wants_points() const override { return wants_; }

  std::uint64_t clouds = 0, points = 0;
  std::string frame_id;

 private:
  bool wants_;
};

TEST(SinkThread, WhatASinkDoesNotWantIsNotKeptForIt) {
  for (const bool wants : {false, true}) {
    SinkThread sink(std::make_unique<CloudSink>(wants));  // not started: all that is posted waits
    const auto cloud = std::make_shared<const LiveFrame>();
    const auto points = std::make_shared<const LabelledPoints>();
    for (std::uint64_t i = 0; i < 20; ++i) {
      auto result = std::make_shared<LiveResult>();
      result->frame_id = "lidar";
      result->frame = cloud;
      result->points = points;
      sink.post(result);
    }
    EXPECT_EQ(cloud.use_count(), wants ? 21 : 1);
    EXPECT_EQ(points.use_count(), wants ? 21 : 1);
    sink.start();
    sink.stop();
    EXPECT_EQ(fact(sink.health(), "clouds"), wants ? "20" : "0");
    EXPECT_EQ(fact(sink.health(), "points"), wants ? "20" : "0");
    EXPECT_EQ(fact(sink.health(), "frame_id"), "lidar") << "what is small stays";
  }
}

// Of news the newest matters: what a slow sink has not taken is lost, counted, and takes no result's place.
class NewsSink final : public Sink {
 public:
  NewsSink(bool wants, std::vector<std::string>* taken) : wants_(wants), taken_(taken) {}
  void start() override {}
  void take(const LiveResult& result) override {
    taken_->push_back("result " + std::to_string(result.publication.index));
  }
  void take_stop(const StopNews& news) override { taken_->push_back("stop " + std::to_string(news.rounds)); }
  void take_roadway(const RoadwayNews& news) override { taken_->push_back("roadway " + news.state); }
  bool wants_planar() const override { return wants_; }
  void stop() override {}
  PartHealth health() const override { return {"sink", Grade::kGood, "runs", {}}; }
  std::size_t backlog() const override { return 3; }

 private:
  bool wants_;
  std::vector<std::string>* taken_;
};

TEST(SinkThread, TheNewestNewsOfEachKindGoToWhoWantsThem) {
  for (const bool wants : {false, true}) {
    std::vector<std::string> taken;
    SinkThread sink(std::make_unique<NewsSink>(wants, &taken));  // not started: all that is posted waits
    for (std::uint64_t i = 0; i < 3; ++i) {
      sink.post(result_number(i));
      auto stop = std::make_shared<StopNews>();
      stop->rounds = i;
      sink.post(std::shared_ptr<const StopNews>(stop));
      auto roadway = std::make_shared<RoadwayNews>();
      roadway->state = std::to_string(i);
      sink.post(std::shared_ptr<const RoadwayNews>(roadway));
    }
    sink.start();
    sink.stop();
    const std::vector<std::string> results = {"result 0", "result 1", "result 2"};
    const std::vector<std::string> all = {"stop 2", "result 0", "roadway 2", "result 1", "result 2"};
    EXPECT_EQ(taken, wants ? all : results);
    EXPECT_EQ(fact(sink.health(), "results lost to slowness"), "0");
    EXPECT_EQ(fact(sink.health(), "results taken"), "3");
    if (wants) {
      EXPECT_EQ(fact(sink.health(), "planar news lost to slowness"), "4");
    }
  }
}

TEST(SinkThread, OneThatNeverBeganIsNotStopped) {
  std::mutex gate;
  const auto seen = std::make_shared<Seen>();
  { SinkThread sink(std::make_unique<GatedSink>(seen, &gate, 1)); }
  EXPECT_FALSE(seen->stopped);
}

}  // namespace
}  // namespace pose_wall::tools::live
