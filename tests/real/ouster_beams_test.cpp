// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what two real Ousters tell of their beams is what the tables say: the beam origin to the micrometre, the
// angles within a degree, which is how far sensors of one kind differ.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "io/beams/beam_table.hpp"
#include "io/packets/ouster_metadata.hpp"
#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

constexpr double kBeamsApart_deg = 1.0;  // sensors of a kind differ by half a degree; rings in another order by more

std::optional<tools::OusterMetadata> metadata_of(const std::string& name) {
  std::ifstream file(data_folder() / "packets" / name, std::ios::binary);
  if (!file) return std::nullopt;
  return tools::parse_ouster_metadata({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
}

// Row sensor_first + i * sensor_every of the sensor is row first + i * every of the table.
void expect_alike(const tools::OusterMetadata& sensor, const tools::BeamTable& table, std::size_t rows,
                  std::size_t sensor_first, std::size_t sensor_every, std::size_t first, std::size_t every) {
  EXPECT_NEAR(sensor.beam_origin_out_m, table.lens.out_m, 1e-9);
  EXPECT_EQ(sensor.beam_origin_up_m, 0.0);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t of_sensor = sensor_first + i * sensor_every;
    const tools::Laser& laser = table.lasers.at(first + i * every);
    EXPECT_NEAR(sensor.altitude_deg.at(of_sensor), laser.elevation_deg, kBeamsApart_deg) << i;
    EXPECT_NEAR(sensor.azimuth_deg.at(of_sensor), laser.azimuth_deg, kBeamsApart_deg) << i;
  }
}

TEST(OusterBeams, AnOs1Of128HasThoseOfTheTableInItsOddRows) {
  const auto sensor = metadata_of("OS-1-128_v2.3.0_1024x10_lb_n3.json");
  if (!sensor) GTEST_SKIP() << "POSE_WALL_DATA names no folder with packets/OS-1-128_v2.3.0_1024x10_lb_n3.json";
  expect_alike(*sensor, tools::ouster_os1_64(), 64, 1, 2, 0, 1);
}

TEST(OusterBeams, AnOs0Of32HasEachFourthOfTheTable) {
  const auto sensor = metadata_of("OS-0-32-U1_v2.2.0_1024x10.json");
  if (!sensor) GTEST_SKIP() << "POSE_WALL_DATA names no folder with packets/OS-0-32-U1_v2.2.0_1024x10.json";
  expect_alike(*sensor, tools::ouster_os0_128(), 32, 0, 1, 2, 4);
}

}  // namespace
}  // namespace pose_wall::test
