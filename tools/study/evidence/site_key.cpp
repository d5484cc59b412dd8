// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/evidence/site_key.hpp"

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <stdexcept>

#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "study/evidence/sha256.hpp"

namespace pose_wall::tools::evidence {
namespace {

using Bio = std::unique_ptr<BIO, decltype(&BIO_free)>;
using Context = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

Bio bytes_as_bio(const std::string& bytes) {
  return {BIO_new_mem_buf(bytes.data(), static_cast<int>(bytes.size())), BIO_free};
}

std::string text_of(BIO* bio) {
  char* bytes = nullptr;
  const long count = BIO_get_mem_data(bio, &bytes);
  return count > 0 ? std::string(bytes, static_cast<std::size_t>(count)) : std::string();
}

const unsigned char* bytes_of(const std::string& text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

// Nobody is asked where nobody sits: a script gets an error instead of a prompt.
int ask_nobody(char* /*passphrase*/, int /*size*/, int /*writes*/, void* /*nothing*/) {
  return -1;
}

std::string key_file(const std::string& file) {
  try {
    return read_whole_file(file);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
}

void expect_ed25519(const EVP_PKEY* key, const std::string& name) {
  if (EVP_PKEY_get_id(key) == EVP_PKEY_ED25519) return;
  const char* const kind = EVP_PKEY_get0_type_name(key);
  throw std::invalid_argument(
      say("{}: this is a key of {}; a key of Ed25519 is allowed. Make one: openssl genpkey -algorithm ed25519 -out "
          "site.pem",
          name, kind != nullptr ? kind : "?"));
}

}  // namespace

SiteKey SiteKey::to_sign(const std::string& file) {
  const std::string pem = key_file(file);
  const Bio bio = bytes_as_bio(pem);
  const bool somebody_sits = isatty(STDIN_FILENO) != 0;
  std::shared_ptr<EVP_PKEY> key(
      PEM_read_bio_PrivateKey(bio.get(), nullptr, somebody_sits ? nullptr : ask_nobody, nullptr), EVP_PKEY_free);
  if (!key) {
    throw std::invalid_argument(
        say("{}: this is no private key in PEM, or its passphrase is missing. Make one: openssl genpkey -algorithm "
            "ed25519 -out site.pem",
            file));
  }
  expect_ed25519(key.get(), file);
  return SiteKey(std::move(key));
}

SiteKey SiteKey::to_verify(const std::string& file) {
  return of_public_pem(key_file(file), file);
}

SiteKey SiteKey::of_public_pem(const std::string& pem, const std::string& name) {
  const Bio bio = bytes_as_bio(pem);
  std::shared_ptr<EVP_PKEY> key(PEM_read_bio_PUBKEY(bio.get(), nullptr, ask_nobody, nullptr), EVP_PKEY_free);
  if (!key) {
    throw std::invalid_argument(
        say("{}: this is no public key in PEM. Make one: openssl pkey -in site.pem -pubout -out site.pub.pem", name));
  }
  expect_ed25519(key.get(), name);
  return SiteKey(std::move(key));
}

std::string SiteKey::sign(const std::string& message) const {
  const Context context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  std::string signature(kSignatureBytes, '\0');
  std::size_t count = signature.size();
  if (!context || EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key_.get()) != 1 ||
      EVP_DigestSign(context.get(), reinterpret_cast<unsigned char*>(signature.data()), &count, bytes_of(message),
                     message.size()) != 1 ||
      count != kSignatureBytes) {
    throw std::runtime_error(tr("OpenSSL did not sign"));
  }
  return signature;
}

bool SiteKey::has_signed(const std::string& message, const std::string& signature) const {
  const Context context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  return signature.size() == kSignatureBytes && context &&
         EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key_.get()) == 1 &&
         EVP_DigestVerify(context.get(), bytes_of(signature), signature.size(), bytes_of(message), message.size()) == 1;
}

std::string SiteKey::public_pem() const {
  const Bio bio(BIO_new(BIO_s_mem()), BIO_free);
  if (!bio || PEM_write_bio_PUBKEY(bio.get(), key_.get()) != 1) throw std::runtime_error(tr("OpenSSL wrote no key"));
  return text_of(bio.get());
}

std::string SiteKey::fingerprint() const {
  const Bio bio(BIO_new(BIO_s_mem()), BIO_free);
  if (!bio || i2d_PUBKEY_bio(bio.get(), key_.get()) != 1) throw std::runtime_error(tr("OpenSSL wrote no key"));
  return sha256_of(text_of(bio.get()));
}

}  // namespace pose_wall::tools::evidence
