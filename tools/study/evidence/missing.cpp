// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Without libzip or OpenSSL.

#include <stdexcept>

#include "io/language/language.hpp"
#include "study/evidence/evidence.hpp"

namespace pose_wall::tools::evidence {
namespace {

[[noreturn]] void refuse() {
  throw std::runtime_error(
      tr("this build neither packs nor checks evidence: install libzip-dev and libssl-dev, configure with "
         "-DPOSE_WALL_EVIDENCE=ON and build again"));
}

}  // namespace

Manifest pack(const PackRequest& /*request*/, const std::function<Step(std::uint64_t)>& /*begin*/) {
  refuse();
}

Verdict verify(const std::filesystem::path& /*zip*/, const std::string& /*public_key_file*/,
               const std::function<Step(std::uint64_t)>& /*begin*/) {
  refuse();
}

}  // namespace pose_wall::tools::evidence
