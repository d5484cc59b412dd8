// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/record_file.hpp"

#include <fstream>
#include <stdexcept>

#include "io/frames/whole_file.hpp"
#include "study/motion/motion_table.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr const char* kFirstWords = "# pose_wall campaign ";

}  // namespace

void write_record_file(const std::filesystem::path& file, const std::string& table, const std::string& campaign) {
  write_whole_file(file, kFirstWords + campaign + "\n" + table);
}

void read_record_file(const std::filesystem::path& file, const std::string& campaign,
                      const std::function<void(const CsvTable&)>& take) {
  std::ifstream in(file, std::ios::binary);
  std::string first;
  if (!in || !std::getline(in, first)) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  if (first != kFirstWords + campaign) {
    throw std::runtime_error(fmt::format("{}: a record of another campaign: it begins with '{}', not '{}{}'",
                                         file.string(), first, kFirstWords, campaign));
  }
  try {
    take(CsvTable::parse(in));
  } catch (const CsvError& error) {
    throw std::runtime_error(
        fmt::format("{}: {}; without this file the same command measures it again", file.string(), error.what()));
  }
}

std::vector<std::string> run_head() {
  return {"scene", "sensor", "draw", "seed"};
}

std::vector<std::string> run_cells(const Run& run) {
  return {run.scene, run.sensor, std::to_string(run.draw), std::to_string(run.seed)};
}

Run run_of(const CsvTable& table) {
  if (table.rows() == 0) throw CsvError("no frame in it");
  const auto cell = [&table](const char* name) { return table.cell(0, demanded_column(table, "record", name)); };
  return {cell("scene"), cell("sensor"), whole_number<std::uint32_t>(cell("draw")),
          whole_number<std::uint64_t>(cell("seed"))};
}

}  // namespace pose_wall::tools::campaign
