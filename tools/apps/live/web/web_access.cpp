// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/web/web_access.hpp"

#include <arpa/inet.h>
#include <crypt.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "apps/live/key_file.hpp"
#include "apps/live/secrets.hpp"
#include "apps/live/web/event_loop.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::size_t kHostNameBytes = 256;   // POSIX: a name has at most 255
constexpr std::size_t kLoginBytesMost = 512;  // "Basic " and a name with its password, in base64

bool is_in_numbers(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
         inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
}

std::string hash_of(const std::string& password, const std::string& setting) {
  crypt_data room{};
  const char* const hash = crypt_r(password.c_str(), setting.c_str(), &room);
  return hash == nullptr || hash[0] == '*' ? "" : hash;
}

// "NAME:HASH", a line each, as `openssl passwd -6` makes the hash.
std::map<std::string, std::string> read_logins(const std::string& file) {
  std::map<std::string, std::string> hashes;
  std::ifstream stream = open_key_file("http_login", file);
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const std::size_t colon = line.find(':');
    const std::string hash = colon == std::string::npos ? "" : line.substr(colon + 1);
    if (colon == 0 || hash.empty() || hash.front() != '$' || hash_of("", hash).empty()) {
      throw std::runtime_error(fmt::format(
          "http_login: {}:{}: NAME:HASH is expected, the hash as `openssl passwd -6` prints it", file, number));
    }
    hashes[line.substr(0, colon)] = hash;
  }
  if (hashes.empty()) throw std::runtime_error(fmt::format("http_login: {}: no line with NAME:HASH is there", file));
  return hashes;
}

void look_at_certificate(const std::string& file) {
  std::ostringstream text;
  text << open_key_file("http_certificate", file).rdbuf();
  for (const char* part : {"-----BEGIN CERTIFICATE-----", "PRIVATE KEY-----"}) {
    if (text.str().find(part) == std::string::npos) {
      throw std::runtime_error(fmt::format(
          "http_certificate: {}: '{}' is missing; the file holds the certificate and its key, as PEM", file, part));
    }
  }
}

}  // namespace

WebAccess::WebAccess(const LiveSettings& live, const HostPort& place)
    : is_loopback_(is_loopback(place.host)), certificate_file_(live.http_certificate) {
  std::array<char, kHostNameBytes> own{};
  if (gethostname(own.data(), own.size() - 1) == 0 && own[0] != '\0') {
    names_.insert(own.data());
    names_.insert(std::string(own.data()) + ".local");  // multicast DNS
  }
  std::istringstream more(live.http_names);
  for (std::string name; more >> name;) names_.insert(name);
  if (!live.http_login.empty()) hashes_ = read_logins(live.http_login);
  if (!certificate_file_.empty()) look_at_certificate(certificate_file_);
}

bool WebAccess::is_own_name(const std::string& host_header) const {
  const std::string host = host_of(host_header);
  if (names_.count(host) > 0 || is_loopback(host)) return true;
  return !is_loopback_ && is_in_numbers(host);
}

WebAccess::Login WebAccess::login(const std::string& authorization, Clock::time_point now) {
  if (hashes_.empty() || known_.count(authorization) > 0) return Login::kGood;
  const std::string kind = "Basic ";
  if (authorization.compare(0, kind.size(), kind) != 0) return Login::kMissing;
  if (now - tried_ < kTryEvery) return Login::kTooOften;
  tried_ = now;
  std::array<char, kLoginBytesMost> decoded{};
  const int length = lws_b64_decode_string(authorization.c_str() + kind.size(), decoded.data(), decoded.size());
  const std::string words(decoded.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
  const std::size_t colon = words.find(':');
  if (colon == std::string::npos) return Login::kWrong;
  // Of a name that nobody has a hash is made all the same, so that the time does not tell names.
  const auto known = hashes_.find(words.substr(0, colon));
  const std::string& right = known == hashes_.end() ? hashes_.begin()->second : known->second;
  if (!is_same_secret(hash_of(words.substr(colon + 1), right), right) || known == hashes_.end()) return Login::kWrong;
  known_.insert(authorization);
  return Login::kGood;
}

}  // namespace pose_wall::tools::live
