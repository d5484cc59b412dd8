// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What proves how a machine was commissioned: a folder's files as one zip, a manifest that tells the hash of each, and
// the site's signature over the manifest. README.md tells the format.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/evidence/manifest.hpp"

namespace pose_wall::tools::evidence {

// Called once for each kChunkBytes that were read, packed or checked, with the file's name. May throw Interrupted.
using Step = std::function<void(const std::string& name)>;
constexpr std::uint64_t kChunkBytes = 1U << 20;  // a megabyte: the memory that it takes is that of one chunk

struct PackRequest {
  std::filesystem::path folder, zip;
  bool overwrites = false;
  std::string key_file;  // empty: nobody signs
};

// Writes the zip beside its place, checks all of it, and then puts it there. Throws std::runtime_error for what cannot
// be read or written, std::invalid_argument and ConfigError for wrong words, a wrong key, and settings with faults.
// Missing libraries are a std::runtime_error that names their packages.
Manifest pack(const PackRequest& request, const std::function<Step(std::uint64_t chunks)>& begin);

// Who signed, as far as the zip and a given key can tell.
enum class Signature {
  kNone,    // nobody
  kOwnKey,  // the owner of the key that lies in the zip itself
  kSite,    // the owner of the key that was given
  kOther,   // the owner of the key in the zip, which is another than the given one
  kWrong    // the signature is none of the key's, or a part of it is missing
};

enum class FileState { kSame, kChanged, kMissing, kUnreadable };

struct CheckedFile {
  PackedFile told;
  FileState state = FileState::kMissing;
};

struct Verdict {
  std::vector<std::string> faults;  // sentences, in the reader's language; empty: it is whole
  Signature signature = Signature::kNone;
  std::string signer_sha256;  // fingerprint of the key in the zip; empty: there is none
  bool has_manifest = false;  // else what follows is empty
  Manifest manifest;
  std::vector<CheckedFile> files;

  bool is_whole() const { return faults.empty(); }
};

// public_key_file: empty where none was given. Whatever the zip holds, it takes the memory of its manifest (at most 4
// MB), of its list of members (64 MB) and of one chunk. Throws std::runtime_error where the file cannot be opened, or
// the libraries are missing; std::invalid_argument for a key that is none.
Verdict verify(const std::filesystem::path& zip, const std::string& public_key_file,
               const std::function<Step(std::uint64_t chunks)>& begin);

}  // namespace pose_wall::tools::evidence
