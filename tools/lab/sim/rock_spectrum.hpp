// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How rough rock is at each length: what is left of a stretch of it once its straight line is taken away. A simulated
// rock is like a real one if both have the same figures.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "lab/sim/rock_surface.hpp"

namespace pose_wall::tools::sim {

// Root mean square distance from the straight line of a stretch.
struct ReliefAtLength {
  double length_m = 0.0;
  double median_m = 0.0;  // of all stretches; NaN where none is whole, or so long
  double rough_m = 0.0;   // a tenth of them are rougher
  std::size_t stretches = 0;
  std::size_t broken = 0;  // others, with an opening or a corner in them: these are not counted as relief
};

struct RockSpectrum {
  std::string face;       // walls, floor, roof
  std::string direction;  // along the road; up a wall; across floor or roof
  std::vector<ReliefAtLength> at;
};

// Of one road or of several together.
class RockSpectra {
 public:
  // From poses of base along a road, which look along it. Walls are taken as high as the truth takes them
  // (survey_truth.hpp), floor and roof as wide.
  void add(const RockSurface& rock, const std::vector<Placement>& path);
  // Walls along and up, floor along and across, roof along and across.
  std::vector<RockSpectrum> told() const;

  static constexpr std::size_t kLengths = 12;

 private:
  struct Reliefs {
    std::array<std::vector<double>, kLengths> of_m;
    std::array<std::size_t, kLengths> broken{};
    std::vector<ReliefAtLength> told() const;
  };
  struct Face;
  static void measure(const RockSurface& rock, const Face& face, std::array<Reliefs, 2>* along_and_across);

  std::array<Reliefs, 2> walls_, floor_, roof_;  // along, across
};

// Rows of a table: road, face, direction, length_m, median_m, rough_m, stretches, broken.
inline constexpr const char* kSpectraHead = "road,face,direction,length_m,median_m,rough_m,stretches,broken\n";
std::string spectra_rows(const std::string& road, const std::vector<RockSpectrum>& spectra);

}  // namespace pose_wall::tools::sim
