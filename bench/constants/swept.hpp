// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// In the copy that sweep.py makes, each swept constant is what this returns: the value of the sources, or another one
// that the environment names. No part of what is delivered.
//
//   POSE_WALL_SWEPT       NAME=half, NAME=twice or NAME=NUMBER; all other constants keep their values
//   POSE_WALL_SWEPT_LOG   a file that gets a line for each constant that is read: name, the sources' value, value taken

#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>

namespace pose_wall_swept {

// A whole number changes by one at least.
template <typename T>
double changed(T value, const char* how) {
  const auto was = static_cast<double>(value);
  const bool half = std::strcmp(how, "half") == 0, twice = std::strcmp(how, "twice") == 0;
  if (!half && !twice) return std::strtod(how, nullptr);
  const double now = half ? 0.5 * was : 2.0 * was;
  if (!std::is_integral_v<T>) return now;
  const double rounded = std::round(now);
  return rounded != was ? rounded : was + (half ? -1.0 : 1.0);
}

template <typename T>
T swept(const char* name, T value) {
  T taken = value;
  const char* asked = std::getenv("POSE_WALL_SWEPT");
  const std::size_t length = std::strlen(name);
  if (asked != nullptr && std::strncmp(asked, name, length) == 0 && asked[length] == '=') {
    taken = static_cast<T>(changed(value, asked + length + 1));
  }
  const char* log = std::getenv("POSE_WALL_SWEPT_LOG");
  std::FILE* file = log != nullptr ? std::fopen(log, "a") : nullptr;
  if (file != nullptr) {
    std::fprintf(file, "%s %.9g %.9g\n", name, static_cast<double>(value), static_cast<double>(taken));
    std::fclose(file);
  }
  return taken;
}

}  // namespace pose_wall_swept
