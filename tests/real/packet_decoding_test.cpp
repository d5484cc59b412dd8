// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: points of real packets lie where an independent decoder put them: one scan each of sensors whose packets were
// recorded in bags, decoded by TIER IV's Nebula into PCD files. What remains is said beside each bound. A capture whose
// packets contradict themselves is refused.

#include <gtest/gtest.h>

#if POSE_WALL_HAS_SQLITE && POSE_WALL_HAS_PCAP

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "io/frames/field_value.hpp"
#include "io/frames/point_position.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "io/packets/hesai_models.hpp"
#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

using Eigen::Vector3d;

constexpr double kCell_m = 0.06;  // farther apart are no partners

// The one file that begins and ends so; "" where there is none.
std::string recording(const std::string& begin, const std::string& end) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(data_folder() / "packets" / "nebula", none)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(begin, 0) == 0 && entry.path().extension() == end) return entry.path().string();
  }
  return "";
}

// Points that can be asked for the nearest.
class Neighbours {
 public:
  explicit Neighbours(std::vector<Vector3d> points) : points_(std::move(points)) {
    for (const Vector3d& point : points_) cells_[cell_of(point)].push_back(&point);
  }

  const Vector3d* nearest(const Vector3d& to) const {
    const Vector3d* best = nullptr;
    const Cell middle = cell_of(to);
    for (long i = 0; i < 27; ++i) {
      const auto cell = cells_.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1});
      if (cell == cells_.end()) continue;
      for (const Vector3d* point : cell->second) {
        if ((*point - to).norm() < kCell_m && (!best || (*point - to).norm() < (*best - to).norm())) best = point;
      }
    }
    return best;
  }

 private:
  using Cell = std::array<long, 3>;
  static Cell cell_of(const Vector3d& point) {
    return {std::lround(point.x() / kCell_m), std::lround(point.y() / kCell_m), std::lround(point.z() / kCell_m)};
  }
  std::vector<Vector3d> points_;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      return static_cast<std::size_t>(cell[0] * 73'856'093 ^ cell[1] * 19'349'663 ^ cell[2] * 83'492'791);
    }
  };
  std::unordered_map<Cell, std::vector<const Vector3d*>, Hash> cells_;
};

// Hesai's x is to the right of azimuth 0, its y along it.
Neighbours decoded_by_others(const std::string& pcd, bool is_hesai) {
  const tools::Frame frame = tools::load_frame(pcd);
  std::vector<Vector3d> points;
  for (std::uint32_t i = 0; i < frame.cloud.width; ++i) {
    const Vector3d point = tools::point_position(frame.cloud, 0, i);
    points.push_back(is_hesai ? Vector3d(point.y(), -point.x(), point.z()) : point);
  }
  return Neighbours(std::move(points));
}

struct Pair {
  Vector3d ours, theirs;
  std::uint32_t row = 0;
};

struct Comparison {
  std::vector<Pair> pairs;
  std::size_t alone = 0;  // ours without a partner

  std::vector<double> differences(double (*of)(const Pair&)) const {
    std::vector<double> values;
    for (const Pair& pair : pairs) values.push_back(of(pair));
    std::sort(values.begin(), values.end());
    return values;
  }
};

double apart_m(const Pair& pair) {
  return (pair.ours - pair.theirs).norm();
}
double range_apart_m(const Pair& pair) {
  return std::fabs(pair.ours.norm() - pair.theirs.norm());
}
double azimuth_apart_deg(const Pair& pair) {
  const double apart_rad = std::atan2(pair.theirs.y(), pair.theirs.x()) - std::atan2(pair.ours.y(), pair.ours.x());
  return std::remainder(apart_rad, 2.0 * M_PI) * kDegPerRad;
}
double elevation_apart_deg(const Pair& pair) {
  return (std::asin(pair.theirs.z() / pair.theirs.norm()) - std::asin(pair.ours.z() / pair.ours.norm())) * kDegPerRad;
}

double at(const std::vector<double>& sorted, double share) {
  return sorted.at(std::min(sorted.size() - 1, static_cast<std::size_t>(share * static_cast<double>(sorted.size()))));
}

