// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The reader of a bag by what the file begins with.

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "io/bags/bag_reader.hpp"

namespace pose_wall::tools {

enum class BagKind { kRos1, kMcap, kSqlite };

// "ROS 1 bag"
std::string_view bag_kind_name(BagKind kind);

// By content; by its ending where that does not tell.
std::optional<BagKind> recognise_bag(const std::filesystem::path& file);

// Throws FrameError or std::runtime_error.
std::unique_ptr<BagReader> open_bag(const std::filesystem::path& file, BagKind kind);

}  // namespace pose_wall::tools
