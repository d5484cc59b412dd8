// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <tuple>

#include "lab/campaign/motion_classes.hpp"
#include "lab/campaign/record_file.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/sensors.hpp"

namespace pose_wall::tools::campaign {
namespace {

std::filesystem::path records_in(const std::filesystem::path& folder) {
  return folder / "records";
}

// Those that are not in the table come last.
template <typename Table>
std::ptrdiff_t place_in(const Table& table, const std::string& name) {
  return std::find_if(table.begin(), table.end(), [&](const auto& one) { return one.name == name; }) - table.begin();
}

// Of a file as record_file names it. A draw of more than six digits has a longer name.
auto rank_of(const std::filesystem::path& file, bool of_motion) {
  static const std::vector<std::string> sensors = sim::sensor_names();
  const std::filesystem::path sensor = file.parent_path();
  const std::string scene = sensor.parent_path().filename().string(), draw = file.filename().string();
  return std::tuple(of_motion ? place_in(motion_classes(), scene) : place_in(sim::scenes(), scene),
                    std::find(sensors.begin(), sensors.end(), sensor.filename()) - sensors.begin(), draw.size(), draw);
}

}  // namespace

std::filesystem::path record_file(const std::filesystem::path& folder, const Run& run) {
  return records_in(folder) / run.scene / run.sensor / fmt::format("{:06}.csv", run.draw);
}

void prepare_folder(const std::filesystem::path& folder, const Manifest& manifest, bool fresh) {
  if (fresh && std::filesystem::exists(records_in(folder))) {
    if (!holds_campaign(folder)) read_manifest(folder);  // throws and says why: somebody else's records stay
    std::filesystem::remove_all(records_in(folder));
    for (const char* of_old_card :
         {"card.md", "card.json", "frames.csv", "level_curve.csv", "stanford_angles.svg", "stanford_distances.svg"}) {
      std::filesystem::remove(folder / of_old_card);
    }
  }
  if (std::filesystem::exists(records_in(folder))) {
    const std::string differs = difference(read_manifest(folder), manifest);
    if (!differs.empty()) {
      throw StaleError(fmt::format("{} holds records of another campaign:\n{}--fresh removes them and starts anew",
                                   folder.string(), differs));
    }
    return;
  }
  std::filesystem::create_directories(folder);
  write_manifest(folder, manifest);
  std::filesystem::create_directories(records_in(folder));
}

std::vector<Run> pending_runs(const std::filesystem::path& folder, const std::vector<Run>& runs) {
  std::vector<Run> pending;
  for (const Run& run : runs) {
    const std::filesystem::path file = record_file(folder, run);
    if (std::filesystem::exists(file)) continue;
    std::filesystem::create_directories(file.parent_path());
    pending.push_back(run);
  }
  return pending;
}

bool has_records(const std::filesystem::path& folder) {
  return std::filesystem::exists(records_in(folder));
}

std::vector<std::filesystem::path> record_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(records_in(folder))) {
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  if (files.empty()) throw std::runtime_error(fmt::format("{}: no record in it", records_in(folder).string()));
  return files;
}

void for_each_record(const std::filesystem::path& folder, const Manifest& manifest,
                     const std::function<void(const CsvTable&)>& take) {
  std::vector<std::filesystem::path> files = record_files(folder);
  const bool of_motion = manifest.plan.motion;
  std::sort(files.begin(), files.end(),
            [of_motion](const auto& a, const auto& b) { return rank_of(a, of_motion) < rank_of(b, of_motion); });
  for (const std::filesystem::path& file : files) read_record_file(file, manifest.fingerprint(), take);
}

std::vector<RunRecord> read_records(const std::filesystem::path& folder, const Manifest& manifest) {
  std::vector<RunRecord> records;
  for_each_record(folder, manifest, [&](const CsvTable& table) {
    records.push_back(record_of(table));
    records.back().run.drive_in_m = manifest.plan.drive_in_m;  // it has no column of its own
  });
  return records;
}

void write_frames(const std::filesystem::path& folder, const std::vector<RunRecord>& records) {
  std::ofstream out(folder / "frames.csv", std::ios::binary);
  out << csv_line(record_head());
  for (const RunRecord& record : records) out << record_lines(record);
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot write", (folder / "frames.csv").string()));
}

}  // namespace pose_wall::tools::campaign
