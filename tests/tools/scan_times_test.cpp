// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: `info` and `doctor` say nothing of sound times, whether the machine stands, drives or turns, of sparse scans
// and of sensors that do not turn; and name times that do not fit, each kind by its name. Does not prove: a pure turn
// that was taken out is noticed (it is not), nor a motion below 0.1 m/s.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "io/frames/pcd_writer.hpp"
#include "io/language/language.hpp"
#include "lab/sim/parameters.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/simulator.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;
using Words = std::vector<std::string>;
using Change = std::function<void(sim::Frame&)>;

constexpr std::uint32_t kScan_ns = 100'000'000;

void as_it_is(sim::Frame&) {}

sim::Setup timed_road(const std::string& sensor, const Words& settings) {
  sim::Setup setup = sim::make_setup("nominal", sensor, false, 7);
  sim::set_parameter(setup, "scan_s=0.1");
  for (const std::string& setting : settings) sim::set_parameter(setup, setting);
  return setup;
}

// Two frames in a folder: a step of the stamps.
void write_frames(const TempFolder& folder, const sim::Setup& setup, const Change& change) {
  const sim::Simulator simulator(setup, 7);
  for (std::uint32_t k = 0; k < 2; ++k) {
    sim::Frame frame = simulator.render(k);
    change(frame);
    write_timed_pcd_binary(folder.file(std::to_string(k) + ".pcd"), frame.xyz_intensity.data(), frame.time_ns.data(),
                           frame.ring.data(), frame.count(), frame.stamp_ns);
  }
}

std::string fault_of(const std::string& sensor, const Words& settings, const Change& change) {
  const TempFolder folder;
  write_frames(folder, timed_road(sensor, settings), change);
  const std::string page = command({"info", "-q", "--json", folder.path()}).printed;
  return nlohmann::json::parse(page).at(0).at("times").at("fault").get<std::string>();
}

TEST(ScanTimes, SoundOnesAreNotDoubted) {
  const struct {
    const char* sensor;
    Words settings;
  } roads[] = {
      {"os1-64", {}},
      {"vlp16", {}},
      {"os0-128", {"speed_mps=1.0"}},
      {"vlp16", {"speed_mps=0.5", "turn_rate_dps=8"}},
      {"os1-64", {"speed_mps=-0.5", "sway_roll_deg=3", "sway_period_s=2"}},
      {"vlp16", {"dropout=0.6", "speed_mps=0.5"}},
      {"os1-64", {"blocked_from_deg=-60", "blocked_to_deg=80", "dust=0.3", "dust_range_m=4"}},
      {"vlp16", {"rate_hz=5", "scan_s=0.2"}},
      {"mid360", {"speed_mps=0.5"}},
  };
  for (const auto& [sensor, settings] : roads) EXPECT_EQ(fault_of(sensor, settings, as_it_is), "") << sensor;
}

// To a frame of the machine: turned about X, then shifted.
Change carried(double lean_deg, double x_m, double z_m) {
  return [=](sim::Frame& frame) {
    const double angle = lean_deg * M_PI / 180.0;
    for (std::size_t i = 0; i < frame.count(); ++i) {
      float* const p = &frame.xyz_intensity[4 * i];
      const double y = static_cast<double>(p[1]), z = static_cast<double>(p[2]);
      p[0] = static_cast<float>(static_cast<double>(p[0]) + x_m);
      p[1] = static_cast<float>(std::cos(angle) * y - std::sin(angle) * z);
      p[2] = static_cast<float>(std::sin(angle) * y + std::cos(angle) * z + z_m);
    }
  };
}

TEST(ScanTimes, SoundOnesAreNotDoubtedInAnotherFrame) {
  for (const char* sensor : {"vlp16", "os0-128"}) {
    for (const Change& change : {carried(25.0, 0.0, 0.0), carried(90.0, 0.0, 0.0), carried(0.0, 0.2, 0.0),
                                 carried(0.0, 0.5, 0.0), carried(10.0, 2.0, 1.0)}) {
      EXPECT_EQ(fault_of(sensor, {"speed_mps=0.5"}, change), "") << sensor;
    }
  }
}

TEST(ScanTimes, ASensorThatDoesNotTurnIsNotJudgedByItsTurn) {
  const auto by_count = [](sim::Frame& frame) {
    for (std::size_t i = 0; i < frame.count(); ++i) {
      frame.time_ns[i] =
          static_cast<std::uint32_t>(static_cast<double>(kScan_ns) * 0.37 * static_cast<double>(i % 977) / 977);
    }
  };
  EXPECT_EQ(fault_of("mid360", {}, by_count), "");
}

// Times by the order in which `less` puts the returns, evenly.
template <typename Less>
void order_by(sim::Frame& frame, const Less& less) {
  std::vector<std::size_t> order(frame.count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), less);
  std::vector<std::uint32_t> times(frame.count());
  for (std::size_t k = 0; k < order.size(); ++k) {
    times[order[k]] = static_cast<std::uint32_t>(static_cast<double>(kScan_ns) * static_cast<double>(k) /
                                                 static_cast<double>(order.size()));
  }
  frame.time_ns = times;
}

void by_row(sim::Frame& frame) {
  const auto before = frame.time_ns;
  order_by(frame, [&](std::size_t a, std::size_t b) {
    return frame.ring[a] != frame.ring[b] ? frame.ring[a] < frame.ring[b] : before[a] < before[b];
  });
}

void by_range(sim::Frame& frame) {
  const auto range = [&frame](std::size_t i) {
    const float* const p = &frame.xyz_intensity[4 * i];
    return p[0] * p[0] + p[1] * p[1];
  };
  order_by(frame, [&](std::size_t a, std::size_t b) { return range(a) < range(b); });
}

