// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What of a folder goes into the evidence.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/evidence/manifest.hpp"

namespace pose_wall::tools::evidence {

struct Listing {
  std::vector<std::string> files;    // regular ones, sorted by their bytes
  std::vector<LeftOut> left_out;     // sorted likewise
  std::vector<std::string> missing;  // usual parts
};

// `zip`: what is about to be written, which may lie in the folder. Throws std::runtime_error where the folder cannot be
// read, holds nothing to pack, or holds what must not be packed: a name of the evidence's own, a name that not every
// program can unpack, a private key.
Listing list_folder(const std::filesystem::path& folder, const std::filesystem::path& zip);

// Whether a file begins like text: it is then packed by deflate. A recording is stored.
bool is_text(const std::filesystem::path& file);

}  // namespace pose_wall::tools::evidence
