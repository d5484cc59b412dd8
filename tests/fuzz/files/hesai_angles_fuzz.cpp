// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as a table of a Hesai's angles, for a sensor of three lasers.

#include <cmath>
#include <string>

#include "fuzz/fuzz_target.hpp"
#include "io/packets/hesai_models.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pose_wall;
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    for (const tools::HesaiLaser& laser : tools::parse_hesai_angles(text, 3)) {
      test::require(std::fabs(laser.elevation_deg) <= 90.0 && std::fabs(laser.azimuth_deg) <= 180.0, "angles");
    }
  } catch (const tools::FrameError& error) {
    test::require(error.what()[0] != '\0', "a refusal has a reason");
  }
  return 0;
}
