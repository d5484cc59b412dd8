// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the stop answers each frame and goes on answering without one. Silence stops the machine as soon as the
// newest frame is older than planar_stale. So do refused frames, stamps that go back, frames that come slower than
// planar_period, a thing, an end in order, and a guard whose thread is gone: the heartbeat stands then. Nothing is
// permitted before the first frame. The heartbeat goes on often enough for a controller, and not so often that it seems
// to fall. A look counts while frames come. Measured motion of a machine that may stand is straight ahead. Commands
// count where they are asked for; with one of two motions unknown every motion is assumed. Why the
// machine stands is told, with the time since then. The sensor's stamps are placed on the daemon's clock: late frames
// count as old, also after a long silence.

#include "apps/live/planar/stop_guard.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "apps/live/clocks.hpp"
#include "live/frame_catcher.hpp"
#include "live/hall_frames.hpp"
#include "study/planar/stop_line.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr auto kStop = static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP);

// Where motion saw base in a frame: so far along the road, to within level_m; 0.1 s and step_m after the frame before.
LiveResult seen_at(const LoadedConfig& loaded, std::int64_t stamp_ns, double x_m, double step_m, double level_m) {
  LiveResult result;
  result.config = *loaded.config.get();
  pose_wall_motion_result& moved = result.publication.motion;
  moved.along_state = POSE_WALL_ALONG_MEASURED;
  moved.step_s = 0.1;
  moved.step_m[0] = step_m;
  result.publication.has_motion = 1;
  result.publication.motion.stamp_ns = stamp_ns;
  pose_wall_odometry& odometry = result.publication.odometry;
  odometry.run = 1;
  odometry.position_m[0] = x_m;
  odometry.quaternion[3] = odometry.along[0] = odometry.across[1] = 1.0;
  odometry.level[POSE_WALL_MOTION_ALONG] = level_m;
  return result;
}

class StopGuardTest : public ::testing::Test {
 protected:
  explicit StopGuardTest(std::vector<std::string> more = {}) {
    std::vector<std::string> settings = hall_settings();
    settings.insert(settings.end(), more.begin(), more.end());
    loaded_ = load_config("", settings);
    guard_ = std::make_unique<StopGuard>(loaded_, [this](const std::shared_ptr<const StopNews>& news) {
      const std::lock_guard<std::mutex> locked(lock_);
      told_.push_back(news);
    });
  }
  void TearDown() override { guard_->stop(); }

  void show(const Hall& hall = {}, std::int64_t period_ns = kSecond_ns / 10) {
    stamp_ns_ += period_ns;  // faster than the clock here: none of the frames is late
    guard_->take(hall_frame(stamp_ns_, ++number_, hall), *loaded_.config.get());
  }
  bool drives() const { return guard_->stop_now().result.state != kStop; }
  // Frames until it permits driving: for restart_s the way must be clear.
  bool is_brought_to_drive() {
    guard_->start();
    return becomes_true([this] {
      show();
      return drives();
    });
  }
  std::vector<std::shared_ptr<const StopNews>> told() const {
    const std::lock_guard<std::mutex> locked(lock_);
    return told_;
  }

  LoadedConfig loaded_;
  std::unique_ptr<StopGuard> guard_;
  mutable std::mutex lock_;
  std::vector<std::shared_ptr<const StopNews>> told_;
  std::int64_t stamp_ns_ = 1'700'000'000 * kSecond_ns;
  int number_ = 0;
};

TEST_F(StopGuardTest, NothingIsPermittedBeforeTheFirstFrameAndTheHeartbeatGoesOn) {
  EXPECT_FALSE(drives());
  EXPECT_EQ(guard_->stop_now().rounds, 0U) << "the thread has not begun";
  guard_->start();
  EXPECT_TRUE(becomes_true([&] { return guard_->stop_now().rounds >= 5; }));
  EXPECT_FALSE(drives());
  EXPECT_NE(guard_->stop_now().result.reasons & POSE_WALL_PLANAR_STOP_R_STALE, 0U);
  EXPECT_EQ(guard_->health().grade, Grade::kBad);
}

