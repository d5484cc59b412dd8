// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/planar_files/planar_input.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "io/frames/file_content.hpp"
#include "io/frames/text_points.hpp"
#include "io/language/language.hpp"
#include "io/planar_files/map_files.hpp"

namespace pose_wall::tools {
namespace {

constexpr const char* kCellsFile = "map.yaml";

constexpr const char* kLog =
    translatable("this is a log of CARMEN: scans of a planar laser scanner. info, scan, map and localise take it");
constexpr const char* kMapFolder =
    translatable("this is a map, as `pose_wall map -o` writes it. localise, plan and report take it");
constexpr const char* kFoundFolder = translatable("this is what `pose_wall localise -o` wrote. report takes it");
constexpr const char* kCellsYaml = translatable("this is the YAML file of a map. plan and localise take it");
constexpr const char* kCellsImage =
    translatable("this is the image of a map's cells. plan and localise take the YAML file that names it");
constexpr const char* kTrail =
    translatable("this is the trail of a map. localise takes it; plan and report take its folder");

bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

bool is_folder_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

bool begins_with(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

bool ends_so(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

std::string folder_text(const std::filesystem::path& folder) {
  if (is_there(folder / kCellsFile) || is_there(folder / "trail.pwt")) return tr(kMapFolder);
  return is_there(folder / "localise.csv") ? tr(kFoundFolder) : "";
}

// Archives and texts have many uses; a log of CARMEN is one by its name or its first word.
bool is_surely_log(const std::filesystem::path& file, std::string_view beginning) {
  const std::string name = file.filename().string();
  if (begins_with(beginning, "\x1F\x8B")) return ends_so(name, ".clf.gz") || ends_so(name, ".log.gz");
  return !begins_like_points(beginning) && is_carmen_log(file);
}

std::string file_text(const std::filesystem::path& file) {
  const std::string beginning = beginning_of(file);
  if (beginning.empty()) return "";
  if (begins_with(beginning, "PWTL")) return tr(kTrail);
  if (file.extension() == ".pgm" && (begins_with(beginning, "P5") || begins_with(beginning, "P2"))) {
    return tr(kCellsImage);
  }
  const bool is_yaml = file.extension() == ".yaml" || file.extension() == ".yml";
  if (is_yaml && beginning.find("image:") != std::string::npos) return tr(kCellsYaml);
  return is_surely_log(file, beginning) ? tr(kLog) : "";
}

}  // namespace

bool is_carmen_log(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 2> packed{};
  if (!in.read(packed.data(), packed.size())) return false;
  if (packed[0] == '\x1f' && packed[1] == '\x8b') return true;  // no other input is packed by gzip
  const std::string name = file.filename().string();
  if (ends_so(name, ".clf") || ends_so(name, ".log")) return true;
  in.seekg(0);
  for (std::string word; in >> word;) {
    if (word.front() == '#') {
      std::getline(in, word);
      continue;
    }
    const std::array<const char*, 6> kinds = {"FLASER", "ROBOTLASER1", "PARAM", "ODOM", "SYNC", "RLASER"};
    return std::find(kinds.begin(), kinds.end(), word) != kinds.end();
  }
  return false;
}

std::string planar_input_text(const std::filesystem::path& input) {
  if (is_folder_there(input)) return folder_text(input);
  return is_there(input) ? file_text(input) : "";
}

std::filesystem::path cells_file_of(const std::filesystem::path& map) {
  if (!is_there(map)) {
    throw std::invalid_argument(
        say("MAP {}: there is no such file or folder. `pose_wall map -o FOLDER INPUT` makes a map; give its FOLDER, or "
            "the YAML file of a map",
            map.string()));
  }
  if (is_folder_there(map)) {
    if (is_there(map / kCellsFile)) return map / kCellsFile;
    throw MapFileError(
        say("MAP {}: the folder has no {}. `pose_wall map -o FOLDER INPUT` writes it", map.string(), kCellsFile));
  }
  const std::string extension = map.extension().string();
  if (extension == ".yaml" || extension == ".yml") return map;
  const std::string kind = file_text(map);
  throw MapFileError(say("MAP {}: {}. Allowed: the folder of `pose_wall map -o`, or the YAML file of a map",
                         map.string(), kind.empty() ? tr("this is no map") : kind));
}

}  // namespace pose_wall::tools
