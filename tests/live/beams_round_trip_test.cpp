// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: for each real sensor whose packets are read, a simulated turn goes through packets and decoder and comes back
// point by point, with ring and time. Simulator and decoder share the table of beams, and each works out by itself
// where a laser's point lies: so a wrong sign, offset or time in one of them shows. A table that is wrong does not:
// what it says is compared with manuals by tests/tools and with real packets by tests/real.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "apps/live/sensor_sim/packet_encoder.hpp"
#include "io/packets/sensors.hpp"
#include "lab/sim/scenes.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::int64_t kRoundTrip_ns = 100'000'000;  // a turn at 10 Hz, for which the tables count columns

sim::SceneSetup round_trip_road(const std::string& sensor) {
  sim::SceneSetup setup = sim::make_setup("rough", sensor, false, 1);
  setup.sequence.scan_s = 1e-9 * static_cast<double>(kRoundTrip_ns);
  setup.machine.turned_left_deg = 7.0;
  setup.machine.lateral_m = 0.4;
  return setup;
}

// The first whole turn of what the sensor sends of the same frame three times.
Scan decoded(const sim::Sensor& sensor, const sim::Frame& frame) {
  const std::unique_ptr<PacketEncoder> encoder = make_encoder(sensor);
  const auto* const ouster = dynamic_cast<const OusterEncoder*>(encoder.get());
  SensorChoice choice;
  if (ouster != nullptr) choice.metadata = ouster->metadata();
  const std::unique_ptr<ScanAssembler> decoder = make_assembler(choice);
  const std::string device = encoder->device_packet(kRoundTrip_ns);
  const RangeImage image = range_image(sensor, frame);
  for (std::int64_t turn = 0; turn < 3; ++turn) {
    const std::vector<std::string> packets = encoder->packets(image, turn * kRoundTrip_ns, kRoundTrip_ns);
    for (std::size_t k = 0; k < packets.size(); ++k) {
      const auto share = static_cast<double>(k) / static_cast<double>(packets.size());
      const auto sent_ns = turn * kRoundTrip_ns + std::llround(share * static_cast<double>(kRoundTrip_ns));
      const ByteView bytes{reinterpret_cast<const std::byte*>(packets[k].data()), packets[k].size()};
      EXPECT_TRUE(decoder->add({sent_ns, {}, bytes})) << sensor.name;
      // Packets of data tell which sensor this is, so a device packet comes behind the first.
      if (turn > 0 || k > 0 || device.empty()) continue;
      const ByteView of_device{reinterpret_cast<const std::byte*>(device.data()), device.size()};
      EXPECT_TRUE(decoder->add({sent_ns, {}, of_device})) << sensor.name;
    }
  }
  std::optional<Scan> scan = decoder->take();
  EXPECT_TRUE(scan && scan->is_complete) << sensor.name;
  return scan.value_or(Scan{});
}

// How far a point may come back from where it was. Ranges come in whole steps before and after. Azimuths of blocks are
// written in hundredths of a degree, and between two blocks taken from both.
double allowed_m(const sim::Sensor& sensor, double range_m) {
  const bool is_ouster = sensor.beams->maker == SensorMaker::kOuster;
  const double step = 36000.0 / sensor.columns;
  const bool is_whole = is_ouster || std::abs(step - std::round(step)) < 1e-9;
  const double rounded_rad = is_whole ? 0.0 : 0.01 * M_PI / 180.0;
  return 1e-4 + (1e-6 + rounded_rad) * range_m;
}

class RoundTrip : public ::testing::TestWithParam<std::string> {};

TEST_P(RoundTrip, EachPointComesBackWithRingAndTime) {
  const sim::SceneSetup setup = round_trip_road(GetParam());
  const sim::Frame frame = sim::Simulator(setup, 1).render(0);
  const Scan scan = decoded(setup.sensor, frame);
  const auto columns = static_cast<std::size_t>(setup.sensor.columns);
  ASSERT_EQ(scan.points.size(), columns * setup.sensor.beams->lasers.size());
  const auto is_return = [](const ScanPoint& p) { return p.x_m != 0.0F || p.y_m != 0.0F || p.z_m != 0.0F; };
  EXPECT_EQ(static_cast<std::size_t>(std::count_if(scan.points.begin(), scan.points.end(), is_return)), frame.count());
  std::vector<std::size_t> row_of_ring(scan.rings);  // an Ouster's lie from the top
  for (std::size_t row = 0; row < scan.rings; ++row) row_of_ring.at(scan.points[row * columns].ring) = row;
  double most_of_allowed = 0.0, latest_us = 0.0;
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const ScanPoint& back = scan.points[row_of_ring[frame.ring[i]] * columns + frame.column[i]];
    const float* p = &frame.xyz_intensity[4 * i];
    const double off_m = std::hypot(back.x_m - p[0], back.y_m - p[1], back.z_m - p[2]);
    most_of_allowed = std::max(most_of_allowed, off_m / allowed_m(setup.sensor, std::hypot(p[0], p[1], p[2])));
    latest_us = std::max(latest_us, std::abs(1e-3 * (static_cast<double>(back.t_ns) - frame.time_ns[i])));
  }
  EXPECT_LE(most_of_allowed, 1.0);
  // Heads turn a little faster or slower than a turn in 0.1 s of whole packets, and a packet has one time.
  EXPECT_LE(latest_us, 10.0);
}