Change scaled(double factor) {
  return [factor](sim::Frame& frame) {
    for (std::uint32_t& time : frame.time_ns) time = static_cast<std::uint32_t>(factor * time);
  };
}

void backward(sim::Frame& frame) {
  const std::uint32_t last = *std::max_element(frame.time_ns.begin(), frame.time_ns.end());
  for (std::uint32_t& time : frame.time_ns) time = last - time;
}

// One half of the scan at twice the pace of the other.
void uneven(sim::Frame& frame) {
  for (std::uint32_t& time : frame.time_ns) {
    const double share = time / static_cast<double>(kScan_ns);
    time = static_cast<std::uint32_t>(kScan_ns * (share < 0.5 ? share * 4 / 3 : 2.0 / 3 + (share - 0.5) * 2 / 3));
  }
}

// What others do who take the motion out: to where the machine stood as the scan began.
Change moved(double speed_m_s, double turn_deg_s) {
  return [=](sim::Frame& frame) {
    for (std::size_t i = 0; i < frame.count(); ++i) {
      float* const p = &frame.xyz_intensity[4 * i];
      const double t = frame.time_ns[i] * 1e-9, angle = turn_deg_s * M_PI / 180.0 * t;
      const double x = static_cast<double>(p[0]), y = static_cast<double>(p[1]);
      p[0] = static_cast<float>(std::cos(angle) * x - std::sin(angle) * y + speed_m_s * t);
      p[1] = static_cast<float>(std::sin(angle) * x + std::cos(angle) * y);
    }
  };
}

TEST(ScanTimes, TimesThatDoNotFitAreNamed) {
  const struct {
    const char* fault;
    Change change;
  } cases[] = {
      {"one_time", scaled(0.0)}, {"unit", scaled(5e-8)},     {"no_turn", by_range},       {"by_row", by_row},
      {"uneven", uneven},        {"backward", backward},     {"span", scaled(1.3)},       {"span", scaled(0.7)},
      {"span", scaled(0.2)},     {"moved", moved(0.5, 0.0)}, {"moved", moved(-0.3, 5.0)},
  };
  for (const char* sensor : {"vlp16", "os1-64"}) {
    for (const auto& [fault, change] : cases) {
      EXPECT_EQ(fault_of(sensor, {"speed_mps=0.5"}, change), fault) << sensor;
    }
  }
}

TEST(ScanTimes, InfoAndDoctorTell) {
  const TempFolder folder;
  write_frames(folder, timed_road("vlp16", {}), by_row);
  const std::string seen = "as many turns as the sensor has rings, 16";
  const std::string info = command({"info", "-q", folder.path()}).printed;
  EXPECT_TRUE(contains(info, "times?")) << info;
  EXPECT_TRUE(contains(info, "own driver, or its packets")) << info;
  const nlohmann::json page = nlohmann::json::parse(command({"doctor", "-q", "--json", folder.path()}).printed);
  EXPECT_EQ(page.at("times").at("fault"), "by_row");
  EXPECT_TRUE(contains(page.at("but").dump(), seen)) << page.at("but");
  const std::string chinese = command({"info", "-q", "--language", "zh", folder.path()}).printed;
  choose_language(Language::kEnglish);
  EXPECT_TRUE(contains(chinese, "时间是否按行排列")) << chinese;
}

// By other times that are wrong a scan keeps less of its motion than without any.
TEST(ScanTimes, MotionIsSwitchedOffWhereItWasTakenOutAlready) {
  const auto proposes = [](const Change& change, Words words) {
    const TempFolder folder;
    write_frames(folder, timed_road("vlp16", {}), change);
    words.push_back(folder.path());
    const nlohmann::json page = nlohmann::json::parse(command(words).printed);
    return contains(page.at("changes").dump(), "\"motion\"");
  };
  EXPECT_TRUE(proposes(moved(0.5, 0.0), {"doctor", "-q", "--json"}));
  EXPECT_FALSE(proposes(moved(0.5, 0.0), {"doctor", "-q", "--json", "-s", "motion=on"})) << "somebody said it";
  EXPECT_FALSE(proposes(by_row, {"doctor", "-q", "--json"}));
  EXPECT_FALSE(proposes(as_it_is, {"doctor", "-q", "--json"}));
}

// Packets of sensors that others recorded.
TEST(ScanTimes, RecordedScansAreNotDoubted) {
  const char* const data = std::getenv("POSE_WALL_DATA");
  const std::string folder = std::string(data != nullptr ? data : "") + "/packets/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "POSE_WALL_DATA names no folder with packets";
  const std::string os1 = folder + "OS-1-128_v2.3.0_1024x10_lb_n3", os0 = folder + "OS-0-32-U1_v2.2.0_1024x10";
  for (const Words& input :
       {Words{os1 + ".pcap", "--metadata", os1 + ".json"}, Words{os0 + ".pcap", "--metadata", os0 + ".json"},
        Words{folder + "velodyne_vlp16_gps.pcap"},
        Words{folder + "nebula/vlp16_1673400471837873222_1673400471837873222_0.db3"},
        Words{folder + "nebula/xt32_1673400677802009732_1673400677802009732_0.db3"}}) {
    if (!std::filesystem::exists(input.front())) continue;
    Words words = {"info", "-q", "--json"};
    words.insert(words.end(), input.begin(), input.end());
    const nlohmann::json page = nlohmann::json::parse(command(words).printed).at(0);
    if (page.at("times").is_null()) continue;  // a build that reads no captures
    EXPECT_EQ(page.at("times").at("fault"), "") << input.front();
    EXPECT_NEAR(page.at("times").at("turn_s").get<double>(), 0.1, 0.001) << input.front();
  }
}

}  // namespace
}  // namespace pose_wall::tools
