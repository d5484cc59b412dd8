// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/merge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <stdexcept>
#include <system_error>

#include "io/terminal/counted.hpp"
#include "lab/campaign/folder.hpp"

namespace pose_wall::tools::campaign {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPartsNamed = 10;  // in a message

struct PartFolder {
  std::string path;
  Manifest manifest;
};

template <typename... Values>
[[noreturn]] void refuse(fmt::format_string<Values...> form, Values&&... values) {
  throw std::invalid_argument("--merge " + fmt::format(form, std::forward<Values>(values)...));
}

PartFolder read_part(const std::string& path) {
  if (!holds_campaign(path)) {
    refuse("{}: no campaign was run there; allowed are folders that `pose_wall campaign --part` made", path);
  }
  PartFolder one{path, read_manifest(path)};
  if (!one.manifest.part) {
    refuse("{}: holds a whole campaign; allowed are parts. --card-only makes its card again", path);
  }
  return one;
}

void demand_one_campaign(const PartFolder& first, const PartFolder& other) {
  std::string differs = identity_difference(first.manifest, other.manifest, {first.path + " has", other.path + " has"});
  const std::uint32_t parts = first.manifest.part->of, other_parts = other.manifest.part->of;
  if (parts != other_parts) {
    differs += fmt::format("  parts: {} has 1 of {}, {} has 1 of {}\n", first.path, parts, other.path, other_parts);
  }
  if (!differs.empty())
    refuse("{}: a part of another campaign than {}:\n{}only parts of one campaign are allowed", other.path, first.path,
           differs);
}

void demand_finished(const PartFolder& one) {
  const Manifest& manifest = one.manifest;
  const std::size_t done = has_records(one.path) ? record_files(one.path).size() : 0;
  if (done != manifest.part_runs) {
    refuse("{}: part {} is not finished: {} of {} done; the same command as before continues it", one.path,
           part_text(*manifest.part), done, counted(manifest.part_runs, "run is", "runs are"));
  }
}

void demand_each_part_once(const std::vector<PartFolder>& parts) {
  std::map<std::uint32_t, std::string> folder_of;
  for (const PartFolder& one : parts) {
    const Part& part = *one.manifest.part;
    const auto [there, is_new] = folder_of.emplace(part.number, one.path);
    if (!is_new)
      refuse("{}: part {} is in {} already; each part is allowed once", one.path, part_text(part), there->second);
  }
  const std::uint32_t of = parts.front().manifest.part->of;
  std::vector<std::string> missing;
  for (std::uint32_t number = 1; number <= of && missing.size() < kPartsNamed; ++number) {
    if (folder_of.count(number) == 0) missing.push_back(part_text({number, of}));
  }
  if (!missing.empty()) {
    refuse("has {} of {}; missing are {}{}", counted(folder_of.size(), "part"), of, fmt::join(missing, ", "),
           of - folder_of.size() > missing.size() ? ", ..." : "");
  }
}

void copy_records(const fs::path& from, const fs::path& to) {
  for (const fs::path& file : record_files(from)) {
    const fs::path copy = to / fs::relative(file, from);
    fs::create_directories(copy.parent_path());
    fs::copy_file(file, copy, fs::copy_options::overwrite_existing);
  }
}

}  // namespace

Manifest merge_parts(const std::vector<std::string>& folders, const fs::path& output, bool fresh) {
  std::vector<PartFolder> parts;
  parts.reserve(folders.size());
  for (const std::string& folder : folders) parts.push_back(read_part(folder));
  for (const PartFolder& one : parts) {
    std::error_code ignored;
    if (fs::equivalent(one.path, output, ignored)) {
      refuse("{}: --output is a part itself; another folder is needed for the whole", one.path);
    }
    demand_one_campaign(parts.front(), one);
  }
  demand_each_part_once(parts);
  for (const PartFolder& one : parts) demand_finished(one);
  Manifest whole = parts.front().manifest;
  whole.part.reset();
  whole.part_runs = 0;
  prepare_folder(output, whole, fresh);
  for (const PartFolder& one : parts) copy_records(one.path, output);
  return whole;
}

}  // namespace pose_wall::tools::campaign
