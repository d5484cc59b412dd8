// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/planar_files/map_files.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include "io/config_file/yaml_entries.hpp"
#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/planar_files/pgm_image.hpp"

namespace pose_wall::tools {
namespace {

// The pixels of trinary images; darkness above 0.65 and below 0.196 tells them apart (205 is 0.1961).
constexpr std::uint16_t kThingPixel = 0, kUnknownPixel = 205, kFreePixel = 254;
constexpr double kOccupiedThreshold = 0.65, kFreeThreshold = 0.196;
constexpr std::int8_t kThing = 100, kFree = 0;

std::string text_of(const std::filesystem::path& file) {
  try {
    return read_whole_file(file);
  } catch (const std::runtime_error& error) {
    throw MapFileError(error.what());
  }
}

bool parse_number(std::string_view text, double* number) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *number);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(*number);
}

// What stands in the YAML.
class MapYaml {
 public:
  explicit MapYaml(const std::filesystem::path& file) : file_(file) {
    try {
      for (const YamlEntry& entry : parse_yaml_entries(text_of(file))) entries_.emplace(entry.key, entry);
    } catch (const YamlError& error) {
      throw MapFileError(fmt::format("{}:{}: {}", file.string(), error.line(), error.what()));
    }
  }

  const YamlEntry* find(const std::string& key) const {
    const auto found = entries_.find(key);
    return found != entries_.end() ? &found->second : nullptr;
  }
  const YamlEntry& need(const std::string& key) const {
    const YamlEntry* const entry = find(key);
    if (entry == nullptr) throw MapFileError(say("{}: the key '{}' is missing", file_.string(), key));
    return *entry;
  }
  double number(const std::string& key, double least, double most) const {
    const YamlEntry& entry = need(key);
    double value = 0.0;
    if (entry.is_sequence || !parse_number(entry.value, &value) || value < least || value > most) {
      refuse(entry, say("a number from {:g} to {:g}", least, most));
    }
    return value;
  }
  [[noreturn]] void refuse(const YamlEntry& entry, const std::string& allowed) const {
    throw MapFileError(say("{}:{}: {} ({}) must be {}", file_.string(), entry.line, entry.key, entry.value, allowed));
  }

 private:
  std::filesystem::path file_;
  std::map<std::string, YamlEntry> entries_;
};

enum class Mode { kTrinary, kScale, kRaw };

struct Meaning {
  Mode mode = Mode::kTrinary;
  bool negate = false;
  double occupied = kOccupiedThreshold, free = kFreeThreshold;
};

bool switch_of(const MapYaml& yaml, const YamlEntry& entry) {
  for (const char* const word : {"1", "true", "True", "yes", "on"}) {
    if (entry.value == word) return true;
  }
  for (const char* const word : {"0", "false", "False", "no", "off"}) {
    if (entry.value == word) return false;
  }
  yaml.refuse(entry, tr("0 or 1"));
}

Meaning meaning_of(const MapYaml& yaml) {
  Meaning meaning;
  meaning.negate = switch_of(yaml, yaml.need("negate"));
  meaning.occupied = yaml.number("occupied_thresh", 0.0, 1.0);
  meaning.free = yaml.number("free_thresh", 0.0, 1.0);
  if (meaning.free >= meaning.occupied) {
    yaml.refuse(yaml.need("free_thresh"), say("below occupied_thresh ({:g})", meaning.occupied));
  }
  const YamlEntry* const mode = yaml.find("mode");
  if (mode == nullptr || mode->value == "trinary") return meaning;
  if (mode->value != "scale" && mode->value != "raw") yaml.refuse(*mode, tr("trinary, scale or raw"));
  meaning.mode = mode->value == "scale" ? Mode::kScale : Mode::kRaw;
  return meaning;
}

void read_origin(const MapYaml& yaml, MapFile* map) {
  const YamlEntry& entry = yaml.need("origin");
  double numbers[3] = {};
  std::string_view rest = entry.value;
  bool good = entry.is_sequence;
  for (int k = 0; k < 3; ++k) {
    const std::size_t end = k < 2 ? rest.find(' ') : rest.size();
    good = good && end != std::string_view::npos && parse_number(rest.substr(0, end), &numbers[k]);
    if (good) rest.remove_prefix(k < 2 ? end + 1 : end);
  }
  if (!good) yaml.refuse(entry, tr("three numbers, [x, y, yaw]"));
  if (numbers[2] != 0.0) yaml.refuse(entry, tr("without a yaw: turned maps are not read"));
  map->origin_x_m = numbers[0];
  map->origin_y_m = numbers[1];
}

std::int8_t cell_of(const Meaning& meaning, std::uint32_t pixel, std::uint32_t most) {
  if (meaning.mode == Mode::kRaw) {
    return pixel <= 100 ? static_cast<std::int8_t>(pixel) : std::int8_t{POSE_WALL_PLANAR_UNKNOWN};
  }
  const double shade = static_cast<double>(pixel) / most, darkness = meaning.negate ? shade : 1.0 - shade;
  if (darkness > meaning.occupied) return kThing;
  if (darkness < meaning.free) return kFree;
  if (meaning.mode == Mode::kTrinary) return POSE_WALL_PLANAR_UNKNOWN;
  return static_cast<std::int8_t>(
      std::nearbyint(100.0 * (darkness - meaning.free) / (meaning.occupied - meaning.free)));
}

// By the thresholds of such a file the pixel that means unknown would be free.
bool frees_unknown(const Meaning& meaning, const PgmImage& image) {
  return meaning.mode == Mode::kTrinary && !meaning.negate && image.most == 255 &&
         cell_of(meaning, kUnknownPixel, 255) == kFree;
}