std::vector<std::string> sensors_that_come_back() {
  std::vector<std::string> names = sensors_with_packets();
  names.erase(std::remove_if(names.begin(), names.end(),
                             [](const std::string& name) { return sim::find_sensor(name)->sensor.beams == nullptr; }),
              names.end());
  return names;
}

std::string round_trip_test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Sensors, RoundTrip, ::testing::ValuesIn(sensors_that_come_back()), round_trip_test_name);

// A sensor's lens, unit or sign that is wrong moves a wall; the engine sees it as far as its level allows.
class MeasuredRoad : public ::testing::TestWithParam<std::string> {};

TEST_P(MeasuredRoad, ValuesOfPacketsAreThoseOfTheSimulatorAndTrue) {
  const sim::SceneSetup setup = round_trip_road(GetParam());
  const sim::Simulator simulator(setup, 1);
  pose_wall::test::EngineUnderTest of_frames(pose_wall::test::config_for(setup)),
      of_packets(pose_wall::test::config_for(setup));
  std::size_t valid = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const sim::Frame frame = simulator.render(i);
    tools::Frame back = frame_of(decoded(setup.sensor, frame));
    back.cloud.stamp_ns = frame.stamp_ns;
    const pose_wall_result direct = of_frames.process(pose_wall::test::cloud_of(frame));
    const pose_wall::test::JudgedFrame judged{of_packets.process(back.cloud), simulator.truth(i),
                                              simulator.surveyed_truth(i)};
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      if (!judged.is(q, POSE_WALL_VALID)) continue;
      ++valid;
      EXPECT_LE(std::fabs(judged.error(q)), judged.result.quantity[q].protection_level) << pose_wall_quantity_name(q);
      EXPECT_NEAR(judged.result.quantity[q].value, direct.quantity[q].value, 0.002) << pose_wall_quantity_name(q);
    }
  }
  EXPECT_GE(valid, 3U * 7U) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(RoboSense, MeasuredRoad,
                         ::testing::Values("robosense-rs16", "robosense-rs32", "robosense-helios32"),
                         round_trip_test_name);

INSTANTIATE_TEST_SUITE_P(Hesai, MeasuredRoad, ::testing::Values("hesai-xt32m", "hesai-pandar64"), round_trip_test_name);

// The comparison sees offsets: a sensor without any, read as one that has them.
TEST(RoundTrip, ASensorWithoutOffsetsIsSeenToHaveNone) {
  const sim::SceneSetup setup = round_trip_road("vlp16");
  const sim::Frame frame = sim::Simulator(setup, 1).render(0);
  const Scan scan = decoded(setup.sensor, frame);
  const std::size_t lowest = 0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < frame.count(); ++i) {
    if (frame.ring[i] != lowest) continue;
    const ScanPoint& back = scan.points[frame.column[i]];
    EXPECT_NEAR(back.z_m - frame.xyz_intensity[4 * i + 2], 0.0112, 0.001) << "half a step of 2 mm of a slant range";
    ++seen;
  }
  EXPECT_GT(seen, 1000U);
}

// A sensor whose lens stands 4 cm beside its axis, told by its device packet or by its design: what is measured of a
// road is the road's.
TEST(RoundTrip, TheSevenValuesOfARoadComeBackFromAnLslidarsPackets) {
  for (const char* name : {"lslidar-c16-v3", "lslidar-c16-v4"}) {
    sim::SceneSetup setup = sim::make_setup("clean", name, false, 1);
    setup.machine.turned_left_deg = 3.0;
    setup.machine.lateral_m = 0.3;
    const sim::Simulator simulator(setup, 1);
    const Scan scan = decoded(setup.sensor, simulator.render(0));
    pose_wall_config config = test::config_with();
    for (const EngineSetting& setting : sim::find_sensor(name)->engine) {
      test::set(&config, setting.key.c_str(), setting.value.c_str());
    }
    test::EngineUnderTest engine(test::config_for(setup, config));
    const Frame frame = frame_of(scan);
    const test::JudgedFrame judged = {engine.process(frame.cloud), simulator.truth(0), simulator.surveyed_truth(0)};
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      EXPECT_TRUE(judged.is(q, POSE_WALL_VALID)) << name << ' ' << pose_wall_quantity_name(q);
      EXPECT_LE(std::abs(judged.error(q)), judged.result.quantity[q].protection_level)
          << name << ' ' << pose_wall_quantity_name(q);
      // Left out, the lens would make 35 to 40 mm of a distance.
      const double allowed = q >= POSE_WALL_D_LF ? 0.005 : 0.001;
      EXPECT_LE(std::abs(judged.error(q)), allowed) << name << ' ' << pose_wall_quantity_name(q);
    }
  }
}

TEST(RoundTrip, ASensorWithoutKnownPacketsIsRefused) {
  for (const char* name : {"mid360"}) {
    EXPECT_THROW(make_encoder(sim::find_sensor(name)->sensor), std::invalid_argument) << name;
  }
}

}  // namespace
}  // namespace pose_wall::tools::live
