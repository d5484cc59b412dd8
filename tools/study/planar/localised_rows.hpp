// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What localisation answered to each scan, as a table in files; and figures of it.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "io/planar_files/relations.hpp"
#include "pose_wall_planar_localise.h"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools {

inline constexpr std::size_t kLocaliseStates = 5;  // of pose_wall_planar_localise_state

struct LocalisedRow {
  std::size_t scan = 0;  // number in the input, from 0
  std::string time;      // as the input writes it
  std::uint32_t state = 0, reason = 0;
  pose_wall_planar_pose base{};        // NaN: none
  std::array<double, 6> covariance{};  // xx, xy, x yaw, yy, y yaw, yaw yaw
  double fits = 0.0, explained = 0.0, misfit_m = 0.0, slide_m = 0.0, rival = 0.0, progress = 0.0;
  std::uint32_t candidates = 0, searches = 0, lost = 0;
  double travel_m = 0.0;    // of the input, up to this scan
  bool is_restart = false;  // before this scan no place was known: the first, or after --restart
  double error_m = std::numeric_limits<double>::quiet_NaN();  // against the truth; NaN: not known
  double error_rad = std::numeric_limits<double>::quiet_NaN();

  bool is_unique() const { return state == POSE_WALL_PLANAR_LOCALISE_UNIQUE; }
  bool has_pose() const { return state >= POSE_WALL_PLANAR_LOCALISE_UNIQUE; }
  // The larger standard deviation of the position; infinity without a pose.
  double position_sigma_m() const { return larger_sigma_m(covariance[0], covariance[1], covariance[3]); }
  // As the library's own campaign counts it.
  bool is_wrong() const { return has_pose() && (error_m >= 0.5 || error_rad >= 0.1); }
};

LocalisedRow row_of(const pose_wall_planar_localise_result& result);

// scan, time_s, state, reason, x_m, y_m, yaw_rad, the covariance, ... error_rad; empty cells: there is none.
std::string localised_csv(const std::vector<LocalisedRow>& rows);
// Whether it is such a table.
bool is_localised_table(const CsvTable& table);
// Throws CsvError.
std::vector<LocalisedRow> read_localised_rows(const CsvTable& table);

struct CandidateRow {
  std::size_t scan = 0;
  std::size_t number = 0;
  pose_wall_planar_candidate candidate{};
};
std::string candidates_csv(const std::vector<CandidateRow>& rows);

struct FoundAgain {
  double at_m = 0.0;  // travel at the restart
  bool is_found = false;
  double after_m = 0.0;  // until unique, or until the end
  std::size_t after_scans = 0;
};

struct LocaliseFigures {
  std::size_t scans = 0;
  std::array<std::size_t, kLocaliseStates> of_state{};
  std::array<std::uint32_t, kLocaliseStates> mostly{};  // the state's most frequent reason
  std::vector<FoundAgain> restarts;                     // the first scan is one, unless its place was given
  double fits_mean = 0.0;                               // of scans with a pose; NaN: none
  std::uint32_t searches = 0, lost = 0;
  double travel_m = 0.0;
  // Of unique scans with a truth.
  std::size_t compared = 0, wrong = 0;
  double error_mean_m = 0.0, error_worst_m = 0.0, error_mean_rad = 0.0, error_worst_rad = 0.0;
};
LocaliseFigures figures_of(const std::vector<LocalisedRow>& rows);

// One word, and a sentence without its full stop; both in the chosen language.
std::string place_state_words(std::uint32_t state);
std::string place_reason_words(std::uint32_t reason);

using NamedFigure = std::pair<std::string, std::string>;
std::vector<NamedFigure> named_figures(const LocaliseFigures& figures);
// State, scans, share, most frequent reason; a row for each state that there is.
std::vector<std::vector<std::string>> state_table(const LocaliseFigures& figures);
// Of unique scans; empty without a truth.
std::vector<NamedFigure> truth_figures(const LocaliseFigures& figures);

}  // namespace pose_wall::tools
