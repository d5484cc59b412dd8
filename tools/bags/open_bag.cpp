// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "bags/open_bag.hpp"

#include <array>
#include <fstream>
#include <string>

#include "bags/mcap_bag.hpp"
#include "bags/ros1_bag.hpp"
#include "bags/sqlite_bag.hpp"

namespace pose_wall::tools {
namespace {

using namespace std::string_view_literals;

struct KnownBag {
  BagKind kind;
  std::string_view name;
  std::string_view magic;
  std::string_view ending;
};

constexpr std::array<KnownBag, 3> kBags = {{{BagKind::kRos1, "ROS 1 bag", "#ROSBAG V"sv, ".bag"},
                                            {BagKind::kMcap, "MCAP", "\x89MCAP"sv, ".mcap"},
                                            {BagKind::kSqlite, "SQLite bag of ROS 2", "SQLite format 3\0"sv, ".db3"}}};
constexpr std::size_t kMagicBytesMax = 16;

std::string beginning_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string beginning(kMagicBytesMax, '\0');
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(stream.gcount()));
  return beginning;
}

}  // namespace

std::string_view bag_kind_name(BagKind kind) {
  return kBags[static_cast<std::size_t>(kind)].name;
}

std::optional<BagKind> recognise_bag(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
  const std::string beginning = beginning_of(file);
  for (const KnownBag& bag : kBags) {
    if (beginning.compare(0, bag.magic.size(), bag.magic) == 0) return bag.kind;
  }
  for (const KnownBag& bag : kBags) {
    if (file.extension() == bag.ending) return bag.kind;
  }
  return std::nullopt;
}

std::unique_ptr<BagReader> open_bag(const std::filesystem::path& file, BagKind kind) {
  switch (kind) {
    case BagKind::kRos1:
      return std::make_unique<Ros1Bag>(file.string());
    case BagKind::kMcap:
      return std::make_unique<McapBag>(file.string());
    case BagKind::kSqlite:
      return open_sqlite_bag(file.string());
  }
  throw FrameError("unknown kind of bag");
}

}  // namespace pose_wall::tools
