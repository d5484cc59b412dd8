// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "part/number_text.hpp"

#include <cstdint>

namespace pose_wall {
namespace {

constexpr int kDigitsKept = 18;  // as many as fit a uint64

struct Mantissa {
  std::uint64_t digits = 0;
  int kept = 0;
  int exponent = 0;  // power of ten that digits stands for
  bool any = false;
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

void read_digits(const char** cursor, bool behind_point, Mantissa* mantissa) {
  for (; is_digit(**cursor); ++*cursor) {
    mantissa->any = true;
    if (mantissa->kept < kDigitsKept) {
      mantissa->digits = mantissa->digits * 10 + static_cast<std::uint64_t>(**cursor - '0');
      if (mantissa->digits != 0) ++mantissa->kept;
      if (behind_point) --mantissa->exponent;
    } else if (!behind_point) {
      ++mantissa->exponent;
    }
  }
}

// An 'e' without digits behind it is not part of the number.
int read_exponent(const char** cursor) {
  const char* at = *cursor;
  if (*at != 'e' && *at != 'E') return 0;
  ++at;
  const bool negative = *at == '-';
  if (*at == '-' || *at == '+') ++at;
  if (!is_digit(*at)) return 0;
  int exponent = 0;
  for (; is_digit(*at); ++at) {
    if (exponent < 10000) exponent = exponent * 10 + (*at - '0');
  }
  *cursor = at;
  return negative ? -exponent : exponent;
}

double scaled(double value, int exponent) {
  constexpr int kLimit = 400;  // beyond any double: ends as 0 or infinity, which no key's range holds
  if (exponent > kLimit) exponent = kLimit;
  if (exponent < -kLimit) exponent = -kLimit;
  double power = 1.0;
  for (int i = 0; i < (exponent < 0 ? -exponent : exponent); ++i) {
    power *= 10.0;
    if (power >= 1e22) {  // the last exact power: apply and start over
      value = exponent < 0 ? value / power : value * power;
      power = 1.0;
    }
  }
  return exponent < 0 ? value / power : value * power;
}

}  // namespace

void skip_spaces(const char** cursor) {
  while (**cursor == ' ' || **cursor == '\t') ++*cursor;
}

bool read_number(const char** cursor, double* value) {
  const char* at = *cursor;
  const bool negative = *at == '-';
  if (*at == '-' || *at == '+') ++at;
  Mantissa mantissa;
  read_digits(&at, false, &mantissa);
  if (*at == '.') {
    ++at;
    read_digits(&at, true, &mantissa);
  }
  if (!mantissa.any) return false;
  const int exponent = mantissa.exponent + read_exponent(&at);
  const double magnitude = scaled(static_cast<double>(mantissa.digits), exponent);
  *value = negative ? -magnitude : magnitude;
  *cursor = at;
  return true;
}

bool whole_number_text(const char* text, double* value) {
  const char* at = text;
  skip_spaces(&at);
  double read = 0.0;
  if (!read_number(&at, &read)) return false;
  skip_spaces(&at);
  if (*at != '\0') return false;
  *value = read;
  return true;
}

}  // namespace pose_wall
