// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What verb and tests print of a pack and of a check: for people, and as JSON.

#pragma once

#include <string>

#include "study/evidence/evidence.hpp"

namespace pose_wall::tools::evidence {

// After packing: files, settings, what is missing and left out, and who signed.
std::string packed_text(const std::string& zip, const Manifest& manifest);

// After a check: the same, what is proven and what is not. has_site_key: a public key was given.
std::string verdict_text(const std::string& zip, const Verdict& verdict, bool has_site_key);
std::string verdict_json(const std::string& zip, const Verdict& verdict, bool has_site_key);

// Whether all is proven that was asked for.
bool is_proven(const Verdict& verdict, bool has_site_key);

}  // namespace pose_wall::tools::evidence
