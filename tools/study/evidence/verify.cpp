// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>

#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"
#include "study/evidence/evidence.hpp"
#include "study/evidence/sha256.hpp"
#include "study/evidence/site_key.hpp"
#include "study/evidence/zip_file.hpp"
#include "study/evidence/zip_layout.hpp"

namespace pose_wall::tools::evidence {
namespace {

constexpr std::uint64_t kManifestBytesMost = 1U << 22;  // 4 MB: rows of some 20,000 files
constexpr std::uint64_t kKeyBytesMost = 1U << 12;       // a PEM of Ed25519 has 113
constexpr std::uint64_t kDeflateMost = 1032;            // of so many bytes one is left at best: zlib's documentation

// What is not told by a manifest, and is no fault.
bool is_own(const std::string& name) {
  return name == kManifestName || name == kSignatureName || name == kPublicKeyName;
}

class Check {
 public:
  Check(const std::filesystem::path& zip, std::optional<SiteKey> site) : zip_(zip), site_(std::move(site)) {}

  Verdict run(const std::function<Step(std::uint64_t chunks)>& begin) {
    try {
      const std::vector<std::string> names = checked_layout(zip_);
      reader_.emplace(zip_);
      take_members(names);
      take_manifest();
      check_files(begin);
      check_strangers();
    } catch (const std::runtime_error& error) {
      fault(error.what());
    }
    return std::move(verdict_);
  }

 private:
  void fault(const std::string& text) { verdict_.faults.push_back(text); }

  // Before anything is unpacked: what a member says of itself must be possible, and what it unpacks to must be a file
  // of this name in every program.
  void take_members(const std::vector<std::string>& names) {
    const std::vector<Member>& members = reader_->members();
    if (members.size() != names.size()) throw std::runtime_error(tr("its list of members is damaged"));
    for (std::size_t i = 0; i < members.size(); ++i) {
      const Member& member = members[i];
      const std::string shown = shown_name(names[i]);
      if (member.name != names[i]) {
        throw std::runtime_error(say("a member has two names: '{}' and '{}'", shown, shown_name(member.name)));
      }
      if (!is_plain_name(member.name)) {
        throw std::runtime_error(say("{}: a member of this name would be unpacked elsewhere, or not at all", shown));
      }
      if (!member.is_plain) throw std::runtime_error(say("{}: it is encrypted, or packed by an unusual method", shown));
      if (member.bytes / kDeflateMost > member.packed_bytes) {
        throw std::runtime_error(say("{}: {} bytes cannot come out of {}", shown, member.bytes, member.packed_bytes));
      }
      if (!members_.emplace(member.name, i).second) throw std::runtime_error(say("{}: it is there twice", shown));
    }
  }

  // All of a small member; nothing where there is none, or it is too large or damaged.
  std::optional<std::string> bytes_of(const char* name, std::uint64_t bytes_most) {
    const auto found = members_.find(name);
    if (found == members_.end()) return std::nullopt;
    const std::uint64_t size = reader_->members()[found->second].bytes;
    if (size > bytes_most) {
      throw std::runtime_error(say("{}: it has {} bytes; at most {} are allowed", name, size, bytes_most));
    }
    std::string bytes;
    const auto take = [&bytes](const char* part, std::size_t count) { bytes.append(part, count); };
    if (!reader_->read(found->second, take)) throw std::runtime_error(say("{}: its bytes are damaged", name));
    return bytes;
  }

  void take_manifest() {
    const std::optional<std::string> text = bytes_of(kManifestName, kManifestBytesMost);
    if (!text) throw std::runtime_error(say("there is no {} in it: it is no evidence", kManifestName));
    // Who signed can be told of a manifest that another version wrote, too.
    check_signature(*text);
    verdict_.manifest = read_manifest(*text);
    verdict_.has_manifest = true;
    if (verdict_.manifest.signed_by.value_or("") != verdict_.signer_sha256) {
      fault(say("{} names another key than that of {}, or one of them was taken out", kManifestName, kPublicKeyName));
    }
  }

