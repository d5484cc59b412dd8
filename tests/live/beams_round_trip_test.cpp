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
#include <random>
#include <string>
#include <vector>

#include "apps/live/sensor_sim/packet_encoder.hpp"
#include "io/packets/sensors.hpp"
#include "lab/sim/scenes.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::tools::live {
namespace {

// A turn at 10 Hz, for which the tables count columns: of whole packets, so it may lack a hundredth.
std::int64_t turn_ns_of(const sim::Sensor& sensor) {
  constexpr std::int64_t kTurn_ns = 100'000'000;  // at 10 Hz
  return sensor.beams == nullptr ? kTurn_ns : std::llround(sensor.columns * sensor.beams->cycle_ns);
}

sim::SceneSetup round_trip_road(const std::string& sensor) {
  sim::SceneSetup setup = sim::make_setup("rough", sensor, false, 1);
  setup.sequence.scan_s = 1e-9 * static_cast<double>(turn_ns_of(setup.sensor));
  setup.sequence.rate_hz = std::min(10.0, 1.0 / setup.sequence.scan_s);
  setup.machine.turned_left_deg = 7.0;
  setup.machine.lateral_m = 0.4;
  return setup;
}

// The first whole turn of what the sensor sends of the same frame three times, in bursts of so many packets.
Scan decoded(const sim::Sensor& sensor, const sim::Frame& frame, std::size_t burst = 1) {
  const std::unique_ptr<PacketEncoder> encoder = make_encoder(sensor);
  const auto* const ouster = dynamic_cast<const OusterEncoder*>(encoder.get());
  SensorChoice choice;
  if (ouster != nullptr) choice.metadata = ouster->metadata();
  const std::unique_ptr<ScanAssembler> decoder = make_assembler(choice);
  const std::int64_t turn_ns = turn_ns_of(sensor);
  const std::string device = encoder->device_packet(turn_ns);
  const RangeImage image = range_image(sensor, frame);
  for (std::int64_t turn = 0; turn < 3; ++turn) {
    const std::vector<std::string> packets = encoder->packets(image, turn * turn_ns, turn_ns);
    for (std::size_t k = 0; k < packets.size(); ++k) {
      const std::size_t arrives_with = std::min(k / burst * burst + burst, packets.size()) - 1;
      const auto share = static_cast<double>(arrives_with) / static_cast<double>(packets.size());
      const auto sent_ns = turn * turn_ns + std::llround(share * static_cast<double>(turn_ns));
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
  // Clocks count microseconds, and some times of lasers are those of the middle of two orders.
  EXPECT_LE(latest_us, 10.0);
}

// Where the sensor's clock runs, bursts change nothing: it counts microseconds.
TEST_P(RoundTrip, BurstsOfPacketsMoveNoTimeWithinAScan) {
  const sim::SceneSetup setup = round_trip_road(GetParam());
  const sim::Frame frame = sim::Simulator(setup, 1).render(0);
  const Scan steady = decoded(setup.sensor, frame), bursts = decoded(setup.sensor, frame, 16);
  ASSERT_EQ(steady.points.size(), bursts.points.size());
  double most_us = 0.0;
  for (std::size_t i = 0; i < steady.points.size(); ++i) {
    most_us = std::max(most_us, 1e-3 * std::abs(static_cast<double>(steady.points[i].t_ns) - bursts.points[i].t_ns));
  }
  EXPECT_LE(most_us, 1.0);
}

constexpr double kSphere_m = 10.0;  // which all of them count without a rest

// Datagrams around a sensor in the middle of a sphere: a device packet, where there is one, and some of a turn.
std::vector<std::string> sent_in_a_sphere(const sim::Sensor& sensor, double radius_m, float intensity) {
  const std::unique_ptr<PacketEncoder> encoder = make_encoder(sensor);
  RangeImage image;
  image.rings = static_cast<std::uint32_t>(sensor.rings);
  image.columns = static_cast<std::uint32_t>(sensor.columns);
  image.range_m.assign(std::size_t{image.rings} * image.columns, radius_m);
  image.intensity.assign(image.range_m.size(), intensity);
  const std::int64_t turn_ns = turn_ns_of(sensor);
  std::vector<std::string> sent = encoder->packets(image, turn_ns, turn_ns);
  constexpr std::size_t kEnough = 12;  // to know clock, model and steps
  sent.resize(std::min(sent.size(), kEnough));
  sent.insert(sent.begin() + 1, encoder->device_packet(turn_ns));
  return sent;
}

// How far a point lies off the sphere at most; nothing where the packets are refused or give no scan.
std::optional<double> off_the_sphere_m(const sim::Sensor& sensor, const std::vector<std::string>& sent) {
  const auto encoder = make_encoder(sensor);
  const auto* const ouster = dynamic_cast<const OusterEncoder*>(encoder.get());
  SensorChoice choice;
  if (ouster != nullptr) choice.metadata = ouster->metadata();
  std::optional<double> off_m;
  try {
    const std::unique_ptr<ScanAssembler> decoder = make_assembler(choice);
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const ByteView bytes{reinterpret_cast<const std::byte*>(sent[i].data()), sent[i].size()};
      decoder->add({static_cast<std::int64_t>(i) * 1'000'000, {}, bytes});
    }
    decoder->finish();
    while (const std::optional<Scan> scan = decoder->take()) {
      for (const ScanPoint& point : scan->points) {
        if (point.x_m == 0.0F && point.y_m == 0.0F && point.z_m == 0.0F) continue;
        off_m = std::max(off_m.value_or(0.0), std::abs(std::hypot(point.x_m, point.y_m, point.z_m) - kSphere_m));
      }
    }
  } catch (const FrameError&) {
    return std::nullopt;
  }
  return off_m;
}

// The unit of a C32 of firmware 3 stands in this byte of its device packet and nowhere else.
bool tells_unit_alone(const sim::Sensor& sensor, bool is_device, std::size_t offset) {
  return is_device && offset == 1203 && sensor.name.rfind("lslidar-c32-v3", 0) == 0;
}

// Whatever a byte that is no return is changed to, in all packets alike: they are refused, or distances stay.
TEST_P(RoundTrip, NoChangedByteMakesAnotherUnit) {
  const sim::Sensor& sensor = sim::find_sensor(GetParam())->sensor;
  const std::vector<std::string> good = sent_in_a_sphere(sensor, kSphere_m, 7.0F),
                                 other = sent_in_a_sphere(sensor, 7.0 * kSphere_m, 99.0F);
  // A byte that names another model may bring the lens of that one: the highest is a Bpearl 4's. A unit would be
  // metres.
  const double allowed_m = robosense_bpearl4().reach_m() + 0.01;
  ASSERT_LE(off_the_sphere_m(sensor, good).value(), allowed_m);
  std::minstd_rand random(7);
  std::size_t accepted = 0;
  for (const bool is_device : {false, true}) {
    const std::string& first = good[is_device ? 1 : 0];
    std::vector<std::size_t> offsets;
    for (std::size_t offset = 0; offset < first.size(); ++offset) {
      const bool is_of_return = !is_device && first[offset] != other[0][offset];
      if (!is_of_return && !tells_unit_alone(sensor, is_device, offset)) offsets.push_back(offset);
    }
    // All of a head and a tail; of long packets that leave much empty some.
    constexpr std::size_t kTriesAbout = 1'500;
    for (std::size_t tried = 0; tried < kTriesAbout && !offsets.empty(); ++tried) {
      const std::size_t offset =
          offsets[tried < offsets.size() && offsets.size() < kTriesAbout ? tried : random() % offsets.size()];
      const auto byte = static_cast<char>(random() >> 8U);
      std::vector<std::string> changed = good;
      for (std::size_t i = 0; i < changed.size(); ++i) {
        if ((i == 1) == is_device) changed[i][offset] = byte;
      }
      const std::optional<double> off_m = off_the_sphere_m(sensor, changed);
      if (off_m) ++accepted;
      ASSERT_LE(off_m.value_or(0.0), allowed_m) << (is_device ? "device packet, " : "") << "byte " << offset << ": "
                                                << static_cast<int>(static_cast<unsigned char>(byte));
    }
  }
  EXPECT_GT(accepted, 20U);
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

pose_wall_config engine_of(const sim::SceneSetup& setup) {
  pose_wall_config config = pose_wall::test::config_with();
  for (const EngineSetting& setting : sim::find_sensor(setup.sensor.name)->engine) {
    pose_wall::test::set(&config, setting.key.c_str(), setting.value.c_str());
  }
  pose_wall::test::set(&config, "floor_region_min", setup.sensor.floor_from_m);
  pose_wall::test::set(&config, "floor_region_max", setup.sensor.floor_to_m);
  return pose_wall::test::config_for(setup, config);
}

// What has to come of four frames of seven values. A hemisphere that hangs sees floor and feet of walls, and eight
// lasers show little of either; those of a C8F do not meet the floor nearby.
struct Least {
  std::size_t valid, measured;
};

Least least_of(const sim::Sensor& sensor) {
  if (sensor.name == "lslidar-c8f") return {0, 0};
  const bool sees_the_road = sensor.beams->lasers.size() >= 16 && sensor.beams->lowest_deg() < 0.0;
  return sees_the_road ? Least{21, 28} : Least{4, 8};
}

// A sensor's lens, unit or sign that is wrong moves a wall; the engine sees it as far as its level allows.
class MeasuredRoad : public ::testing::TestWithParam<std::string> {};

TEST_P(MeasuredRoad, ValuesOfPacketsAreThoseOfTheSimulatorAndTrue) {
  const sim::SceneSetup setup = round_trip_road(GetParam());
  const sim::Simulator simulator(setup, 1);
  pose_wall::test::EngineUnderTest of_frames(engine_of(setup)), of_packets(engine_of(setup));
  std::size_t valid = 0, measured = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const sim::Frame frame = simulator.render(i);
    tools::Frame back = frame_of(decoded(setup.sensor, frame));
    back.cloud.stamp_ns = frame.stamp_ns;
    const pose_wall_result direct = of_frames.process(pose_wall::test::cloud_of(frame));
    const pose_wall::test::JudgedFrame judged{of_packets.process(back.cloud), simulator.truth(i),
                                              simulator.surveyed_truth(i)};
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const pose_wall_value& value = judged.result.quantity[q];
      if (judged.is(q, POSE_WALL_INVALID) || direct.quantity[q].state == POSE_WALL_INVALID) continue;
      ++measured;
      EXPECT_NEAR(value.value, direct.quantity[q].value, std::max(0.002, 0.1 * value.protection_level))
          << pose_wall_quantity_name(q);
      EXPECT_LE(std::fabs(judged.error(q)), value.protection_level) << pose_wall_quantity_name(q);
      if (judged.is(q, POSE_WALL_VALID)) ++valid;
    }
  }
  RecordProperty("valid", static_cast<int>(valid));
  RecordProperty("measured", static_cast<int>(measured));
  const Least least = least_of(setup.sensor);
  EXPECT_GE(valid, least.valid);
  EXPECT_GE(measured, least.measured);
}

// Of a smooth road that hides nothing: what is measured is the road's, far within the levels. A lens that is left out
// would make 15 to 50 mm of a distance.
TEST_P(MeasuredRoad, ValuesOfASmoothRoadAreTheRoads) {
  sim::SceneSetup setup = sim::make_setup("clean", GetParam(), false, 1);
  setup.machine.turned_left_deg = 3.0;
  setup.machine.lateral_m = 0.3;
  const sim::Simulator simulator(setup, 1);
  pose_wall::test::EngineUnderTest engine(engine_of(setup));
  const tools::Frame frame = frame_of(decoded(setup.sensor, simulator.render(0)));
  const pose_wall::test::JudgedFrame judged{engine.process(frame.cloud), simulator.truth(0),
                                            simulator.surveyed_truth(0)};
  std::size_t measured = 0;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    EXPECT_TRUE(judged.is(q, POSE_WALL_VALID) || least_of(setup.sensor).measured < 28) << pose_wall_quantity_name(q);
    if (judged.is(q, POSE_WALL_INVALID)) continue;
    ++measured;
    EXPECT_LE(std::abs(judged.error(q)), judged.result.quantity[q].protection_level) << pose_wall_quantity_name(q);
    EXPECT_LE(std::abs(judged.error(q)), q >= POSE_WALL_D_LF ? 0.005 : 0.001) << pose_wall_quantity_name(q);
  }
  EXPECT_GE(measured, least_of(setup.sensor).measured / 4);
}

INSTANTIATE_TEST_SUITE_P(Sensors, MeasuredRoad, ::testing::ValuesIn(sensors_that_come_back()), round_trip_test_name);

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

TEST(RoundTrip, ASensorWithoutKnownPacketsIsRefused) {
  for (const char* name : {"mid360"}) {
    EXPECT_THROW(make_encoder(sim::find_sensor(name)->sensor), std::invalid_argument) << name;
  }
}

}  // namespace
}  // namespace pose_wall::tools::live
