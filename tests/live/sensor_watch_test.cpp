// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: health tells what a sensor says of itself, and how far its clock is ahead of this machine's, whatever the
// network holds up. What was never told is no alert, and no all-clear. A clock that loses its time server is told.

#include <gtest/gtest.h>

#include "apps/live/clocks.hpp"
#include "apps/live/host_clock.hpp"
#include "apps/live/sources/sensor_watch.hpp"
#include "live/frame_catcher.hpp"
#include "tools/ouster_packets.hpp"
#include "tools/packet_files.hpp"

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;

constexpr std::int64_t kHour_ns = 3'600'000'000'000;         // at which a Velodyne's clock begins anew
constexpr std::int64_t kNow_ns = 1'800'000'000'000'000'000;  // some day of 2027

double ahead_ms_of(const ClockAhead& ahead) {
  return 1e-6 * static_cast<double>(ahead.ahead_ns().value_or(-1));
}

TEST(ClockAhead, IsThatOfThePacketThatWasFastest) {
  ClockAhead ahead;
  EXPECT_FALSE(ahead.ahead_ns());
  for (const std::int64_t late_us : {900, 30'000, 400, 5'000}) {
    ahead.hear({kNow_ns + 20'000'000}, kNow_ns + 1000 * late_us);
  }
  EXPECT_DOUBLE_EQ(ahead_ms_of(ahead), 19.6);
  EXPECT_TRUE(ahead.is_of_a_date());
}

