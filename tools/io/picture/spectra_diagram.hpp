// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How rough rock is at each length, roads side by side: a panel for each face and direction, both axes logarithmic.
#pragma once

#include <string>
#include <vector>

namespace pose_wall::tools::picture {

struct SpectrumLine {
  std::string road;
  std::vector<double> length_m, median_m, rough_m;
};

struct SpectraPanel {
  std::string title;
  std::vector<SpectrumLine> lines;  // of the roads, in the same order in each panel
};

// The whole SVG document. Medians are drawn through, the roughest tenth in dashes.
std::string spectra_diagram(const std::vector<SpectraPanel>& panels);

}  // namespace pose_wall::tools::picture
