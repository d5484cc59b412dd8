// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// SHA-256 of bytes as they come.

#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "study/evidence/evidence.hpp"

struct evp_md_ctx_st;

namespace pose_wall::tools::evidence {

class Sha256 {
 public:
  Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;
  ~Sha256();

  void add(const void* bytes, std::size_t count);

  // 64 digits; nothing can be added after it.
  std::string hexadecimal();

 private:
  evp_md_ctx_st* context_;
};

std::string sha256_of(const std::string& bytes);

// What a file holds now. Calls step for each chunk, and once for an empty file. Throws std::runtime_error that names
// it.
PackedFile hashed_file(const std::filesystem::path& file, const Step& step);

}  // namespace pose_wall::tools::evidence
