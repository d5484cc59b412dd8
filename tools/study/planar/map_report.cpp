// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/map_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "io/csv/csv_file.hpp"
#include "io/frames/whole_file.hpp"
#include "io/json/json_words.hpp"
#include "io/language/language.hpp"
#include "pose_wall.h"
#include "study/planar/known_map.hpp"
#include "study/planar/localised_rows.hpp"
#include "study/planar/map_fit.hpp"
#include "study/report/assets.hpp"
#include "study/report/columns.hpp"
#include "study/report/filled_page.hpp"

namespace pose_wall::tools {
namespace {

struct RouteFigures {
  std::string name;
  std::size_t poses = 0, cusps = 0, spot_turns = 0;
  double length_m = 0.0;
};

struct ReportPicture {
  std::string name, svg;
};

// What an input holds.
struct ReportPart {
  std::string name;
  std::optional<KnownMap> map;
  std::optional<MapFit> fit;  // of the map
  std::optional<LocaliseFigures> localised;
  std::vector<RouteFigures> routes;
  std::vector<ReportPicture> pictures;
};

bool is_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

bool has_file(const std::filesystem::path& folder, const char* name) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / name, ignored);
}

bool is_route_table(const CsvTable& table) {
  return table.find_column("drive") && table.find_column("cusp") && table.find_column("along_m");
}

RouteFigures route_figures(const std::string& name, const CsvTable& table) {
  RouteFigures out;
  out.name = name;
  out.poses = table.rows();
  const std::size_t along = *table.find_column("along_m"), cusp = *table.find_column("cusp");
  const std::optional<std::size_t> turn = table.find_column("turn");
  bool was_turning = false;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    out.length_m = table.number(k, along);
    out.cusps += table.number(k, cusp) == 1.0 ? 1U : 0U;
    const bool is_turning = turn && !table.cell(k, *turn).empty();
    out.spot_turns += is_turning && !was_turning ? 1U : 0U;
    was_turning = is_turning;
  }
  return out;
}

// False: it is none of localise or plan.
bool add_table(const std::filesystem::path& file, ReportPart* part) {
  const CsvTable table = read_csv_file(file.string());
  return in_csv_file(file.string(), [&] {
    if (is_localised_table(table)) {
      part->localised = figures_of(read_localised_rows(table));
    } else if (is_route_table(table)) {
      part->routes.push_back(route_figures(file.filename().string(), table));
    } else {
      return false;
    }
    return true;
  });
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

ReportPart part_of_folder(const std::filesystem::path& folder, std::vector<std::filesystem::path>* read) {
  ReportPart part;
  if (has_file(folder, "trail.pwt") || has_file(folder, "map.yaml")) {
    part.map = read_known_map(folder);
    part.fit = read_fit(folder);
    read->insert(read->end(), part.map->files.begin(), part.map->files.end());
  }
  for (const std::filesystem::path& file : files_in(folder)) {
    if (file.extension() == ".svg") part.pictures.push_back({file.filename().string(), read_whole_file(file)});
    if (file.extension() == ".svg" || (file.extension() == ".csv" && add_table(file, &part))) read->push_back(file);
  }
  // The map itself comes first.
  std::stable_partition(part.pictures.begin(), part.pictures.end(),
                        [](const ReportPicture& picture) { return picture.name == "map.svg"; });
  return part;
}

Json table_json(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows) {
  return {{"head", head}, {"rows", rows}};
}

Json figures_json(const std::string& title, const std::vector<NamedFigure>& figures) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, value] : figures) rows.push_back({name, value});
  return table_json({title, ""}, rows);
}

std::vector<NamedFigure> figures_of_map(const KnownMap& map, const std::optional<MapFit>& fit) {
  std::vector<NamedFigure> out;
  if (map.trail) {
    out.emplace_back(tr("keyframes"), std::to_string(map.trail->keyframes()));
    out.emplace_back(tr("travel"), fmt::format("{:.1f} m", map.trail->travel_m()));
    out.emplace_back(tr("loop closures"), std::to_string(map.trail->closures().size()));
  }
  if (fit) {
    out.emplace_back(tr("verdict"), fit->verdict());
    out.emplace_back(tr("scans that fit badly"), part_of_scans(fit->badly, fit->scans));
    out.emplace_back(tr("scans with too few points"), part_of_scans(fit->blind, fit->scans));
  }
  const MapFile& cells = map.cells;
  const double cell_m2 = cells.resolution_m * cells.resolution_m;
  const auto free = std::count(cells.cells.begin(), cells.cells.end(), std::int8_t{0});
  out.emplace_back(tr("size"), fmt::format("{:.1f} x {:.1f} m", cells.width * cells.resolution_m,
                                           cells.height * cells.resolution_m));
  out.emplace_back(tr("cells of"), fmt::format("{:.2f} m", cells.resolution_m));
  out.emplace_back(tr("free area"), fmt::format("{:.0f} m²", cell_m2 * static_cast<double>(free)));
  return out;
}

