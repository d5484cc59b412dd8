// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/frame_stamps.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace pose_wall::tools {

namespace {

constexpr std::size_t kSecondsDigits = 10;  // since 1970, of 2001 to 2286
constexpr std::size_t kNanosecondDigits = 9;
// What is left for the fraction of a float64 of such seconds: a program that writes those drops zeros at the end.
constexpr std::size_t kFloatDigits = 7;

bool are_digits(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::optional<std::int64_t> number_of(std::string_view digits) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

// YYYYMMDDhhmmss and milliseconds: as nanoseconds such names would lie microseconds apart.
bool is_calendar_date(std::string_view digits) {
  constexpr std::size_t kDigits = 17;
  if (digits.size() != kDigits || (digits.substr(0, 2) != "19" && digits.substr(0, 2) != "20")) return false;
  const auto part = [digits](std::size_t from) { return *number_of(digits.substr(from, 2)); };
  return part(4) >= 1 && part(4) <= 12 && part(6) >= 1 && part(6) <= 31 && part(8) <= 23 && part(10) <= 59 &&
         part(12) <= 60;
}

std::optional<std::int64_t> whole_stamp_ns(std::string_view digits) {
  constexpr std::size_t kMsDigits = 13, kUsDigits = 16, kNsDigitsMax = 19;
  const bool is_padded = digits.front() == '0';
  if (digits.size() > kNsDigitsMax || is_calendar_date(digits)) return std::nullopt;
  if (digits.size() > kUsDigits) return number_of(digits);
  if (is_padded || (digits.size() != kMsDigits && digits.size() != kUsDigits)) return std::nullopt;
  return *number_of(digits) * (digits.size() == kMsDigits ? 1'000'000 : 1'000);
}

struct SplitName {
  std::string seconds, fraction;
};

// "1700000000.25"
std::optional<SplitName> split_name(const std::string& name) {
  if (name.size() < kSecondsDigits + 2 || name[kSecondsDigits] != '.' || name.front() == '0') return std::nullopt;
  SplitName split{name.substr(0, kSecondsDigits), name.substr(kSecondsDigits + 1)};
  if (!are_digits(split.seconds) || !are_digits(split.fraction)) return std::nullopt;
  return split;
}

}  // namespace

void NameStamps::add(const std::filesystem::path& path) {
  const std::optional<SplitName> split = split_name(path.stem().string());
  if (!split) return;
  const std::string& fraction = split->fraction;
  shortest_ = longest_ == 0 ? fraction.size() : std::min(shortest_, fraction.size());
  longest_ = std::max(longest_, fraction.size());
  begins_with_zero_ = begins_with_zero_ || (fraction.size() > 1 && fraction.front() == '0');
  ends_with_zero_ = ends_with_zero_ || (fraction.size() > 1 && fraction.back() == '0');
}

// A number that is not padded begins with no zero; a fraction without zeros at its end, with none there.
bool NameStamps::are_unpadded() const {
  if (shortest_ == longest_ || longest_ > kNanosecondDigits || begins_with_zero_) return false;
  return ends_with_zero_ || longest_ > kFloatDigits;
}

std::optional<std::int64_t> NameStamps::of(const std::filesystem::path& path) const {
  const std::string name = path.stem().string();
  if (are_digits(name)) return whole_stamp_ns(name);
  const std::optional<SplitName> split = split_name(name);
  if (!split) return std::nullopt;
  std::string fraction = split->fraction.substr(0, kNanosecondDigits);
  if (!are_unpadded()) fraction.append(kNanosecondDigits - fraction.size(), '0');
  return *number_of(split->seconds) * 1'000'000'000 + *number_of(fraction);
}

std::optional<std::int64_t> stamp_from_name(const std::filesystem::path& path) {
  NameStamps one;
  one.add(path);
  return one.of(path);
}

double seconds_between(std::int64_t from_ns, std::int64_t to_ns) {
  std::int64_t step_ns = 0;
  if (!__builtin_sub_overflow(to_ns, from_ns, &step_ns)) return static_cast<double>(step_ns) * 1e-9;
  return static_cast<double>(to_ns) * 1e-9 - static_cast<double>(from_ns) * 1e-9;
}

std::int64_t FrameStamps::next(const std::optional<std::int64_t>& stamp_ns) {
  if (stamp_ns) {
    base_ns_ = *stamp_ns;
    frames_since_base_ = 1;
    return base_ns_;
  }
  return base_ns_ + std::llround(static_cast<double>(frames_since_base_++) * 1e9 / rate_hz_);
}

}  // namespace pose_wall::tools