  void check_signature(const std::string& text) {
    const std::optional<std::string> signature = bytes_of(kSignatureName, kSignatureBytes);
    const std::optional<std::string> pem = bytes_of(kPublicKeyName, kKeyBytesMost);
    if (!signature && !pem) return;
    verdict_.signature = Signature::kWrong;
    if (!signature || !pem) {
      fault(say("of {} and {} one is missing", kSignatureName, kPublicKeyName));
      return;
    }
    std::optional<SiteKey> own;
    try {
      own = SiteKey::of_public_pem(*pem, kPublicKeyName);
    } catch (const std::invalid_argument& error) {
      fault(error.what());
      return;
    }
    verdict_.signer_sha256 = own->fingerprint();
    if (own->public_pem() != *pem) fault(say("{}: its bytes are damaged", kPublicKeyName));
    if (!own->has_signed(text, *signature)) {
      fault(say("{} is no signature of {} by the key of {}", kSignatureName, kManifestName, kPublicKeyName));
    } else if (!site_) {
      verdict_.signature = Signature::kOwnKey;
    } else {
      const bool is_site = site_->fingerprint() == verdict_.signer_sha256;
      verdict_.signature = is_site ? Signature::kSite : Signature::kOther;
    }
  }

  void check_files(const std::function<Step(std::uint64_t chunks)>& begin) {
    std::uint64_t chunks = 0;
    for (const PackedFile& file : verdict_.manifest.files) {
      if (has_size_of(file)) chunks += file.bytes / kChunkBytes + 1;
    }
    const Step step = begin(chunks);
    for (const PackedFile& file : verdict_.manifest.files) check_file(file, step);
  }

  bool has_size_of(const PackedFile& file) const {
    const auto found = members_.find(file.name);
    return found != members_.end() && reader_->members()[found->second].bytes == file.bytes;
  }

  void check_file(const PackedFile& file, const Step& step) {
    const auto found = members_.find(file.name);
    CheckedFile checked{file, FileState::kMissing};
    if (!told_.emplace(file.name, 0).second || is_own(file.name)) {
      fault(say("{}: {} tells it twice, or it is its own", file.name, kManifestName));
    }
    if (found == members_.end()) {
      fault(say("{}: it is missing", file.name));
    } else if (!has_size_of(file)) {
      checked.state = FileState::kChanged;
      fault(say("{}: it has {} bytes instead of {}", file.name, reader_->members()[found->second].bytes, file.bytes));
    } else {
      checked.state = hash_state(found->second, file, step);
      if (checked.state == FileState::kChanged) fault(say("{}: its bytes are others than were packed", file.name));
      if (checked.state == FileState::kUnreadable) fault(say("{}: its bytes are damaged", file.name));
    }
    verdict_.files.push_back(std::move(checked));
  }

  FileState hash_state(std::size_t index, const PackedFile& file, const Step& step) const {
    Sha256 digest;
    step(file.name);
    std::uint64_t bytes = 0;
    const bool is_read = reader_->read(index, [&](const char* part, std::size_t count) {
      digest.add(part, count);
      const std::uint64_t before = bytes;
      bytes += count;
      for (std::uint64_t c = before / kChunkBytes; c < bytes / kChunkBytes; ++c) step(file.name);
    });
    if (!is_read) return FileState::kUnreadable;
    return digest.hexadecimal() == file.sha256 ? FileState::kSame : FileState::kChanged;
  }

  void check_strangers() {
    for (const auto& [name, index] : members_) {
      if (told_.count(name) == 0 && !is_own(name)) fault(say("{}: {} does not tell of it", name, kManifestName));
    }
  }

  std::filesystem::path zip_;
  std::optional<SiteKey> site_;
  std::optional<ZipReader> reader_;
  std::map<std::string, std::size_t> members_;  // by name, their place
  std::map<std::string, int> told_;             // by the manifest
  Verdict verdict_;
};

}  // namespace

Verdict verify(const std::filesystem::path& zip, const std::string& public_key_file,
               const std::function<Step(std::uint64_t chunks)>& begin) {
  std::optional<SiteKey> site;
  if (!public_key_file.empty()) site = SiteKey::to_verify(public_key_file);
  errno = 0;
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(zip, error);
  if (!is_file || !std::ifstream(zip, std::ios::binary).is_open()) {
    throw std::runtime_error(
        say("{}: cannot be read: {}", zip.string(), is_file ? system_error_text(errno) : tr("this is no file")));
  }
  return Check(zip, std::move(site)).run(begin);
}

}  // namespace pose_wall::tools::evidence
