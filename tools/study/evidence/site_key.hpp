// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Keys of Ed25519 and what they sign, as `openssl pkeyutl -rawin` does.

#pragma once

#include <memory>
#include <string>

struct evp_pkey_st;

namespace pose_wall::tools::evidence {

constexpr std::size_t kSignatureBytes = 64;  // of Ed25519, RFC 8032

// Either half of a key.
class SiteKey {
 public:
  // With the private half, from a PEM. One with a passphrase asks for it at the terminal. Throws
  // std::invalid_argument, also for a key of another kind, and then tells how to make one.
  static SiteKey to_sign(const std::string& file);
  // The public half, from a PEM. Throws std::invalid_argument.
  static SiteKey to_verify(const std::string& file);
  // Likewise from the bytes of one. `name`: where they come from.
  static SiteKey of_public_pem(const std::string& pem, const std::string& name);

  std::string sign(const std::string& message) const;
  bool has_signed(const std::string& message, const std::string& signature) const;

  // The one PEM that a public key has, and SHA-256 of its DER, in hexadecimal.
  std::string public_pem() const;
  std::string fingerprint() const;

 private:
  explicit SiteKey(std::shared_ptr<evp_pkey_st> key) : key_(std::move(key)) {}

  std::shared_ptr<evp_pkey_st> key_;
};

}  // namespace pose_wall::tools::evidence