void read_cells(const PgmImage& image, const Meaning& meaning, MapFile* map) {
  const bool keep_unknown = frees_unknown(meaning, image);
  std::vector<std::int8_t> cells(image.most + 1);
  for (std::uint32_t pixel = 0; pixel <= image.most; ++pixel) cells[pixel] = cell_of(meaning, pixel, image.most);
  if (keep_unknown) cells[kUnknownPixel] = POSE_WALL_PLANAR_UNKNOWN;
  map->width = image.width;
  map->height = image.height;
  map->cells.resize(image.pixels.size());
  std::size_t kept = 0;
  for (std::size_t row = 0; row < image.height; ++row) {
    const std::uint16_t* const from = &image.pixels[(image.height - 1 - row) * image.width];
    for (std::size_t column = 0; column < image.width; ++column) {
      map->cells[row * image.width + column] = cells[from[column]];
      kept += keep_unknown && from[column] == kUnknownPixel ? 1 : 0;
    }
  }
  if (kept == 0) return;
  map->note =
      say("free_thresh ({:g}) would make {} unknown cells free (pixel 205); they stay unknown", meaning.free, kept);
}

// As YAML takes it whatever stands in it.
std::string quoted(const std::string& name) {
  std::string quoted = "'";
  for (const char sign : name) quoted += sign == '\'' ? "''" : std::string(1, sign);
  const bool plain =
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._") == std::string::npos;
  return plain ? name : quoted + "'";
}

std::uint16_t pixel_of(std::int8_t cell, int occupied_per_cent, int free_per_cent) {
  if (cell < 0 || cell > 100) return kUnknownPixel;
  if (cell >= occupied_per_cent) return kThingPixel;
  return cell <= free_per_cent ? kFreePixel : kUnknownPixel;
}

}  // namespace

pose_wall_planar_grid MapFile::grid() const {
  return {sizeof(pose_wall_planar_grid), width, height, 0, resolution_m, origin_x_m, origin_y_m, cells.data()};
}

bool is_inside(const pose_wall_planar_grid& grid, double x_m, double y_m) {
  const double in_x_m = x_m - grid.origin_x_m, in_y_m = y_m - grid.origin_y_m;
  return in_x_m >= 0.0 && in_x_m <= grid.width * grid.resolution_m && in_y_m >= 0.0 &&
         in_y_m <= grid.height * grid.resolution_m;
}

std::string extent_text(const pose_wall_planar_grid& grid) {
  return say("The map reaches from x {:.2f} to {:.2f} m and from y {:.2f} to {:.2f} m.", grid.origin_x_m,
             grid.origin_x_m + grid.width * grid.resolution_m, grid.origin_y_m,
             grid.origin_y_m + grid.height * grid.resolution_m);
}

void write_map_files(const std::filesystem::path& yaml, const pose_wall_planar_grid& grid, int occupied_per_cent,
                     int free_per_cent) {
  PgmImage image;
  image.width = grid.width;
  image.height = grid.height;
  image.pixels.reserve(std::size_t{grid.width} * grid.height);
  for (std::size_t row = grid.height; row-- > 0;) {
    const std::int8_t* const from = grid.cells + row * grid.width;
    for (std::size_t column = 0; column < grid.width; ++column) {
      image.pixels.push_back(pixel_of(from[column], occupied_per_cent, free_per_cent));
    }
  }
  std::filesystem::path picture = yaml;
  picture.replace_extension(".pgm");
  write_lasting_file(picture, pgm_bytes(image, fmt::format("pose_wall {:.3f} m/pix", grid.resolution_m)));
  write_lasting_file(yaml, fmt::format("image: {}\nmode: trinary\nresolution: {}\norigin: [{}, {}, 0]\nnegate: 0\n"
                                       "occupied_thresh: {}\nfree_thresh: {}\n",
                                       quoted(picture.filename().string()), grid.resolution_m, grid.origin_x_m,
                                       grid.origin_y_m, kOccupiedThreshold, kFreeThreshold));
}

std::size_t free_specks(MapFile* map) {
  constexpr int kFreeNeighbours = 5;
  std::vector<std::size_t> specks;
  for (std::size_t row = 1; row + 1 < map->height; ++row) {
    for (std::size_t column = 1; column + 1 < map->width; ++column) {
      const std::size_t at = row * map->width + column;
      if (map->cells[at] >= 0) continue;
      int free = 0;
      bool touches_thing = false;
      for (const std::size_t line : {at - map->width, at, at + map->width}) {
        for (const std::size_t cell : {line - 1, line, line + 1}) {
          free += map->cells[cell] == kFree ? 1 : 0;
          touches_thing = touches_thing || map->cells[cell] > kFree;
        }
      }
      if (free >= kFreeNeighbours && !touches_thing) specks.push_back(at);
    }
  }
  for (const std::size_t at : specks) map->cells[at] = kFree;
  return specks.size();
}

MapFile read_map_files(const std::filesystem::path& file) {
  const MapYaml yaml(file);
  MapFile map;
  map.resolution_m = yaml.number("resolution", 0.01, 1.0);
  read_origin(yaml, &map);
  const Meaning meaning = meaning_of(yaml);
  const YamlEntry& name = yaml.need("image");
  if (name.is_sequence || name.value.empty()) yaml.refuse(name, tr("the name of a PGM file"));
  const std::filesystem::path picture = file.parent_path() / name.value;  // a whole path stays what it is
  try {
    read_cells(parse_pgm(text_of(picture)), meaning, &map);
  } catch (const PgmError& error) {
    throw MapFileError(fmt::format("{}: {}", picture.string(), error.what()));
  }
  return map;
}

}  // namespace pose_wall::tools
