// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/evidence/sha256.hpp"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"

namespace pose_wall::tools::evidence {

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  if (context_ == nullptr || EVP_DigestInit_ex(context_, EVP_sha256(), nullptr) != 1) {
    EVP_MD_CTX_free(context_);
    throw std::runtime_error(tr("OpenSSL gives no SHA-256"));
  }
}

Sha256::~Sha256() {
  EVP_MD_CTX_free(context_);
}

void Sha256::add(const void* bytes, std::size_t count) {
  if (EVP_DigestUpdate(context_, bytes, count) != 1) throw std::runtime_error(tr("OpenSSL gives no SHA-256"));
}

std::string Sha256::hexadecimal() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned count = 0;
  if (EVP_DigestFinal_ex(context_, digest.data(), &count) != 1) {
    throw std::runtime_error(tr("OpenSSL gives no SHA-256"));
  }
  std::string text;
  for (unsigned i = 0; i < count; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string sha256_of(const std::string& bytes) {
  Sha256 digest;
  digest.add(bytes.data(), bytes.size());
  return digest.hexadecimal();
}

PackedFile hashed_file(const std::filesystem::path& file, const Step& step) {
  PackedFile hashed{file.filename().string(), 0, ""};
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  Sha256 digest;
  std::vector<char> chunk(kChunkBytes);
  do {
    in.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    const auto got = static_cast<std::size_t>(in.gcount());
    digest.add(chunk.data(), got);
    hashed.bytes += got;
    step(hashed.name);
  } while (in);
  if (!in.is_open() || in.bad()) {
    throw std::runtime_error(say("{}: cannot be read: {}", file.string(), system_error_text(errno)));
  }
  hashed.sha256 = digest.hexadecimal();
  return hashed;
}

}  // namespace pose_wall::tools::evidence
