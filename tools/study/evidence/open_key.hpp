// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Private keys that lie open: to other users of the machine, or in the folder that is about to leave the site.

#pragma once

#include <sys/stat.h>

#include <string>

namespace pose_wall::tools::evidence {

// Whether others than the owner may do anything with the file.
inline bool is_open_to_others(const std::string& file) {
  struct stat about {};
  return stat(file.c_str(), &about) == 0 && (about.st_mode & (S_IRWXG | S_IRWXO)) != 0;
}

// Whether the beginning of a file has the mark of a private key in PEM, of any kind.
inline bool is_private_key(const std::string& head) {
  return head.find("PRIVATE KEY-----") != std::string::npos;
}

}  // namespace pose_wall::tools::evidence