// Of all our frames the one that agrees best: the others are scans before or after it.
Comparison compare(const std::string& bag, const Neighbours& theirs, const std::string& metadata, double nearest_m,
                   double farthest_m) {
  tools::InputOptions options;
  options.packets.metadata = metadata;
  tools::FrameSequence frames({bag}, options);
  EXPECT_TRUE(frames.errors().empty()) << frames.errors().front();
  std::optional<Comparison> best;
  while (const auto sourced = frames.next()) {
    const pose_wall_cloud& cloud = sourced->frame->cloud;
    Comparison here;
    for (std::uint32_t row = 0; row < cloud.height; ++row) {
      for (std::uint32_t column = 0; column < cloud.width; ++column) {
        const Vector3d point = tools::point_position(cloud, row, column);
        if (point.norm() < nearest_m || point.norm() > farthest_m) continue;
        if (const Vector3d* const partner = theirs.nearest(point)) {
          here.pairs.push_back({point, *partner, row});
        } else {
          ++here.alone;
        }
      }
    }
    if (here.pairs.empty()) continue;
    const auto typical_m = [](const Comparison& c) { return at(c.differences(apart_m), 0.9); };
    if (!best || typical_m(here) < typical_m(*best)) best = std::move(here);
  }
  return best.value_or(Comparison{});
}

void print(const std::string& what, const Comparison& c) {
  const std::vector<double> apart = c.differences(apart_m), ranges = c.differences(range_apart_m);
  fmt::print(
      "{}: {} points, {} without a partner; apart in mm: half {:.2f}, of a hundred 90 {:.2f} and 99 {:.2f}, "
      "largest {:.1f}; ranges alone: 90 {:.2f}, largest {:.1f}\n",
      what, c.pairs.size(), c.alone, 1e3 * at(apart, 0.5), 1e3 * at(apart, 0.9), 1e3 * at(apart, 0.99),
      1e3 * apart.back(), 1e3 * at(ranges, 0.9), 1e3 * ranges.back());
}

// The angles of this very sensor, as the other decoder was given them: what each ring differs by from the design.
std::string angles_from(const Comparison& c, const tools::HesaiTraits& traits) {
  std::map<std::uint32_t, Comparison> rings;
  for (const Pair& pair : c.pairs) rings[pair.row].pairs.push_back(pair);
  std::string table = "Laser id,Elevation,Azimuth\n";
  const std::vector<tools::Laser>& design = traits.beams.lasers;
  for (std::size_t i = 0; i < design.size(); ++i) {
    const tools::Laser& laser = design[i];
    const auto ring =
        static_cast<std::uint32_t>(std::count_if(design.begin(), design.end(), [&](const tools::Laser& other) {
          return other.elevation_deg < laser.elevation_deg;
        }));
    double elevation_deg = laser.elevation_deg, azimuth_deg = laser.azimuth_deg;
    if (!rings[ring].pairs.empty()) {
      elevation_deg += at(rings[ring].differences(elevation_apart_deg), 0.5);
      azimuth_deg -= at(rings[ring].differences(azimuth_apart_deg), 0.5);
    }
    table += fmt::format("{},{:.4f},{:.4f}\n", i + 1, elevation_deg, azimuth_deg);
  }
  return table;
}

