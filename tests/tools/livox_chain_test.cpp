// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a simulated road in packets of a Livox, of every data type, comes back point by point with its times, and
// gives the seven values within their levels. Ports tell a HAP; a name that they contradict is refused, and data that
// is not read is named with its type. Does not prove: that a real HAP, Mid-360S or Avia 2 sends so.

#include <gtest/gtest.h>

#if POSE_WALL_HAS_PCAP

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "io/packets/livox.hpp"
#include "io/packets/sensors.hpp"
#include "lab/sim/scenes.hpp"
#include "livox_packets.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// Nearly as many beams as a HAP has in 0.1 s.
sim::SceneSetup road() {
  sim::SceneSetup setup = sim::make_setup("clean", "mid360", false, 1);
  setup.sensor.pattern_points = 44'000.0;
  setup.machine.turned_left_deg = 5.0;
  setup.machine.lateral_m = 0.3;
  return setup;
}

Scan scan_of(const std::vector<std::string>& packets) {
  LivoxAssembler assembler(LivoxModel::kHap);
  for (const std::string& packet : packets) EXPECT_TRUE(add(assembler, packet));
  assembler.finish();
  return assembler.take().value();
}

// What rounding takes from a point: half a unit of each coordinate, or of range and two angles of 0.01 degrees.
double rounding_m(std::uint8_t type, double range_m) {
  if (type == test::kLivoxCm) return 0.0087;
  return type == test::kLivoxSpherical ? 0.0006 + 1.3e-4 * range_m : 0.0009;
}