TEST(ClockAhead, FollowsAClockThatIsSet) {
  ClockAhead ahead;
  ahead.hear({kNow_ns + 50'000'000}, kNow_ns);
  // 12 s later, packet by packet, it is 3 ms behind: nothing of before is left.
  for (std::int64_t s = 1; s <= 12; ++s)
    ahead.hear({kNow_ns + s * 1'000'000'000 - 3'000'000}, kNow_ns + s * 1'000'000'000);
  EXPECT_DOUBLE_EQ(ahead_ms_of(ahead), -3.0);
}

TEST(ClockAhead, OfAClockOfTheHourTheNearestHourCounts) {
  const std::int64_t of_hour_ns = kNow_ns % kHour_ns;
  for (const std::int64_t off_ns : {std::int64_t{4'000'000}, std::int64_t{-4'000'000}, kHour_ns / 4, -kHour_ns / 4}) {
    ClockAhead ahead;
    ahead.hear({(of_hour_ns + off_ns + kHour_ns) % kHour_ns, kHour_ns}, kNow_ns);
    EXPECT_DOUBLE_EQ(ahead_ms_of(ahead), 1e-6 * static_cast<double>(off_ns));
    // On the other side of the full hour.
    ClockAhead around;
    around.hear({(off_ns + kHour_ns) % kHour_ns, kHour_ns}, kNow_ns - of_hour_ns);
    EXPECT_DOUBLE_EQ(ahead_ms_of(around), 1e-6 * static_cast<double>(off_ns));
  }
}

PartHealth told_by(const SensorWatch& watch, const std::string& summary = "receives", Grade grade = Grade::kGood) {
  PartHealth health;
  health.summary = summary;
  health.grade = grade;
  watch.tell(grade == Grade::kBad, &health);
  return health;
}

void hear(SensorWatch* watch, const std::string& payload, const std::string& metadata = "") {
  watch->hear({0, {}, tools::test::view_of(payload)}, [&] { return metadata; });
}

std::string livox(char time_type, std::int64_t clock_ns) {
  const std::string point = tools::test::raw(1000) + tools::test::raw(0) + tools::test::raw(0) + "\x2A" + '\0';
  std::string payload = tools::test::mid360_payload(1, static_cast<std::uint64_t>(clock_ns), {point, point});
  payload[11] = time_type;
  return payload;
}

TEST(SensorWatch, ALivoxTellsItsClockAndThatItLostIt) {
  SensorWatch watch;
  EXPECT_TRUE(told_by(watch).facts.empty());
  hear(&watch, livox(0, 5'000'000'000));
  EXPECT_EQ(fact(told_by(watch), "sensor clock"), "since_start");
  EXPECT_EQ(fact(told_by(watch), "sensor synchronised"), "no");
  EXPECT_EQ(told_by(watch).grade, Grade::kGood) << "it never had another clock";
  EXPECT_EQ(fact(told_by(watch), "sensor alerts"), "there is no fact 'sensor alerts'") << "it cannot tell";
  hear(&watch, livox(1, wall_ns() + kHour_ns));
  EXPECT_EQ(fact(told_by(watch), "sensor synchronised"), "yes");
  EXPECT_NEAR(std::stod(fact(told_by(watch), "sensor clock ahead ms")), 3.6e6, 10'000.0);
  hear(&watch, livox(0, 6'000'000'000));
  EXPECT_EQ(told_by(watch).grade, Grade::kWarning);
  EXPECT_EQ(told_by(watch).summary, "receives; the sensor's clock is no longer synchronised: is its time server gone?");
}

TEST(SensorWatch, KnowsWhenAClockThatWasNeverSetBegan) {
  SensorWatch watch;
  EXPECT_FALSE(watch.started_ns());
  const std::int64_t before_ns = wall_ns();
  hear(&watch, livox(0, 5'000'000'000));
  const std::int64_t started_ns = watch.started_ns().value_or(0);
  EXPECT_GE(started_ns, before_ns - 5'000'000'000);
  EXPECT_LE(started_ns, wall_ns() - 5'000'000'000);
  SensorWatch dated;
  hear(&dated, livox(1, wall_ns() + kHour_ns));
  EXPECT_EQ(dated.started_ns().value_or(-1), 0) << "its own date counts, right or wrong";
}

TEST(SensorWatch, AnAlertIsAWarningAndTheLastWordOfASensorThatFellSilent) {
  tools::test::OusterPacket packet;
  packet.serial = tools::test::kOusterSerial;
  const std::string json =
      tools::test::ouster_json({"RNG15_RFL8_NIR8", "", tools::test::ouster_serial_told(packet.serial)});
  std::string payload = payload_of(packet);
  SensorWatch watch;
  hear(&watch, payload, json);
  EXPECT_EQ(told_by(watch).grade, Grade::kGood);
  EXPECT_EQ(fact(told_by(watch), "sensor alerts"), "0");
  payload[18] = 1;
  hear(&watch, payload, json);
  EXPECT_EQ(told_by(watch).grade, Grade::kWarning);
  EXPECT_EQ(fact(told_by(watch), "sensor alerts"), "1");
  const PartHealth silent = told_by(watch, "the sensor is silent", Grade::kBad);
  EXPECT_EQ(silent.grade, Grade::kBad);
  EXPECT_EQ(silent.summary, "the sensor is silent; the sensor is too hot and will switch itself off: cool it");
  EXPECT_EQ(fact(silent, "sensor alerts"), "there is no fact 'sensor alerts'") << "nothing of it is of now";
  watch.begin_anew();
  EXPECT_EQ(told_by(watch).summary, "receives") << "it came back cool, or another one did";
}

TEST(SensorWatch, PacketsThatTheNetworkLostAreCountedAcrossSilences) {
  SensorWatch watch;
  const auto numbered = [](int number) {
    std::string payload = livox(1, kNow_ns + number);
    payload.replace(7, 2, tools::test::raw(static_cast<std::uint16_t>(number)));
    return payload;
  };
  for (const int number : {1, 2, 5}) hear(&watch, numbered(number));
  EXPECT_EQ(fact(told_by(watch), "packets lost on the way"), "2");
  hear(&watch, numbered(4));
  EXPECT_EQ(fact(told_by(watch), "packets lost on the way"), "2") << "one came late, and no count goes back";
  watch.begin_anew();
  for (const int number : {100, 101, 103}) hear(&watch, numbered(number));
  EXPECT_EQ(fact(told_by(watch), "packets lost on the way"), "2") << "one and one";
}

TEST(HostClock, OneThatWasNeverSetIsNoFaultAndOneThatLostItsServerIs) {
  std::optional<HostClockState> now;
  const HostClock clock([&] { return now; });
  EXPECT_EQ(clock.health().grade, Grade::kGood);
  EXPECT_EQ(fact(clock.health(), "synchronised"), "-");
  now = HostClockState{false, 16'000.0};
  EXPECT_EQ(clock.health().grade, Grade::kGood);
  EXPECT_EQ(fact(clock.health(), "synchronised"), "no");
  now = HostClockState{true, 12.5};
  EXPECT_EQ(fact(clock.health(), "synchronised"), "yes");
  EXPECT_EQ(fact(clock.health(), "error at most ms"), "12.5");
  now = HostClockState{false, 16'000.0};
  EXPECT_EQ(clock.health().grade, Grade::kWarning);
  now = HostClockState{true, 1.0};
  EXPECT_EQ(clock.health().grade, Grade::kGood);
}

TEST(HostClock, TheKernelIsAskedAndNotSet) {
  const std::optional<HostClockState> now = read_host_clock();
  if (now) {
    EXPECT_GE(now->error_most_ms, 0.0);
  }
  const HostClock clock;
  EXPECT_NE(clock.health().grade, Grade::kBad);
}

}  // namespace
}  // namespace pose_wall::tools::live
