// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall_rock: how rough the rock of roads is at each length, real and simulated ones, as a table and a picture.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "io/frames/whole_file.hpp"
#include "io/outputs/output_folder.hpp"
#include "io/picture/spectra_diagram.hpp"
#include "io/terminal/text_table.hpp"
#include "lab/sim/check_setup.hpp"
#include "lab/sim/parameters.hpp"
#include "lab/sim/random.hpp"
#include "lab/sim/rock_spectrum.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/world.hpp"
#include "lab/survey/survey_file.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kStep_m = 0.5, kHeight_m = 1.3;  // between places along a road, and of them above its floor
constexpr double kHalfRoad_m = 60.0;              // of a simulated road

struct Words {
  std::vector<std::string> surfaces, scenes, settings;
  std::string path, output;
  unsigned roads = 8;  // of a scene: long waves are few on one
};

struct Road {
  std::string name;
  std::vector<sim::RockSpectrum> spectra;
};

Road of_surface(const std::string& file, const std::string& path) {
  const SurveyRock survey = read_survey_rock(file, std::nullopt);
  sim::RockSpectra spectra;
  spectra.add(*survey.rock, path.empty() ? propose_survey_path(survey, file) : read_survey_path(path));
  return {std::filesystem::path(file).stem().string(), spectra.told()};
}

Road of_scene(const std::string& scene, const Words& words) {
  sim::Setup setup = sim::make_setup(scene, "vlp16", false, 1);
  for (const std::string& setting : words.settings) sim::set_parameter(setup, setting);
  sim::checked(setup);
  const sim::CentreLine line(setup.road.curve_radius_m);
  std::vector<sim::Placement> path;
  for (double s = -kHalfRoad_m; s <= kHalfRoad_m; s += kStep_m) {
    path.push_back({sim::rotation_z(line.heading_rad(s)), line.point(s, 0.0, kHeight_m)});
  }
  sim::RockSpectra spectra;
  for (unsigned seed = 1; seed <= words.roads; ++seed) spectra.add(sim::World(setup, sim::mix(seed)), path);
  return {scene, spectra.told()};
}

void print_table(const std::vector<Road>& roads) {
  std::vector<std::string> head = {"face", "direction", "length"};
  for (const Road& road : roads) head.insert(head.end(), {road.name + " mm", "roughest tenth", "broken"});
  TextTable table(head);
  for (std::size_t s = 0; s < roads.front().spectra.size(); ++s) {
    const sim::RockSpectrum& first = roads.front().spectra[s];
    for (std::size_t k = 0; k < first.at.size(); ++k) {
      std::vector<std::string> cells = {first.face, first.direction, fmt::format("{:g} m", first.at[k].length_m)};
      for (const Road& road : roads) {
        const sim::ReliefAtLength& at = road.spectra[s].at[k];
        const std::size_t all = at.stretches + at.broken;
        const auto mm = [&](double m) { return at.stretches > 0 ? fmt::format("{:.1f}", 1e3 * m) : "-"; };
        const double broken = 100.0 * static_cast<double>(at.broken) / static_cast<double>(all);
        cells.insert(cells.end(), {mm(at.median_m), mm(at.rough_m), all > 0 ? fmt::format("{:.0f} %", broken) : "-"});
      }
      table.add_row(cells);
    }
  }
  fmt::print("{}", table.text(2));
}

std::string picture_of(const std::vector<Road>& roads) {
  std::vector<picture::SpectraPanel> panels;
  for (std::size_t s = 0; s < roads.front().spectra.size(); ++s) {
    const sim::RockSpectrum& first = roads.front().spectra[s];
    picture::SpectraPanel panel{first.face + ", " + first.direction, {}};
    for (const Road& road : roads) {
      picture::SpectrumLine line{road.name, {}, {}, {}};
      for (const sim::ReliefAtLength& at : road.spectra[s].at) {
        if (at.stretches == 0) continue;
        line.length_m.push_back(at.length_m);
        line.median_m.push_back(at.median_m);
        line.rough_m.push_back(at.rough_m);
      }
      panel.lines.push_back(std::move(line));
    }
    panels.push_back(std::move(panel));
  }
  return picture::spectra_diagram(panels);
}

int measure(const Words& words) {
  if (words.surfaces.empty() && words.scenes.empty()) {
    throw std::invalid_argument("--surface FILE or --scene NAME is needed; both may come several times");
  }
  if (!words.output.empty()) make_output_folder(words.output);
  std::vector<Road> roads;
  for (const std::string& file : words.surfaces) roads.push_back(of_surface(file, words.path));
  for (const std::string& scene : words.scenes) roads.push_back(of_scene(scene, words));
  print_table(roads);
  if (words.output.empty()) return 0;
  std::string rows = sim::kSpectraHead;
  for (const Road& road : roads) rows += sim::spectra_rows(road.name, road.spectra);
  write_whole_file(std::filesystem::path(words.output) / "spectra.csv", rows);
  write_whole_file(std::filesystem::path(words.output) / "spectra.svg", picture_of(roads));
  return 0;
}

}  // namespace
}  // namespace pose_wall::tools

int main(int argc, char** argv) {
  CLI::App app(
      "How rough rock is at each length: what is left of a stretch of wall, floor or roof once its straight line is "
      "taken away. Median of all stretches and the roughest tenth; stretches with openings are told as broken.");
  pose_wall::tools::Words words;
  auto* const surface = app.add_option("--surface", words.surfaces,
                                       "A real road: mesh or cloud with normals, as of `pose_wall sim --surface`");
  app.add_option("--path", words.path, "Poses along the surfaces (TUM); without, the tool proposes some")
      ->needs(surface);
  app.add_option("--scene", words.scenes, "A simulated road; see `pose_wall sim --list`");
  app.add_option("--set", words.settings, "KEY=VALUE of the scenes");
  app.add_option("--roads", words.roads, "How many roads of each scene, together")
      ->capture_default_str()
      ->check(CLI::Range(1U, 100U));
  app.add_option("--output", words.output, "Folder for spectra.csv and spectra.svg");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& fault) {
    return app.exit(fault) == 0 ? 0 : 2;
  }
  try {
    return pose_wall::tools::measure(words);
  } catch (const std::exception& error) {
    fmt::print(stderr, "pose_wall_rock: {}\n", error.what());
    return 2;
  }
}