// Where the table of the sensor itself is not there, angles of the design are off by what sensors differ.
void expect_hesai(const std::string& name, tools::HesaiModel model, double nearest_m, double farthest_m,
                  double angle_deg) {
  const std::string bag = recording(name, ".db3"), pcd = recording(name, ".pcd");
  if (bag.empty() || pcd.empty()) GTEST_SKIP() << "POSE_WALL_DATA names no folder with packets/nebula/" << name;
  const Neighbours theirs = decoded_by_others(pcd, true);
  const Comparison design = compare(bag, theirs, "", nearest_m, farthest_m);
  ASSERT_GT(design.pairs.size(), 30'000U);
  print(name + ", angles of the design", design);
  EXPECT_LT(design.alone * 1000, design.pairs.size());
  EXPECT_LT(at(design.differences(range_apart_m), 0.95), 1e-4) << "ranges do not depend on angles";
  for (const auto of : {azimuth_apart_deg, elevation_apart_deg}) {
    EXPECT_LT(at(design.differences(of), 0.95), angle_deg);
    EXPECT_GT(at(design.differences(of), 0.05), -angle_deg);
  }
  const std::filesystem::path table = std::filesystem::path(::testing::TempDir()) / (name + "_angles.csv");
  std::ofstream(table) << angles_from(design, tools::hesai_traits(model));
  const Comparison own = compare(bag, theirs, table.string(), nearest_m, farthest_m);
  std::filesystem::remove(table);
  print(name + ", its own angles", own);
  // Where azimuth passes 0 the other decoder cuts each ring by itself: up to one point in forty has a neighbour, of the
  // same wall, for its partner.
  EXPECT_LT(at(own.differences(apart_m), 0.95), 1e-3);
}

TEST(PacketDecoding, HesaiXt32) {
  expect_hesai("xt32", tools::HesaiModel::kXt32, 0.05, 120.0, 0.15);
}

TEST(PacketDecoding, HesaiPandar40p) {
  expect_hesai("40p", tools::HesaiModel::kPandar40p, 0.3, 200.0, 0.25);
}

TEST(PacketDecoding, HesaiQt64) {
  expect_hesai("qt64", tools::HesaiModel::kQt64, 0.1, 60.0, 0.01);
}

// Nebula takes all lasers of a VLP-16 for one place; ours leave where the manual says, up to 11.2 mm above or below.
// It rounds azimuths to 0.01 degrees and does not interpolate the last pair of blocks of a packet: 0.4 degrees there.
TEST(PacketDecoding, Vlp16) {
  const std::string bag = recording("vlp16", ".db3"), pcd = recording("vlp16", ".pcd");
  if (bag.empty() || pcd.empty()) GTEST_SKIP() << "POSE_WALL_DATA names no folder with packets/nebula";
  Comparison c = compare(bag, decoded_by_others(pcd, false), "", 0.3, 130.0);
  ASSERT_GT(c.pairs.size(), 10'000U);
  print("vlp16", c);
  EXPECT_EQ(c.alone, 0U);
  EXPECT_LT(c.differences(apart_m).back(), 0.05);
  for (Pair& pair : c.pairs) {
    const double elevation_deg = -15.0 + 2.0 * pair.row;
    pair.ours.z() += 0.0112 * elevation_deg / 15.0;
  }
  print("vlp16, all lasers in one place", c);
  EXPECT_LT(at(c.differences(apart_m), 0.5), 1e-3);
  EXPECT_LT(at(c.differences(range_apart_m), 0.5), 1e-4);
}

// Nebula turns the head on for each laser of a VLP-32C, though two fire at once: up to 0.14 degrees.
TEST(PacketDecoding, Vlp32c) {
  const std::string bag = recording("vlp32", ".db3"), pcd = recording("vlp32", ".pcd");
  if (bag.empty() || pcd.empty()) GTEST_SKIP() << "POSE_WALL_DATA names no folder with packets/nebula/vlp32";
  const Comparison c = compare(bag, decoded_by_others(pcd, false), "", 0.3, 200.0);
  ASSERT_GT(c.pairs.size(), 20'000U);
  print("vlp32", c);
  EXPECT_LT(c.alone * 100, c.pairs.size());
  EXPECT_LT(at(c.differences(apart_m), 0.5), 0.01);
  EXPECT_LT(at(c.differences(range_apart_m), 0.5), 1e-4);
  EXPECT_LT(std::fabs(at(c.differences(elevation_apart_deg), 0.5)), 1e-3);
}

std::vector<std::string> errors_of(const std::string& sensor) {
  tools::InputOptions options;
  options.packets.sensor = sensor;
  return tools::FrameSequence({(data_folder() / "packets" / "misnamed_vlp16_is_hdl32.pcap").string()}, options)
      .errors();
}

// A VLP-16 of 2014: its product byte is that of an HDL-32E, but a packet takes it 1327 us, and the second sixteen
// ranges of a block repeat the first, as of sixteen lasers.
TEST(PacketDecoding, PacketsThatContradictThemselvesAreRefusedUnlessTheSensorIsNamed) {
  if (!std::filesystem::exists(data_folder() / "packets" / "misnamed_vlp16_is_hdl32.pcap")) {
    GTEST_SKIP() << "POSE_WALL_DATA names no folder with it";
  }
  for (const char* sensor : {"", "hdl32e", "vlp32c"}) {
    const std::vector<std::string> errors = errors_of(sensor);
    ASSERT_EQ(errors.size(), 1U) << sensor;
    EXPECT_NE(errors.front().find("their clock (1327 us a packet) says Velodyne VLP-16"), std::string::npos)
        << errors.front();
  }
  EXPECT_NE(errors_of("").front().find("HDL-32E"), std::string::npos);
  EXPECT_TRUE(errors_of("vlp16").empty());
}

}  // namespace
}  // namespace pose_wall::test

#endif