Json restarts_json(const LocaliseFigures& figures) {
  std::vector<std::vector<std::string>> rows;
  for (const FoundAgain& restart : figures.restarts) {
    rows.push_back({fmt::format("{:.1f} m", restart.at_m),
                    restart.is_found ? say("after {:.1f} m, {} scans", restart.after_m, restart.after_scans)
                                     : say("not within {:.1f} m", restart.after_m)});
  }
  return table_json({tr("restart at"), tr("unique")}, rows);
}

Json tables_of(const ReportPart& part) {
  Json tables = Json::array();
  if (part.map) tables.push_back(figures_json(tr("map"), figures_of_map(*part.map, part.fit)));
  if (part.localised) {
    tables.push_back(
        table_json({tr("state"), tr("scans"), tr("share"), tr("mostly because")}, state_table(*part.localised)));
    tables.push_back(figures_json(tr("localisation"), named_figures(*part.localised)));
    const std::vector<NamedFigure> against = truth_figures(*part.localised);
    if (!against.empty()) tables.push_back(figures_json(tr("against the truth"), against));
    tables.push_back(restarts_json(*part.localised));
  }
  for (const RouteFigures& route : part.routes) {
    tables.push_back(
        figures_json(say("route: {}", route.name), {{tr("length"), fmt::format("{:.2f} m", route.length_m)},
                                                    {tr("poses"), std::to_string(route.poses)},
                                                    {tr("turns on the spot"), std::to_string(route.spot_turns)},
                                                    {tr("changes of direction"), std::to_string(route.cusps)}}));
  }
  return tables;
}

// In the language that is chosen now.
Json texts_of(const std::vector<ReportPart>& parts) {
  Json sections = Json::array();
  for (const ReportPart& part : parts) sections.push_back({{"title", part.name}, {"tables", tables_of(part)}});
  return {{"other_language", tr("中文 (ZH)")},
          {"theme", tr("Dark / light")},
          {"report", tr("pose_wall report")},
          {"subtitle", say("maps, localisation and routes, by pose_wall {}", pose_wall_version())},
          {"sections", sections}};
}

Json in_both_languages(const std::vector<ReportPart>& parts) {
  const Language chosen = std::string(language_name()) == "zh" ? Language::kChinese : Language::kEnglish;
  Json texts;
  for (const Language language : {Language::kEnglish, Language::kChinese}) {
    choose_language(language);
    texts[language_name()] = texts_of(parts);
  }
  choose_language(chosen);
  return texts;
}

ReportPart part_of(const std::string& input, std::vector<std::filesystem::path>* read) {
  ReportPart part;
  if (is_folder(input)) {
    part = part_of_folder(input, read);
  } else if (std::filesystem::path(input).extension() == ".svg") {
    part.pictures.push_back({std::filesystem::path(input).filename().string(), read_whole_file(input)});
    read->emplace_back(input);
  } else {
    add_table(input, &part);
    read->emplace_back(input);
  }
  part.name = input;
  return part;
}

}  // namespace

bool is_map_result(const std::string& input) {
  if (is_folder(input)) {
    return has_file(input, "trail.pwt") || has_file(input, "map.yaml") || has_file(input, "localise.csv");
  }
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(input, ignored)) return false;
  const std::filesystem::path extension = std::filesystem::path(input).extension();
  if (extension == ".svg") return true;
  if (extension != ".csv") return false;
  const CsvTable table = read_csv_file(input);
  return is_localised_table(table) || is_route_table(table);
}

MapReport map_report(const std::vector<std::string>& inputs, const std::string& title) {
  MapReport report;
  std::vector<ReportPart> parts;
  for (const std::string& input : inputs) parts.push_back(part_of(input, &report.files));
  Json data = {{"title", title}, {"language", language_name()}, {"texts", in_both_languages(parts)}};
  data["pictures"] = Json::array();
  for (const ReportPart& part : parts) {
    Json of_part = Json::array();
    for (const ReportPicture& picture : part.pictures) {
      of_part.push_back({{"name", picture.name}, {"data", "data:image/svg+xml;base64," + report::base64(picture.svg)}});
      ++report.pictures;
    }
    data["pictures"].push_back(of_part);
  }
  report.page = report::filled_page(report::map_assets(), json_text(data), title);
  return report;
}

}  // namespace pose_wall::tools