TEST_F(StopGuardTest, FramesPermitAndSilenceStopsAsSoonAsTheNewestIsStale) {
  ASSERT_TRUE(is_brought_to_drive()) << stop_reasons_text(guard_->stop_now().result.reasons);
  EXPECT_EQ(guard_->health().summary, "permits driving");
  ASSERT_TRUE(becomes_true([&] { return !drives(); }));
  // The first answer that stops, and the one before it; answers come at least every 20 ms on a machine that is idle.
  const StopNews stopped = guard_->stop_now();
  EXPECT_NE(stopped.result.reasons & POSE_WALL_PLANAR_STOP_R_STALE, 0U);
  std::int64_t first_age_ns = INT64_MAX, last_good_age_ns = 0;
  for (const auto& news : told()) {
    const std::int64_t age_ns = news->result.now_ns - news->result.stamp_ns;
    if (news->result.state != kStop) last_good_age_ns = std::max(last_good_age_ns, age_ns);
    if (news->result.state == kStop && news->result.frames == stopped.result.frames) {
      first_age_ns = std::min(first_age_ns, age_ns);
    }
  }
  const auto stale_ns = static_cast<std::int64_t>(loaded_.planar.stop.stale_s * 1e9);
  EXPECT_LE(last_good_age_ns, stale_ns);
  EXPECT_GT(first_age_ns, stale_ns);
  EXPECT_LT(first_age_ns, stale_ns + kSecond_ns) << "a busy machine is given time";
  EXPECT_EQ(guard_->stop_now().header_stamp_ns, stamp_ns_ + 7);
}

// Who starts the daemon anew for a short hold-up makes a longer one of it.
TEST_F(StopGuardTest, AThreadThatIsHeldUpStopsAtOnceAndIsNotTakenForOneThatHangs) {
  ASSERT_TRUE(is_brought_to_drive());
  const std::int64_t stopped_ns = guard_->state_ns().at(kStop);
  {
    const std::lock_guard<std::mutex> holds_up(lock_);  // it waits for that where it tells
    std::this_thread::sleep_for(std::chrono::nanoseconds(3 * StopGuard::kSilent_ns));
    const StopNews news = guard_->stop_now();
    EXPECT_EQ(news.result.state, kStop);
    EXPECT_NE(news.result.reasons & POSE_WALL_PLANAR_STOP_R_STALE, 0U);
    EXPECT_TRUE(guard_->is_alive());
    EXPECT_GE(guard_->state_ns().at(kStop) - stopped_ns, StopGuard::kSilent_ns)
        << "the time without answers is a stop's";
  }
  EXPECT_GT(kHangs_ns, 10 * StopGuard::kSilent_ns);
}

TEST_F(StopGuardTest, TheTimesOfTheStatesAreThatOfTheClock) {
  const std::int64_t began_ns = monotonic_ns();
  const std::vector<std::int64_t> before = guard_->state_ns();
  ASSERT_TRUE(is_brought_to_drive());
  ASSERT_TRUE(becomes_true([&] { return !drives(); }));
  const std::vector<std::int64_t> after = guard_->state_ns();
  const std::int64_t took_ns = monotonic_ns() - began_ns;
  std::int64_t sum_ns = 0;
  for (std::size_t state = 0; state < after.size(); ++state) {
    EXPECT_GE(after[state], before[state]);
    sum_ns += after[state] - before[state];
  }
  EXPECT_GT(after[POSE_WALL_PLANAR_STOP_SLOW] + after[POSE_WALL_PLANAR_STOP_GO], 0);
  EXPECT_LE(sum_ns, took_ns);
  EXPECT_GT(sum_ns, took_ns / 2) << "no time is lost";
}

