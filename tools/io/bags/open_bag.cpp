// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/open_bag.hpp"

#include <array>
#include <string_view>
#include <system_error>

#include "io/bags/mcap_bag.hpp"
#include "io/bags/ros1_bag.hpp"
#include "io/bags/sqlite_bag.hpp"
#include "io/frames/file_content.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

struct KnownBag {
  BagKind kind;
  std::string_view name;
  FileContent content;
  std::string_view ending;
};

constexpr std::array<KnownBag, 3> kBags = {
    {{BagKind::kRos1, "ROS 1 bag", FileContent::kRos1Bag, ".bag"},
     {BagKind::kMcap, "MCAP", FileContent::kMcap, ".mcap"},
     {BagKind::kSqlite, translatable("SQLite bag of ROS 2"), FileContent::kSqlite, ".db3"}}};

}  // namespace

std::string_view bag_kind_name(BagKind kind) {
  return tr(kBags[static_cast<std::size_t>(kind)].name.data());
}

std::optional<BagKind> recognise_bag(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
  const FileContent content = content_of(beginning_of(file));
  for (const KnownBag& bag : kBags) {
    if (content == bag.content) return bag.kind;
  }
  if (!ending_decides(content)) return std::nullopt;
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
  throw FrameError(tr("unknown kind of bag"));
}

}  // namespace pose_wall::tools
