// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/commissioning/door.hpp"

#include <sys/random.h>

#include <array>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include "apps/live/secrets.hpp"

namespace pose_wall::tools::live {
namespace {

// 32 letters: five bits of each byte choose one evenly. Without those that people take for one another (0 O, 1 I).
constexpr std::string_view kLetters = "23456789ABCDEFGHJKLMNPQRSTUVWXYZ";
constexpr std::size_t kCodeLetters = 10, kTokenLetters = 26;  // 50 bits for a person to type, 130 for a program

std::string random_letters(std::size_t count) {
  std::array<unsigned char, kTokenLetters> bytes{};
  if (getrandom(bytes.data(), count, 0) != static_cast<ssize_t>(count)) {
    throw std::runtime_error("commissioning: the system gives no random numbers");
  }
  std::string letters;
  for (std::size_t i = 0; i < count; ++i) letters += kLetters[bytes[i] % kLetters.size()];
  return letters;
}

std::string new_code() {
  const std::string letters = random_letters(kCodeLetters);
  return letters.substr(0, kCodeLetters / 2) + "-" + letters.substr(kCodeLetters / 2);
}

std::string letters_of(const std::string& text) {
  std::string letters;
  for (const char one : text) {
    if (one != '-' && one != ' ') letters += static_cast<char>(std::toupper(static_cast<unsigned char>(one)));
  }
  return letters;
}

}  // namespace

Door::Door() : code_(new_code()) {}

Door::Try Door::open(const std::string& code, Clock::time_point now) {
  if (now - tried_ < kTryEvery) return Try::kTooOften;
  tried_ = now;
  if (!is_same_secret(letters_of(code), letters_of(code_))) return Try::kWrong;
  code_ = new_code();
  token_ = random_letters(kTokenLetters);
  seen_ = now;
  return Try::kOpened;
}

bool Door::admits(const std::string& token, bool is_at_work, Clock::time_point now) {
  if (now - seen_ > kIdleMost) token_.clear();
  if (token_.empty() || !is_same_secret(token, token_)) return false;
  if (is_at_work) seen_ = now;
  return true;
}

}  // namespace pose_wall::tools::live