// Of a recording that begins again "the newest frame is 1 s old, for 2 s" would be said.
TEST_F(StopGuardTest, AFrameThatComesTooLateBeginsTheTimeOfTheSilenceAnew) {
  ASSERT_TRUE(is_brought_to_drive());
  ASSERT_TRUE(becomes_true([&] { return !drives(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const std::uint64_t frames = guard_->stop_now().result.frames;
  show();  // a tenth of a second after the one before, by its stamp
  ASSERT_TRUE(becomes_true([&] { return guard_->stop_now().result.frames > frames; }));
  std::size_t late = 0;
  for (const auto& news : told()) {
    if (stop_cause(news->result) != StopCause::kStale) continue;
    ++late;
    EXPECT_GE(news->cause_since_ns, news->result.stamp_ns);
  }
  EXPECT_GT(late, 0U);
}

TEST_F(StopGuardTest, AThingInTheWayStopsWithItsPlace) {
  ASSERT_TRUE(is_brought_to_drive());
  Hall hall;
  hall.posts = {{1.2, 0.1, 0.2}};
  ASSERT_TRUE(becomes_true([&] {
    show(hall);
    const StopNews news = guard_->stop_now();
    return news.result.state == kStop && (news.result.reasons & POSE_WALL_PLANAR_STOP_R_THING) != 0;
  }));
  EXPECT_NEAR(guard_->stop_now().result.nearest_m[0], 1.0, 0.25);
  EXPECT_EQ(guard_->stop_now().allowed_mm_s(), 0);
  // 0.4 m before a machine of 0.6 m, with all motions assumed.
  const std::string why =
      StopLine(stop_settings_of(loaded_.planar), "+X").text(Language::kEnglish, guard_->stop_now().result, 0.0);
  EXPECT_NE(why.find(" m ahead, in the track, "), std::string::npos) << why;
}

TEST_F(StopGuardTest, WhyItStandsIsToldWithTheTimeSinceThen) {
  EXPECT_EQ(guard_->stop_now().cause_for_s(), 0.0) << "before the first answer";
  EXPECT_EQ(fact(guard_->health(), "why").find("No frame of the sensor has come yet, for 0.0 s. "), 0U);
  guard_->start();
  ASSERT_TRUE(becomes_true([&] { return guard_->stop_now().rounds >= 3; }));
  const StopNews before = guard_->stop_now();
  ASSERT_TRUE(becomes_true([&] { return guard_->stop_now().rounds >= before.rounds + 3; }));
  EXPECT_GT(guard_->stop_now().cause_for_s(), before.cause_for_s()) << "the same cause";
  ASSERT_TRUE(is_brought_to_drive());
  ASSERT_TRUE(becomes_true([&] { return !drives(); }));
  const StopNews stale = guard_->stop_now();
  EXPECT_GT(stale.cause_since_ns, before.cause_since_ns);
  EXPECT_EQ(fact(guard_->health(), "why").find("The newest frame of the sensor is "), 0U);
}

TEST_F(StopGuardTest, ARefusedFrameAndStampsThatGoBackStop) {
  ASSERT_TRUE(is_brought_to_drive());
  const std::shared_ptr<LiveFrame> broken = hall_frame(stamp_ns_ + 1, 1);
  broken->frame.cloud.point_step = 1;
  guard_->take(broken, *loaded_.config.get());
  ASSERT_TRUE(becomes_true([&] { return fact(guard_->health(), "frames refused") == "1"; }));
  const std::uint64_t rounds = guard_->stop_now().rounds;
  EXPECT_FALSE(drives());
  EXPECT_NE(guard_->stop_now().result.reasons & POSE_WALL_PLANAR_STOP_R_INVALID, 0U);
  ASSERT_TRUE(becomes_true([&] { return guard_->stop_now().rounds > rounds + 1; }));
  EXPECT_FALSE(drives()) << "the good frame before it permits nothing any more";

  ASSERT_TRUE(is_brought_to_drive());
  stamp_ns_ -= 3600 * kSecond_ns;
  show();
  ASSERT_TRUE(becomes_true([&] { return fact(guard_->health(), "frames refused") == "2"; }));
  EXPECT_FALSE(drives());
  EXPECT_TRUE(is_brought_to_drive()) << "the new time counts from then on";
}

TEST_F(StopGuardTest, AThreadThatIsGonePermitsNothingAndItsHeartbeatStands) {
  ASSERT_TRUE(is_brought_to_drive());
  guard_->stop();
  const std::uint64_t rounds = guard_->stop_now().rounds;
  ASSERT_TRUE(becomes_true([&] { return !drives(); }));
  EXPECT_EQ(guard_->stop_now().rounds, rounds);
  EXPECT_EQ(guard_->stop_now().allowed_mm_s(), 0);
}

TEST_F(StopGuardTest, AnEndInOrderSaysStopAsItsLastWord) {
  ASSERT_TRUE(is_brought_to_drive());
  guard_->stop();
  EXPECT_FALSE(drives()) << "at once, not as a thread that hangs";
  EXPECT_EQ(guard_->stop_now().allowed_mm_s(), 0);
  ASSERT_FALSE(told().empty());
  EXPECT_EQ(told().back()->result.state, kStop);
  EXPECT_NE(told().back()->result.reasons & POSE_WALL_PLANAR_STOP_R_STALE, 0U);
}

// FB_PoseWallStop (tools/apps/plc) takes 200 ms of the same heartbeat for silence, and 33 beats more between two reads
// for a gap.
TEST_F(StopGuardTest, TheHeartbeatGoesOnWithinAControllersWatchdogAndDoesNotSeemToFall) {
  ASSERT_TRUE(is_brought_to_drive());
  // Waits for 50 beats, a second's on a machine that is idle, with so many frames between them. How many there may be
  // is exact; how many there are at least hangs on what else the machine has to do.
  const auto beats_with = [this](int frames) {
    constexpr std::uint64_t kBeats = 50;
    const std::uint64_t before = guard_->stop_now().rounds;
    const std::int64_t began_ns = monotonic_ns();
    int shown = 0;
    EXPECT_TRUE(becomes_true([&] {
      if (shown < frames) show();
      shown = std::min(shown + 1, frames);
      return guard_->stop_now().rounds - before >= kBeats;
    }));
    const std::uint64_t beats = guard_->stop_now().rounds - before;
    EXPECT_LE(beats, static_cast<std::uint64_t>((monotonic_ns() - began_ns) / StopGuard::kTick_ns + frames + 1));
  };
  beats_with(10);
  beats_with(0);  // the frames have stopped, and the heartbeat tells that the guard has not
  EXPECT_FALSE(drives()) << "it is the state that stops the machine then";
  // Up to one frame in half a tick: then there are only frames, and below that at most as many ticks as frames.
  constexpr std::int64_t kSeldom_ns = 200'000'000;  // between two reads
  EXPECT_LT(2 * kSeldom_ns / StopGuard::kTick_ns, 32);
}

pose_wall_planar_stop_image controller_image(const StopNews& news) {
  pose_wall_planar_stop_image image{};
  image.struct_size = sizeof image;
  EXPECT_EQ(pose_wall_planar_stop_image_fill(&news.result, &image), POSE_WALL_OK);
  return image;
}

TEST_F(StopGuardTest, EachAnswerIsAnImageOneBeatAheadOfTheOneBefore) {
  const pose_wall_planar_stop_image before = controller_image(guard_->stop_now());
  EXPECT_EQ(before.state, kStop) << "before the thread has begun";
  guard_->start();
  ASSERT_TRUE(becomes_true([&] { return guard_->stop_now().rounds >= 5; }));
  const StopNews news = guard_->stop_now();
  const pose_wall_planar_stop_image image = controller_image(news);
  EXPECT_EQ(image.heartbeat - before.heartbeat, news.rounds);
  EXPECT_EQ(image.settings_crc32, before.settings_crc32);
  EXPECT_NE(image.settings_crc32, 0U);
  guard_->stop();
  const pose_wall_planar_stop_image last = controller_image(guard_->stop_now());
  EXPECT_EQ(last.state, kStop);
  // A daemon that is started again is ahead: 100 beats for each second, of which it gave fewer.
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const StopGuard again(loaded_, nullptr);
  const std::uint32_t ahead = controller_image(again.stop_now()).heartbeat - last.heartbeat;
  EXPECT_GT(ahead, 0U);
  EXPECT_LT(ahead, 0x80000000U);
  EXPECT_EQ(controller_image(again.stop_now()).settings_crc32, last.settings_crc32);
}

TEST_F(StopGuardTest, FramesThatComeSlowerThanThePeriodStopAndTheHealthNamesTheKey) {
  ASSERT_TRUE(is_brought_to_drive());
  ASSERT_TRUE(becomes_true([&] {
    show({}, kSecond_ns / 5);
    return guard_->health().summary.find("planar_period") != std::string::npos;
  }));
  EXPECT_FALSE(drives());
  EXPECT_NE(guard_->stop_now().result.reasons & POSE_WALL_PLANAR_STOP_R_INVALID, 0U);
  EXPECT_TRUE(is_brought_to_drive()) << "at the right rate it goes on: " << guard_->health().summary;
  show({}, kSecond_ns / 5);
  EXPECT_TRUE(becomes_true([&] { return guard_->stop_now().header_stamp_ns == stamp_ns_ + 7; }));
  EXPECT_TRUE(drives()) << "a single frame was lost";
}

TEST_F(StopGuardTest, FramesThatComeLateAreToldFromSilence) {
  ASSERT_TRUE(is_brought_to_drive());
  ASSERT_TRUE(becomes_true([&] { return guard_->health().summary == "stops the machine: no frame comes"; }));
  EXPECT_TRUE(becomes_true([&] {
    show({}, kSecond_ns / 1000);  // by its stamp it waited since before the silence
    return guard_->health().summary == "stops the machine: frames come late, by their stamps";
  })) << guard_->health().summary;
  EXPECT_FALSE(drives());
}

class SlowSensorTest : public StopGuardTest {
 protected:
  SlowSensorTest() : StopGuardTest({"planar_period=0.2", "planar_stale=0.5"}) {}
};

TEST_F(SlowSensorTest, DrivesWithTheSensorsPeriod) {
  guard_->start();
  EXPECT_TRUE(becomes_true([&] {
    show({}, kSecond_ns / 5);
    return drives();
  })) << guard_->health().summary;
}

class MeasuredStopTest : public StopGuardTest {
 protected:
  // Its motion is known from two frames by an odometry that errs by hundredths of a metre.
  MeasuredStopTest() : StopGuardTest({"planar_motion=measured", "planar_acceleration=0.01"}) {}

  // Whether it permits driving at the end of so many seconds of frames, two at least. A stop ends after a second
  // (restart_s). Each frame's odometry comes after its answer.
  bool drives_after(double seconds, const Hall& hall, double speed_m_s, double level_m) {
    const std::int64_t until_ns = monotonic_ns() + static_cast<std::int64_t>(seconds * 1e9);
    int frames = 0;
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));  // speeds are by the clock of this process
      const std::int64_t period_ns = std::max(kSecond_ns / 10, monotonic_ns() - shown_ns_);
      shown_ns_ += period_ns;
      show(hall, period_ns);
      EXPECT_TRUE(becomes_true([&] { return guard_->stop_now().header_stamp_ns == stamp_ns_ + 7; }));
      const double step_m = speed_m_s * 1e-9 * static_cast<double>(period_ns);
      x_m_ += step_m;
      guard_->note_motion(seen_at(loaded_, stamp_ns_, x_m_, step_m, level_m));
    } while (++frames < kFramesLeast || monotonic_ns() < until_ns);
    return drives();
  }

  static constexpr int kFramesLeast = 4;  // three that tell the motion, and one that is answered by it
  double x_m_ = 0.0;
  std::int64_t shown_ns_ = monotonic_ns();
};

// With its back to a wall: noise backwards is no drive backwards.
TEST_F(MeasuredStopTest, AMachineThatMayStandSetsOffAheadAndOneThatReversesDoesNot) {
  Hall hall;
  hall.wall_m = 7.0;
  hall.x_m = -5.9;  // 0.5 m behind the machine
  guard_->start();
  // The wall is believed to stand after settle_s.
  EXPECT_TRUE(becomes_true([&] { return drives_after(0.0, hall, -0.02, 0.01); }))
      << stop_reasons_text(guard_->stop_now().result.reasons);
  EXPECT_DOUBLE_EQ(guard_->stop_now().result.allowed_speed_m_s, loaded_.planar.stop.speed_max_m_s);
  drives_after(1.5, hall, -0.2, 0.01);
  EXPECT_EQ(guard_->stop_now().allowed_mm_s(), 0) << "it reverses for sure";
  EXPECT_LT(guard_->stop_now().result.nearest_m[0], 0.0) << "for what is behind";
}

// The first frame is answered before anything was measured.
TEST_F(MeasuredStopTest, TheHealthTellsTheSpeedAndByHowMuchItErrs) {
  guard_->start();
  show();
  ASSERT_TRUE(becomes_true([&] { return fact(guard_->health(), "frames answered") == "1"; }));
  EXPECT_NE(guard_->stop_now().result.reasons & POSE_WALL_PLANAR_STOP_R_MISSING, 0U);
  EXPECT_EQ(fact(guard_->health(), "speed errs by m/s"), "nan");
  drives_after(0.0, {}, 0.2, 0.02);
  EXPECT_EQ(guard_->stop_now().result.reasons & POSE_WALL_PLANAR_STOP_R_MISSING, 0U);
  // Of two places 0.2 s apart that err by 0.02 m each: 0.2 m/s, and 3 % of the speed. Frames may come late here.
  EXPECT_NEAR(std::stod(fact(guard_->health(), "speed m/s")), 0.2, 0.1);
  EXPECT_NEAR(std::stod(fact(guard_->health(), "speed errs by m/s")), 0.2, 0.1);
}

// Rays that end on the floor beyond the machine's edge: what lies between them and the machine is not seen.
TEST_F(MeasuredStopTest, ALookCountsWhileFramesComeAndNotBefore) {
  Hall hall;
  hall.lowest_deg = -65.0;
  guard_->start();
  const auto looks_after_rounds = [this] {
    const std::uint64_t rounds = guard_->stop_now().rounds;
    guard_->confirm();
    EXPECT_TRUE(becomes_true([&] { return guard_->stop_now().rounds > rounds + 2; }));
    return fact(guard_->health(), "looks heeded");
  };
  EXPECT_EQ(looks_after_rounds(), "0") << "before the first frame";
  EXPECT_FALSE(drives_after(1.5, hall, 0.0, 0.001));
  EXPECT_NE(guard_->stop_now().result.reasons & POSE_WALL_PLANAR_STOP_R_BLIND, 0U);
  ASSERT_TRUE(becomes_true([&] { return (guard_->stop_now().result.reasons & POSE_WALL_PLANAR_STOP_R_STALE) != 0; }));
  EXPECT_EQ(looks_after_rounds(), "0") << "in silence";
  EXPECT_FALSE(drives_after(1.5, hall, 0.0, 0.001));
  guard_->confirm();
  EXPECT_TRUE(drives_after(1.5, hall, 0.0, 0.001)) << stop_reasons_text(guard_->stop_now().result.reasons);
  EXPECT_EQ(fact(guard_->health(), "looks heeded"), "1");
}

TEST_F(StopGuardTest, AnotherExtrinsicBeginsAnew) {
  ASSERT_TRUE(is_brought_to_drive());
  api::Config other = loaded_.config;
  ASSERT_EQ(other.set("extrinsic_x", 0.1), POSE_WALL_OK);
  stamp_ns_ += kSecond_ns / 10;
  guard_->take(hall_frame(stamp_ns_, ++number_), *other.get());
  ASSERT_TRUE(becomes_true([&] { return guard_->stop_now().result.frames == 1; }));
  EXPECT_FALSE(drives());
}

TEST(StopGuardOf, FramesThatComeFasterThanTheyAreAnsweredAreLostAndCounted) {
  const LoadedConfig loaded = load_config("", hall_settings());
  StopGuard guard(loaded, nullptr);
  const auto frame = hall_frame(1, 1);
  for (int k = 0; k < 10; ++k) guard.take(frame, *loaded.config.get());
  EXPECT_EQ(fact(guard.health(), "frames lost to slowness"), "9");
  EXPECT_EQ(frame.use_count(), 2) << "only the newest is kept";
}

TEST(StopGuardOf, RefusedSettingsAreNamedWithWhatIsAllowed) {
  LoadedConfig loaded = load_config("", hall_settings());
  loaded.planar.stop.floor_z_m = 99.0;
  EXPECT_EQ(test::said_by<std::runtime_error>([&] { const StopGuard guard(loaded, nullptr); }),
            "planar stop: floor_z_m must be from -10 to 10");
}

// Without a motion every motion is assumed.
// Some frames at 0.2 m/s, each followed by its odometry where it is measured. Speeds are by the clock of this process.
void drive(StopGuard* guard, const LoadedConfig& loaded, bool is_measured) {
  constexpr int kFrames = 4;  // three that tell the motion, and one that is answered by it
  const std::int64_t begin_ns = monotonic_ns();
  for (int k = 1; k <= kFrames; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::int64_t since_ns = monotonic_ns() - begin_ns;
    guard->take(hall_frame(since_ns, k), *loaded.config.get());
    ASSERT_TRUE(becomes_true([&] { return fact(guard->health(), "frames answered") == std::to_string(k); }));
    if (is_measured) guard->note_motion(seen_at(loaded, since_ns, 0.2e-9 * static_cast<double>(since_ns), 0.02, 0.0));
  }
}

TEST(StopGuardOf, MeasuredMotionIsUsedOnlyWhereAskedFor) {
  for (const std::string mode : {"assumed", "measured"}) {
    std::vector<std::string> settings = hall_settings();
    settings.push_back("planar_motion=" + mode);
    const LoadedConfig loaded = load_config("", settings);
    StopGuard guard(loaded, nullptr);
    guard.start();
    drive(&guard, loaded, true);
    const StopNews news = guard.stop_now();
    EXPECT_EQ((news.result.reasons & POSE_WALL_PLANAR_STOP_R_MISSING) == 0, mode == "measured") << mode;
    const bool is_measured = mode == "measured";
    EXPECT_NEAR(news.result.rim_speed_m_s, is_measured ? 0.2 : loaded.planar.stop.speed_max_m_s, 0.1) << mode;
    EXPECT_EQ(std::isfinite(news.result.speed_m_s), is_measured);
  }
}

struct GivenMotion {
  const char* mode;
  bool is_commanded, is_measured;
  bool is_known;
  double rim_m_s;
};

// A command of 0.25 m/s, and 0.2 m/s measured. rim_speed_m_s is that of the faster one that is given.
TEST(StopGuardOf, CommandsCountWhereAskedForAndOneOfTwoUnknownMotionsLeavesAll) {
  constexpr GivenMotion kCases[] = {{"assumed", true, true, false, 0.3},    {"measured", true, true, true, 0.2},
                                    {"commanded", true, true, true, 0.25},  {"commanded", true, false, true, 0.25},
                                    {"commanded", false, true, false, 0.3}, {"both", true, true, true, 0.25},
                                    {"both", false, true, false, 0.3},      {"both", true, false, false, 0.3}};
  for (const GivenMotion& given : kCases) {
    std::vector<std::string> settings = hall_settings();
    for (const char* more : {"planar_command_modbus=127.0.0.1", "modbus=127.0.0.1:1502"}) settings.emplace_back(more);
    settings.push_back(std::string("planar_motion=") + given.mode);
    const LoadedConfig loaded = load_config("", settings);
    CommandBoard commands("test", 10.0);
    StopGuard guard(loaded, nullptr, &commands);
    if (given.is_commanded) commands.take({0.25, 0.0}, monotonic_ns());
    guard.start();
    drive(&guard, loaded, given.is_measured);
    const StopNews news = guard.stop_now();
    const std::string what =
        std::string(given.mode) + (given.is_commanded ? " commanded" : "") + (given.is_measured ? " measured" : "");
    EXPECT_EQ((news.result.reasons & POSE_WALL_PLANAR_STOP_R_MISSING) == 0, given.is_known) << what;
    EXPECT_NEAR(news.result.rim_speed_m_s, given.rim_m_s, 0.02) << what;
    if (given.is_commanded && given.is_measured) {
      EXPECT_EQ(fact(commands.health(monotonic_ns()), "command less measured m/s"), "0.050") << what;
    }
  }
}

TEST(StampClock, LateFramesAreOldAndDriftIsForgiven) {
  StampClock clock;
  std::int64_t now_ns = 50 * kSecond_ns, stamp_ns = 1'700'000'000 * kSecond_ns;
  const auto frame = [&](std::int64_t delay_ns) { return now_ns - clock.place(stamp_ns, now_ns + delay_ns).ns; };
  EXPECT_EQ(frame(10'000'000), -10'000'000) << "the first counts as new";
  for (int k = 0; k < 100; ++k) {
    now_ns += kSecond_ns / 10, stamp_ns += kSecond_ns / 10;
    EXPECT_NEAR(static_cast<double>(frame(5'000'000)), -5e6, 1e6);
  }
  now_ns += kSecond_ns / 10, stamp_ns += kSecond_ns / 10;
  EXPECT_NEAR(static_cast<double>(frame(300'000'000)), -5e6, 1e6) << "it waited for 0.3 s, and is as old as it is";
  // A sensor whose clock is slow by 100 ppm, for an hour.
  for (int k = 0; k < 36'000; ++k) now_ns += 100'010'000, stamp_ns += 100'000'000, static_cast<void>(frame(5'000'000));
  EXPECT_NEAR(static_cast<double>(frame(5'000'000)), -5e6, 1e6);
}

TEST(StampClock, ALongSilenceForgivesNoMoreThanAShortOne) {
  for (const std::int64_t silence_s : {10, 60, 86'400}) {
    StampClock clock;
    std::int64_t now_ns = 50 * kSecond_ns, stamp_ns = 1'700'000'000 * kSecond_ns;
    EXPECT_EQ(clock.place(stamp_ns, now_ns).ns, now_ns);
    now_ns += silence_s * kSecond_ns, stamp_ns += silence_s * kSecond_ns;
    const std::int64_t placed_ns = clock.place(stamp_ns, now_ns + kSecond_ns).ns;  // it waited for a second
    EXPECT_NEAR(static_cast<double>(placed_ns - now_ns), 0.0, 2.1e6) << silence_s;
  }
}

TEST(StampClock, StampsThatStandStillOrGoBackAreTold) {
  StampClock clock;
  EXPECT_TRUE(clock.place(100, 1000).is_later);
  EXPECT_FALSE(clock.place(100, 2000).is_later);
  EXPECT_FALSE(clock.place(50, 3000).is_later);
  EXPECT_TRUE(clock.place(60, 4000).is_later) << "from there on it goes on";
  EXPECT_TRUE(clock.place(INT64_MAX, 5000).is_later);
  EXPECT_FALSE(clock.place(INT64_MIN, 6000).is_later) << "no overflow";
  // Drivers without stamps.
  EXPECT_TRUE(StampClock().place(0, 7).is_later);
  EXPECT_EQ(StampClock().place(0, 7).ns, 7);
}

}  // namespace
}  // namespace pose_wall::tools::live
