// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "study/planar/localised_rows.hpp"

namespace pose_wall::tools {
namespace {

constexpr const char* kStateWords[] = {translatable("searching"), translatable("unknown"), translatable("ambiguous"),
                                       translatable("unique"), translatable("doubtful")};
static_assert(std::size(kStateWords) == kLocaliseStates);

// In the order of pose_wall_planar_localise_reason.
constexpr const char* kReasonWords[] = {
    "",
    translatable("the first search goes on"),
    translatable("no place of the map fits"),
    translatable("several places fit"),
    translatable("more places are likely than the search has room for"),
    translatable("too little fits: things have moved, or the map is old"),
    translatable("much of what is seen is not in the map"),
    translatable("lines of sight pass through walls of the map"),
    translatable("too little is seen"),
    translatable("the place is not certain along the road"),
    translatable("walls without relief: the map may lack a place like this one"),
    translatable("the last metres fit, the present scan does not"),
    translatable("the scan contradicts the map"),
    translatable("the same scan came before: sensor or driver hang"),
};
static_assert(std::size(kReasonWords) == POSE_WALL_PLANAR_LOCALISE_REASONS);

class RunningMean {
 public:
  void add(double value) {
    sum_ += value;
    worst_ = std::max(worst_, value);
    ++count_;
  }
  double mean() const { return count_ == 0 ? NAN : sum_ / static_cast<double>(count_); }
  double worst() const { return count_ == 0 ? NAN : worst_; }

 private:
  double sum_ = 0.0, worst_ = 0.0;
  std::size_t count_ = 0;
};

std::vector<FoundAgain> restarts_of(const std::vector<LocalisedRow>& rows) {
  std::vector<FoundAgain> restarts;
  bool is_open = false;
  std::size_t begun = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].is_restart) {
      restarts.push_back({rows[k].travel_m, false, 0.0, 0});
      is_open = true;
      begun = k;
    }
    if (!is_open) continue;
    FoundAgain& last = restarts.back();
    last.after_m = rows[k].travel_m - last.at_m;
    last.after_scans = k - begun + 1;
    last.is_found = rows[k].is_unique();
    is_open = !last.is_found;
  }
  return restarts;
}

std::array<std::uint32_t, kLocaliseStates> frequent_reasons(const std::vector<LocalisedRow>& rows) {
  std::size_t counts[kLocaliseStates][POSE_WALL_PLANAR_LOCALISE_REASONS] = {};
  for (const LocalisedRow& row : rows) ++counts[row.state][row.reason];
  std::array<std::uint32_t, kLocaliseStates> mostly{};
  for (std::size_t k = 0; k < kLocaliseStates; ++k) {
    mostly[k] = static_cast<std::uint32_t>(std::max_element(std::begin(counts[k]), std::end(counts[k])) - counts[k]);
  }
  return mostly;
}

std::string share_of(std::size_t part, std::size_t whole) {
  return fmt::format("{:.1f} %",
                     100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole)));
}

// "9.1 m, median; 21.0 m at most"
std::string spread_text(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return say("{:.1f} m in the median, {:.1f} m at most", values[values.size() / 2], values.back());
}

}  // namespace

LocaliseFigures figures_of(const std::vector<LocalisedRow>& rows) {
  LocaliseFigures out;
  out.scans = rows.size();
  RunningMean fits, error_m, error_rad;
  for (const LocalisedRow& row : rows) {
    ++out.of_state[row.state];
    if (row.has_pose()) fits.add(row.fits);
    if (!row.is_unique() || !std::isfinite(row.error_m)) continue;
    error_m.add(row.error_m);
    error_rad.add(row.error_rad);
    ++out.compared;
    out.wrong += row.is_wrong() ? 1U : 0U;
  }
  out.mostly = frequent_reasons(rows);
  out.restarts = restarts_of(rows);
  out.fits_mean = fits.mean();
  out.error_mean_m = error_m.mean();
  out.error_worst_m = error_m.worst();
  out.error_mean_rad = error_rad.mean();
  out.error_worst_rad = error_rad.worst();
  if (rows.empty()) return out;
  out.searches = rows.back().searches;
  out.lost = rows.back().lost;
  out.travel_m = rows.back().travel_m;
  return out;
}

std::string place_state_words(std::uint32_t state) {
  return tr(kStateWords[std::min<std::uint32_t>(state, kLocaliseStates - 1)]);
}

std::string place_reason_words(std::uint32_t reason) {
  return reason == 0 || reason >= std::size(kReasonWords) ? "" : tr(kReasonWords[reason]);
}

std::vector<std::vector<std::string>> state_table(const LocaliseFigures& figures) {
  std::vector<std::vector<std::string>> rows;
  for (const std::uint32_t state :
       {POSE_WALL_PLANAR_LOCALISE_UNIQUE, POSE_WALL_PLANAR_LOCALISE_DOUBTFUL, POSE_WALL_PLANAR_LOCALISE_AMBIGUOUS,
        POSE_WALL_PLANAR_LOCALISE_UNKNOWN, POSE_WALL_PLANAR_LOCALISE_SEARCHING}) {
    const std::size_t scans = figures.of_state[state];
    if (scans == 0) continue;
    rows.push_back({place_state_words(state), std::to_string(scans), share_of(scans, figures.scans),
                    place_reason_words(figures.mostly[state])});
  }
  return rows;
}

std::vector<NamedFigure> named_figures(const LocaliseFigures& figures) {
  std::vector<NamedFigure> out = {{tr("scans"), std::to_string(figures.scans)},
                                  {tr("travel"), fmt::format("{:.1f} m", figures.travel_m)}};
  std::vector<double> found_m, open_m;
  for (const FoundAgain& restart : figures.restarts) {
    (restart.is_found ? found_m : open_m).push_back(restart.after_m);
  }
  if (!figures.restarts.empty()) {
    out.emplace_back(tr("restarts"), std::to_string(figures.restarts.size()));
    out.emplace_back(tr("unique before the next restart"), std::to_string(found_m.size()));
  }
  if (!found_m.empty()) out.emplace_back(tr("travel until unique"), spread_text(found_m));
  if (!open_m.empty()) out.emplace_back(tr("travel without it, in the others"), spread_text(open_m));
  out.emplace_back(tr("places lost while tracked"), std::to_string(figures.lost));
  if (std::isfinite(figures.fits_mean)) {
    out.emplace_back(tr("patches that fit, where there is a pose"), fmt::format("{:.1f} %", 100.0 * figures.fits_mean));
  }
  return out;
}

std::vector<NamedFigure> truth_figures(const LocaliseFigures& figures) {
  if (figures.compared == 0) return {};
  return {
      {tr("unique scans compared"), std::to_string(figures.compared)},
      {tr("unique and wrong (0.5 m or 5.7°)"), std::to_string(figures.wrong)},
      {tr("error, mean"), fmt::format("{:.4f} m, {:.3f}°", figures.error_mean_m, figures.error_mean_rad * kDegPerRad)},
      {tr("error, worst"),
       fmt::format("{:.4f} m, {:.3f}°", figures.error_worst_m, figures.error_worst_rad * kDegPerRad)}};
}

}  // namespace pose_wall::tools