TEST(LivoxChain, EveryPointComesBackWithItsTime) {
  const sim::Frame frame = sim::Simulator(road(), 1).render(0);
  ASSERT_GT(frame.count(), 10'000U);
  for (const std::uint8_t type : {test::kLivoxMm, test::kLivoxCm, test::kLivoxSpherical, test::kLivoxDual}) {
    LivoxStream stream;
    stream.type = type;
    if (type == test::kLivoxDual) stream.points = 48;
    const Scan scan = scan_of(livox_packets(frame, stream));
    ASSERT_EQ(scan.points.size() % stream.points, 0U);
    std::size_t i = 0, none = 0;
    for (std::size_t k = 0; k < scan.points.size(); ++k) {
      const ScanPoint& point = scan.points[k];
      EXPECT_NEAR(point.t_ns, 1e9 * static_cast<double>(k) / stream.rate_hz, 1'000.0) << k;
      ASSERT_EQ(point.ring, k % stream.points % 6);
      if (k % 100 == 99 || i == frame.count()) {
        none += point.x_m == 0.0F && point.y_m == 0.0F && point.z_m == 0.0F ? 1 : 0;
        continue;
      }
      const float* const p = &frame.xyz_intensity[4 * i++];
      const double off_m = std::hypot(point.x_m - p[0], point.y_m - p[1], point.z_m - p[2]);
      ASSERT_LE(off_m, rounding_m(type, std::hypot(p[0], p[1], p[2]))) << "type " << int{type} << ", point " << k;
    }
    EXPECT_EQ(i, frame.count());
    EXPECT_EQ(none, scan.points.size() - frame.count()) << "what has no return is 0 0 0";
  }
}

TEST(LivoxChain, TheSevenValuesAreWithinTheirLevels) {
  const sim::SceneSetup setup = road();
  const sim::Simulator simulator(setup, 1);
  const sim::Frame frame = simulator.render(0);
  pose_wall_config config = pose_wall::test::config_with();
  for (const EngineSetting& setting : sim::find_sensor("mid360")->engine) {
    pose_wall::test::set(&config, setting.key.c_str(), setting.value.c_str());
  }
  for (const std::uint8_t type : {test::kLivoxMm, test::kLivoxDual}) {
    LivoxStream stream;
    stream.type = type;
    const Frame decoded = frame_of(scan_of(livox_packets(frame, stream)));
    pose_wall::test::EngineUnderTest engine(pose_wall::test::config_for(setup, config));
    const pose_wall::test::JudgedFrame judged{engine.process(decoded.cloud), simulator.truth(0),
                                              simulator.surveyed_truth(0)};
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      EXPECT_TRUE(judged.is(q, POSE_WALL_VALID)) << pose_wall_quantity_name(q);
      EXPECT_LE(std::fabs(judged.error(q)), judged.result.quantity[q].protection_level) << pose_wall_quantity_name(q);
    }
  }
}

// Three tenths of a second; the last frame is not complete.
std::vector<std::string> some_frames(std::uint8_t type) {
  std::vector<std::string> packets;
  for (std::uint64_t i = 0; i < 30; ++i) {
    const float p_m[3] = {1.0F, 2.0F, 3.0F};
    packets.push_back(test::mid360_payload(type, 10'000'000 * i, std::vector(6, test::livox_point(type, p_m, i))));
  }
  return packets;
}

TEST(LivoxChain, PortsTellWhichModelsItMayBe) {
  const TempFolder folder;
  const struct {
    std::uint16_t from, to;
    const char* told;
  } senders[] = {{57000, 57000, "Livox HAP"},
                 {57000, 4000, "Livox HAP"},
                 {4000, 57000, "Livox HAP"},
                 {56300, 56301, "Livox Mid-360, Mid-360S or Avia 2"},
                 {56300, 57000, "Livox Mid-360, Mid-360S or Avia 2"},
                 {4000, 4001, "Livox Mid-360, Mid-360S, HAP or Avia 2"}};
  for (const auto& [from, to, told] : senders) {
    const ReadCapture capture = read(folder.write("c.pcap", livox_capture(some_frames(test::kLivoxMm), from, to)));
    ASSERT_EQ(capture.frames.size(), 2U) << refusal_of(capture);
    EXPECT_EQ(capture.about.kind, std::string("packets of a ") + told);
    ASSERT_EQ(capture.about.senders.size(), 1U);
    bool is_named = false;
    for (const auto& fact : capture.about.senders.front().facts) is_named = is_named || fact.found == told;
    EXPECT_TRUE(is_named) << told;
  }
}

TEST(LivoxChain, LinesAreThoseOfTheModelWhereItIsKnown) {
  const auto lines = [](SensorKind kind, const Sender& from) {
    SensorChoice choice;
    choice.kind = kind;
    const std::unique_ptr<ScanAssembler> assembler = make_assembler(choice);
    const std::string packet = some_frames(test::kLivoxMm).front();
    EXPECT_TRUE(assembler->add({0, from, view_of(packet)}));
    assembler->finish();
    const Scan scan = assembler->take().value();
    std::uint32_t most = 0;
    for (const ScanPoint& point : scan.points) most = std::max<std::uint32_t>(most, point.ring);
    EXPECT_EQ(frame_of(scan).fields.back().name == "ring", most > 0) << "one line is no planar scanner";
    return most + 1;
  };
  const Sender hap{1, 57000, 57000, 0, ""}, other{1, 56300, 56301, 0, ""};
  EXPECT_EQ(lines(SensorKind::kMid360, other), 4U);
  EXPECT_EQ(lines(SensorKind::kMid360s, {}), 4U);
  EXPECT_EQ(lines(SensorKind::kLivoxHap, hap), 6U);
  EXPECT_EQ(lines(SensorKind::kAvia2, other), 1U);
  EXPECT_EQ(lines(SensorKind::kAutomatic, hap), 6U);
  EXPECT_EQ(lines(SensorKind::kAutomatic, other), 1U) << "a Mid-360 or an Avia 2";
}

TEST(LivoxChain, ANameThatThePortContradictsIsRefused) {
  const TempFolder folder;
  const std::string hap = folder.write("h.pcap", livox_capture(some_frames(test::kLivoxMm), 57000, 57000));
  const std::string other = folder.write("o.pcap", livox_capture(some_frames(test::kLivoxDual), 56300, 56301));
  const std::string refused = refusal_of(read(hap, {"avia2", ""}));
  EXPECT_TRUE(contains(refused, "packets of a Livox Avia 2 are wanted, but these leave from port 57000")) << refused;
  EXPECT_TRUE(contains(refusal_of(read(other, {"hap", ""})), "as those of a Livox Mid-360, Mid-360S or Avia 2"));
  for (const char* name : {"mid360", "mid360s", "avia2"})
    EXPECT_EQ(refusal_of(read(other, {name, ""})), "read") << name;
  EXPECT_EQ(refusal_of(read(hap, {"hap", ""})), "read");
}

TEST(LivoxChain, DataThatIsNotReadIsNamed) {
  const TempFolder folder;
  const auto refused = [&](std::uint8_t type, std::size_t bytes) {
    const std::string packet = test::mid360_payload(type, 1, std::vector(4, std::string(bytes, '\1')));
    return refusal_of(read(folder.write("c.pcap", livox_capture({packet}, 56300, 56301))));
  };
  EXPECT_TRUE(contains(refused(0x12, 42), "a Livox, data type 0x12 (0x01, 0x02, 0x03 and 0x11 are read)"));
  EXPECT_TRUE(contains(refused(0x11, 14), "a Livox, data type 0x11 of 14 bytes a point instead of 28"))
      << "should its number of points count returns";
  EXPECT_FALSE(contains(refused(0x00, 24), "a Livox, data type")) << "of the IMU";
  std::string cut = test::mid360_payload(0x12, 1, {std::string(14, '\1'), std::string(14, '\1')});
  cut.resize(cut.size() - 2);
  EXPECT_EQ(unread_livox(view_of(cut)), "") << "its length is another";
}

TEST(LivoxChain, OfTwoReturnsTheFartherOneIsTakenWithItsReflectivity) {
  const std::string near_point = raw(1000) + raw(0) + raw(0) + "\x07\x01",
                    far_point = raw(0) + raw(-2000) + raw(0) + "\x09\x01",
                    no_point = raw(0) + raw(0) + raw(0) + std::string("\0\0", 2);
  const std::string farthest = raw(INT32_MIN) + raw(INT32_MIN) + raw(INT32_MIN) + "\x0B\x01";
  const Scan scan =
      scan_of({test::mid360_payload(test::kLivoxDual, 1,
                                    {near_point + far_point, far_point + near_point, near_point + no_point,
                                     no_point + far_point, no_point + no_point, farthest + near_point})});
  ASSERT_EQ(scan.points.size(), 6U);
  for (const std::size_t i : {0U, 1U, 3U}) {
    test::expect_at(scan.points[i], 0.0, -2.0, 0.0);
    EXPECT_EQ(scan.points[i].intensity, 9.0F);
  }
  test::expect_at(scan.points[2], 1.0, 0.0, 0.0);
  EXPECT_EQ(scan.points[2].intensity, 7.0F);
  test::expect_at(scan.points[4], 0.0, 0.0, 0.0);
  EXPECT_EQ(scan.points[5].intensity, 11.0F);
}

}  // namespace
}  // namespace pose_wall::tools

#endif
