// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/evidence/folder_listing.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"
#include "study/evidence/open_key.hpp"

namespace pose_wall::tools::evidence {
namespace {

namespace fs = std::filesystem;

std::string head_of(const fs::path& file) {
  constexpr std::size_t kHeadBytes = 4096;  // a page: MCAP, bags and captures have a zero among their first numbers
  std::string head(kHeadBytes, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

// Empty: it is packed. Links are not followed: what they lead to may be another file tomorrow.
std::string why_left_out(const fs::directory_entry& entry, const fs::path& zip) {
  if (entry.is_symlink()) return "link";
  if (entry.path().filename().string().front() == '.') return "hidden";
  if (entry.is_directory()) return "folder";
  if (!entry.is_regular_file()) return "no regular file";
  return is_same_file(entry.path(), zip) || is_same_file(entry.path(), part_of(zip)) ? "the zip itself" : "";
}

void expect_packable(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name == kManifestName || name == kSignatureName || name == kPublicKeyName) {
    throw std::runtime_error(
        say("{}: the evidence has a file of its own by this name; take it out of the folder", name));
  }
  if (!is_plain_name(name)) {
    throw std::runtime_error(
        say("{}: not every program can unpack this name; rename it: UTF-8 without backslashes and control characters",
            shown_name(name)));
  }
  if (is_private_key(head_of(file))) {
    throw std::runtime_error(
        say("{}: this is a private key. Whoever has it can sign as the site: take it out of the folder", name));
  }
}

// Any recording: the daemon's own are called by number and time.
std::vector<std::string> missing_of(const std::vector<std::string>& files) {
  std::vector<std::string> missing;
  for (const char* usual : {kSettingsName, "doctor.json", "report.html"}) {
    if (!std::binary_search(files.begin(), files.end(), usual)) missing.emplace_back(usual);
  }
  const bool has_recording = std::any_of(files.begin(), files.end(),
                                         [](const std::string& name) { return fs::path(name).extension() == ".mcap"; });
  if (!has_recording) missing.emplace_back("recording*.mcap");
  return missing;
}

}  // namespace

Listing list_folder(const fs::path& folder, const fs::path& zip) {
  Listing listing;
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) {
    throw std::runtime_error(say("{}: cannot be read: {}", folder.string(), system_error_text(error.value())));
  }
  for (const fs::directory_entry& entry : entries) {
    const std::string name = entry.path().filename().string();
    const std::string why = why_left_out(entry, zip);
    if (!why.empty()) {
      listing.left_out.push_back({name, why});
      continue;
    }
    expect_packable(entry.path());
    listing.files.push_back(name);
  }
  if (listing.files.empty()) throw std::runtime_error(say("{}: there is no file in it", folder.string()));
  std::sort(listing.files.begin(), listing.files.end());
  std::sort(listing.left_out.begin(), listing.left_out.end(),
            [](const LeftOut& a, const LeftOut& b) { return a.name < b.name; });
  listing.missing = missing_of(listing.files);
  return listing;
}

bool is_text(const fs::path& file) {
  const std::string head = head_of(file);
  return !head.empty() && head.find('\0') == std::string::npos;
}

}  // namespace pose_wall::tools::evidence
