// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what lies between two packets is told by the sensor's clock, however they arrive: in bursts, late, over the
// clock's second, beside a clock of the computer that runs otherwise or is set. Where the sensor's clock stands still
// or is set, arrival tells. A hole of the field of view moves no time on either side of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/packets/hesai.hpp"
#include "io/packets/lslidar.hpp"
#include "io/packets/packet_clock.hpp"
#include "io/packets/robosense.hpp"
#include "io/packets/velodyne.hpp"
#include "lslidar_packets.hpp"
#include "robosense_packets.hpp"

namespace pose_wall::tools {
namespace {

// Some day in 2023, and what a packet of a VLP-16 takes.
constexpr std::int64_t kBegan_ns = 1'700'000'000'000'000'000, kStep_ns = 1'327'000;

TEST(PacketClock, BurstsMoveNoMoment) {
  PacketClock clock;
  for (std::int64_t i = 0; i < 5'000; ++i) {
    // Twenty arrive together, when the last of them was sent, 0.2 ms on the way.
    const std::int64_t arrival_ns = kBegan_ns + (i / 20 * 20 + 19) * kStep_ns + 200'000;
    const std::int64_t moment_ns =
        clock.moment_ns(arrival_ns, (i * kStep_ns + 700'000'000) % kClockSecond_ns, kClockSecond_ns);
    EXPECT_EQ(moment_ns, kBegan_ns + 19 * kStep_ns + 200'000 + i * kStep_ns) << i;
    // The last of a burst is the one that comes at once: 19 packets earlier than the first seemed to be.
    if (i < 19) continue;
    EXPECT_EQ(moment_ns + clock.offset_ns(), kBegan_ns + i * kStep_ns + 200'000) << i;
  }
}

TEST(PacketClock, PacketsThatComeLateKeepTheirMoment) {
  PacketClock clock;
  std::vector<std::int64_t> moments_ns;
  for (const std::int64_t number : {0, 1, 3, 2, 4}) {
    moments_ns.push_back(clock.moment_ns(kBegan_ns + 10 * kStep_ns, 1'000 + number * kStep_ns, 0));
  }
  EXPECT_EQ(moments_ns[3] - moments_ns[0], 2 * kStep_ns);
  EXPECT_EQ(moments_ns[4] - moments_ns[0], 4 * kStep_ns);
}

TEST(PacketClock, AClockThatStandsStillOrIsNoneGoesOnAsPacketsArrive) {
  PacketClock standing, none;
  for (std::int64_t i = 0; i < 3'000; ++i) {
    const std::int64_t arrival_ns = kBegan_ns + i * kStep_ns + (i % 7) * 10'000;
    EXPECT_EQ(standing.moment_ns(arrival_ns, 42, kClockSecond_ns), arrival_ns);
    EXPECT_EQ(none.moment_ns(arrival_ns, std::nullopt, 0), arrival_ns);
  }
  EXPECT_EQ(standing.offset_ns(), 0);
  EXPECT_EQ(none.offset_ns(), 0);
}

TEST(PacketClock, AClockThatIsSetLosesNothing) {
  for (const std::int64_t set_ns :
       {std::int64_t{-3'000'000'000}, std::int64_t{-100'000'000}, std::int64_t{5'000'000'000}}) {
    PacketClock clock;
    for (std::int64_t i = 0; i < 2'000; ++i) {
      const std::int64_t arrival_ns = kBegan_ns + i * kStep_ns;
      const std::int64_t clock_ns = 10'000'000'000 + i * kStep_ns + (i >= 1'000 ? set_ns : 0);
      EXPECT_EQ(clock.moment_ns(arrival_ns, clock_ns, 0) + clock.offset_ns(), arrival_ns) << set_ns << ", " << i;
    }
  }
}

// A quartz is wrong by up to 100 millionths: stamps follow arrival all the same.
TEST(PacketClock, StampsFollowAComputerWhoseClockRunsOtherwise) {
  for (const double rate : {-1e-4, 1e-4}) {
    PacketClock clock;
    for (std::int64_t i = 0; i < 100'000; ++i) {
      const std::int64_t sent_ns = i * kStep_ns;
      const std::int64_t arrival_ns = kBegan_ns + sent_ns + std::llround(rate * static_cast<double>(sent_ns));
      const std::int64_t moment_ns = clock.moment_ns(arrival_ns, sent_ns % kClockSecond_ns, kClockSecond_ns);
      EXPECT_NEAR(static_cast<double>(moment_ns + clock.offset_ns() - arrival_ns), 0.0, 2e9 * 1e-4 + 1e3) << i;
    }
  }
}

TEST(PacketClock, StampsFollowAComputerWhoseClockIsSet) {
  for (const std::int64_t set_ns : {std::int64_t{-3'000'000'000}, std::int64_t{3'000'000'000}}) {
    PacketClock clock;
    for (std::int64_t i = 0; i < 10'000; ++i) {
      const std::int64_t arrival_ns = kBegan_ns + i * kStep_ns + (i >= 4'000 ? set_ns : 0);
      EXPECT_EQ(clock.moment_ns(arrival_ns, i * kStep_ns, 0) + clock.offset_ns(), arrival_ns) << set_ns << ", " << i;
    }
  }
}

// One time of arrival that is damaged harms its own packet alone.
TEST(PacketClock, ADamagedTimeOfArrivalIsForgotten) {
  PacketClock clock;
  for (std::int64_t i = 0; i < 5'000; ++i) {
    const std::int64_t arrival_ns = i == 3'000 ? 0 : kBegan_ns + i * kStep_ns;
    const std::int64_t stamp_ns = clock.moment_ns(arrival_ns, i * kStep_ns, 0) + clock.offset_ns();
    EXPECT_EQ(stamp_ns, arrival_ns) << i;
  }
}

// Bytes that are no time, as of a RoboSense, are as large as they can be.
TEST(PacketClock, ClocksOfAnySizeAreDoubted) {
  PacketClock clock;
  const std::int64_t most = std::numeric_limits<std::int64_t>::max() / 2;
  for (std::int64_t i = 0; i < 100; ++i) {
    const std::int64_t arrival_ns = kBegan_ns + i * kStep_ns;
    EXPECT_EQ(clock.moment_ns(arrival_ns, i % 3 * (most / 3), 0), arrival_ns) << i;
  }
}

// Later than any late packet that is believed: the others keep their moments.
TEST(PacketClock, APacketThatComesFarTooLateMovesNoOther) {
  PacketClock clock;
  for (std::int64_t i = 0; i < 3'000; ++i) {
    const bool is_late = i == 2'000;
    const std::int64_t clock_ns = (is_late ? i - 50 : i) * kStep_ns % kClockSecond_ns;
    const std::int64_t moment_ns = clock.moment_ns(kBegan_ns + i * kStep_ns, clock_ns, kClockSecond_ns);
    if (is_late) continue;
    EXPECT_EQ(moment_ns, kBegan_ns + i * kStep_ns) << i;
  }
}

// A bridge may send each packet again, some time later.
TEST(PacketClock, PacketsThatComeTwiceMoveNoOther) {
  PacketClock clock;
  for (std::int64_t i = 0; i < 3'000; ++i) {
    const std::int64_t arrival_ns = kBegan_ns + i * kStep_ns, clock_ns = i * kStep_ns;
    EXPECT_EQ(clock.moment_ns(arrival_ns, clock_ns, 0), arrival_ns) << i;
    clock.moment_ns(arrival_ns + 700'000, clock_ns, 0);
  }
}

// Held back for most of the second in which the clock begins anew, then handed on at once.
TEST(PacketClock, AStallOfMostOfASecondMovesNoMoment) {
  PacketClock clock;
  const std::int64_t first = 2'000, last = first + 850'000'000 / kStep_ns;
  for (std::int64_t i = 0; i < 4'000; ++i) {
    const std::int64_t sent = i >= first && i < last ? last : i;
    const std::int64_t moment_ns =
        clock.moment_ns(kBegan_ns + sent * kStep_ns, i * kStep_ns % kClockSecond_ns, kClockSecond_ns);
    EXPECT_EQ(moment_ns, kBegan_ns + i * kStep_ns) << i;
    EXPECT_EQ(clock.offset_ns(), 0) << i;
  }
}

// GPS or PTP set the sensor's clock on the way: no packet arrives before it is sent, so stamps do not go back.
TEST(PacketClock, ASensorWhoseClockIsSetAheadSendsNoStampBack) {
  for (const std::int64_t set_ns : {std::int64_t{60'000'000}, std::int64_t{300'000'000}, std::int64_t{399'000'000}}) {
    PacketClock clock;
    for (std::int64_t i = 0; i < 5'000; ++i) {
      const std::int64_t arrival_ns = kBegan_ns + i * kStep_ns;
      const std::int64_t clock_ns = (i * kStep_ns + (i >= 3'000 ? set_ns : 0)) % kClockSecond_ns;
      const std::int64_t moment_ns = clock.moment_ns(arrival_ns, clock_ns, kClockSecond_ns);
      EXPECT_EQ(moment_ns, arrival_ns) << set_ns << ", " << i;
      EXPECT_EQ(clock.offset_ns(), 0) << set_ns << ", " << i;
    }
  }
}

// What a VLP-16 of three turns tells of its times within a scan, in bursts of so many packets.
std::vector<std::uint32_t> times_in_bursts(std::size_t burst) {
  VelodyneAssembler assembler;
  const std::size_t packets = 240, of_turn = 75;  // 4.8 degrees each
  for (std::size_t i = 0; i < packets; ++i) {
    test::VelodynePacket packet;
    packet.step_deg = 0.4;
    packet.first_deg = 4.8 * static_cast<double>(i % of_turn);
    packet.clock_us = 3'599'990'000U + static_cast<std::uint32_t>(i) * 1327U;
    if (packet.clock_us >= 3'600'000'000U) packet.clock_us -= 3'600'000'000U;
    const std::size_t arrives = std::min(i / burst * burst + burst - 1, packets - 1);
    EXPECT_TRUE(test::add(assembler, payload_of(packet), kBegan_ns + static_cast<std::int64_t>(arrives) * kStep_ns));
  }
  assembler.finish();
  std::vector<std::uint32_t> times_ns;
  std::size_t whole = 0;
  while (const std::optional<Scan> scan = assembler.take()) {
    if (!scan->is_complete) continue;
    ++whole;
    for (const ScanPoint& point : scan->points) times_ns.push_back(point.t_ns);
  }
  EXPECT_EQ(whole, 3U);
  return times_ns;
}

TEST(PacketTimes, BurstsMoveNoPointWithinAScan) {
  const std::vector<std::uint32_t> steady_ns = times_in_bursts(1);
  ASSERT_EQ(steady_ns.size(), 3U * 1'800U * 16U);
  for (const std::size_t burst : {8U, 40U, 100U, 240U}) EXPECT_EQ(times_in_bursts(burst), steady_ns) << burst;
}

struct SentBlock {
  std::string payload;
  std::int64_t arrival_ns;
};

// Firings of a scan are as far apart as the head turned, at 600 turns a minute.
void expect_times_by_azimuth(ScanAssembler* assembler, const std::vector<SentBlock>& sent, const std::string& who) {
  for (const SentBlock& packet : sent) EXPECT_TRUE(test::add(*assembler, packet.payload, packet.arrival_ns)) << who;
  assembler->finish();
  const Scan scan = assembler->take().value();
  const std::size_t columns = scan.points.size() / scan.rings;
  // The ring that looks straight at the horizon most.
  std::size_t ring = 0;
  for (std::size_t i = 0; i < scan.rings; ++i) {
    if (std::abs(scan.points[i * columns].z_m) < std::abs(scan.points[ring * columns].z_m)) ring = i;
  }
  const auto azimuth_deg = [&](std::size_t column) {
    const ScanPoint& point = scan.points[ring * columns + column];
    const double deg = -std::atan2(point.y_m, point.x_m) * 180.0 / M_PI;
    return deg < 0.0 ? deg + 360.0 : deg;
  };
  for (std::size_t column = 1; column < columns; ++column) {
    const double turned_ms = (azimuth_deg(column) - azimuth_deg(0)) / 3.6;
    const double went_ms = 1e-6 * (scan.points[ring * columns + column].t_ns - scan.points[ring * columns].t_ns);
    // A block is 56 us and more. Azimuths are rounded to 2.8 us of turning, and 0.2 degrees of an RS-LiDAR-32
    // take 55.52 us by its maker and 55.56 at 600 turns a minute: 18 us of the hole.
    EXPECT_NEAR(went_ms, turned_ms, 0.025) << who << ", column " << column;
  }
}

// Of a view of 260 degrees, and how long the head turns through it at 600 turns a minute.
constexpr double kHole_deg = 100.0, kHole_us = kHole_deg / 3600.0 * 1e6;

// Of eight packets the fourth spans a hole: behind its middle all is 100 degrees and as many times later.
TEST(FieldOfViewTimes, ARoboSensesPacketAcrossTheHole) {
  for (const bool clock_runs : {true, false}) {
    const test::RoboSenseExample example = test::rs32_example();
    std::vector<std::string> data = robosense_data(example, 8, 20.0);
    RoboSenseAssembler assembler(std::nullopt);
    test::add(assembler, payload_of(example.device), kBegan_ns);
    std::vector<SentBlock> sent;
    for (std::size_t i = 0; i < data.size(); ++i) {
      const double late_us = i >= 3 ? kHole_us : 0.0;
      for (std::size_t block = 0; block < 12; ++block) {
        if (i < 3 || (i == 3 && block < 6)) continue;
        const double azimuth_deg = 20.0 + 0.2 * static_cast<double>(12 * i + block) + kHole_deg;
        test::put_at(&data[i], 42 + 100 * block + 2,
                     test::big_number(static_cast<std::uint64_t>(std::lround(100.0 * azimuth_deg)), 2));
      }
      // The clock is that of a packet's first block.
      const double clock_us = 1e6 + 666.24 * static_cast<double>(i) + (i > 3 ? kHole_us : 0.0);
      test::put_at(&data[i], 20, test::robosense_time(clock_runs ? std::llround(clock_us) : 1'000'000, true));
      sent.push_back({data[i], kBegan_ns + std::llround(1e3 * (666.24 * static_cast<double>(i + 1) + late_us))});
    }
    expect_times_by_azimuth(&assembler, sent, clock_runs ? "its clock" : "arrival");
  }
}

TEST(FieldOfViewTimes, AnLslidarsPacketAcrossTheHole) {
  for (const bool clock_runs : {true, false}) {
    std::vector<SentBlock> sent;
    for (std::size_t i = 0; i < 12; ++i) {
      test::LslidarPacket packet;
      packet.is_first_kind = false;
      packet.first_deg = 20.0 + 4.32 * static_cast<double>(i) + (i > 7 ? kHole_deg : 0.0);
      // The clock is that of a packet's end, as its arrival.
      const double end_us = 1200.0 * static_cast<double>(i + 1) + (i >= 7 ? kHole_us : 0.0);
      packet.clock = clock_runs ? static_cast<std::uint32_t>(end_us) : 0;
      std::string payload = payload_of(packet);
      for (std::size_t block = 6; i == 7 && block < 12; ++block) {
        const double azimuth_deg = packet.first_deg + 0.36 * static_cast<double>(block) + kHole_deg;
        payload.replace(100 * block + 2, 2, test::raw(static_cast<std::uint16_t>(std::lround(100.0 * azimuth_deg))));
      }
      sent.push_back({payload, kBegan_ns + std::llround(1e3 * end_us)});
    }
    LslidarAssembler assembler;
    expect_times_by_azimuth(&assembler, sent, clock_runs ? "its clock" : "arrival");
  }
}

void set_clock(std::string* payload, HesaiModel model, double clock_us) {
  const HesaiTraits& traits = hesai_traits(model);
  const auto us = static_cast<std::uint32_t>(std::llround(clock_us));
  payload->replace(traits.tail_at() + traits.micros_offset, 4, test::raw(us));
}

// Two firings a packet: the step across the hole is the only one. The clock is that of a packet's begin.
TEST(FieldOfViewTimes, AHesaisPacketOfTwoFiringsAcrossTheHole) {
  for (const bool clock_runs : {true, false}) {
    std::vector<SentBlock> sent;
    for (std::size_t i = 0; i < 20; ++i) {
      test::HesaiPacket packet = test::qt128_packet();
      packet.first_deg = 20.0 + 0.8 * static_cast<double>(i) + (i > 9 ? kHole_deg : 0.0);
      packet.step_deg = 0.4 + (i == 9 ? kHole_deg : 0.0);
      const double packet_us = 2.0 * 111.11, begin_us = packet_us * static_cast<double>(i) + (i > 9 ? kHole_us : 0.0);
      const double end_us = begin_us + packet_us + (i == 9 ? kHole_us : 0.0);
      std::string payload = payload_of(packet);
      if (clock_runs) set_clock(&payload, HesaiModel::kQt128, 1'000.0 + begin_us);
      sent.push_back({payload, kBegan_ns + std::llround(1e3 * end_us)});
    }
    HesaiAssembler assembler(std::nullopt, "");
    expect_times_by_azimuth(&assembler, sent, clock_runs ? "its clock" : "arrival");
    EXPECT_EQ(assembler.hint(), "") << "it does not turn the other way";
  }
}

// Its clock is that of a packet's end.
TEST(FieldOfViewTimes, AnXt32sPacketAcrossTheHole) {
  for (const bool clock_runs : {true, false}) {
    std::vector<SentBlock> sent;
    for (std::size_t i = 0; i < 20; ++i) {
      test::HesaiPacket packet;
      packet.step_deg = 0.18;
      packet.first_deg = 20.0 + 1.44 * static_cast<double>(i) + (i > 9 ? kHole_deg : 0.0);
      std::string payload = payload_of(packet);
      for (std::size_t block = 4; i == 9 && block < 8; ++block) {
        const double azimuth_deg = packet.first_deg + 0.18 * static_cast<double>(block) + kHole_deg;
        payload.replace(12 + 130 * block, 2, test::raw(static_cast<std::uint16_t>(std::lround(100.0 * azimuth_deg))));
      }
      const double end_us = 400.0 * static_cast<double>(i + 1) + (i >= 9 ? kHole_us : 0.0);
      if (clock_runs) set_clock(&payload, HesaiModel::kXt32, 1'000.0 + end_us);
      sent.push_back({payload, kBegan_ns + std::llround(1e3 * end_us)});
    }
    HesaiAssembler assembler(std::nullopt, "");
    expect_times_by_azimuth(&assembler, sent, clock_runs ? "its clock" : "arrival");
  }
}

// A packet of one firing tells no step; the packets do.
TEST(FieldOfViewTimes, PacketsOfOneFiringTellWhichWayTheHeadTurns) {
  HesaiAssembler assembler(std::nullopt, "");
  for (std::size_t i = 0; i < 40; ++i) {
    test::HesaiPacket packet = test::qt128_packet();
    packet.mode = 0x39;
    packet.first_deg = 200.0 - 0.4 * static_cast<double>(i);
    EXPECT_TRUE(test::add(assembler, payload_of(packet), kBegan_ns + 111'110 * static_cast<std::int64_t>(i)));
  }
  EXPECT_NE(assembler.hint(), "") << "counterclockwise";
}

// One that comes late turns no head back, and joins its turn.
TEST(FieldOfViewTimes, APacketOfOneFiringThatComesLateJoinsItsTurn) {
  HesaiAssembler assembler(std::nullopt, "");
  for (std::size_t i = 0; i < 40; ++i) {
    test::HesaiPacket packet = test::qt128_packet();
    packet.mode = 0x39;
    packet.first_deg = 100.0 + 0.4 * static_cast<double>(i == 20 ? 21 : i == 21 ? 20 : i);
    EXPECT_TRUE(test::add(assembler, payload_of(packet), kBegan_ns + 111'110 * static_cast<std::int64_t>(i)));
  }
  assembler.finish();
  EXPECT_EQ(assembler.hint(), "");
  EXPECT_EQ(assembler.take().value().points.size(), 40U * 128U);
}

}  // namespace
}  // namespace pose_wall::tools
