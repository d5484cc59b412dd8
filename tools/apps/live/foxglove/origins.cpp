// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/foxglove/origins.hpp"

#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {
namespace {

// Where Foxglove's own page lies: https://docs.foxglove.dev.
constexpr const char* kFoxglove = "https://app.foxglove.dev";
// Of programs for the desktop, which are pages from files. A page in a browser has "null" there, as foreign frames
// have.
constexpr const char* kDesktop = "file://";

std::string host_of(const std::string& origin) {
  const std::size_t scheme = origin.find("://");
  if (scheme == std::string::npos) return "";
  const std::string place = origin.substr(scheme + 3);
  if (!place.empty() && place.front() == '[') {
    const std::size_t end = place.find(']');
    return end == std::string::npos ? "" : place.substr(1, end - 1);
  }
  return place.substr(0, place.find(':'));
}

}  // namespace

bool is_admitted_origin(const std::string& origin, const std::string& named) {
  if (origin.empty() || origin == kDesktop || origin == kFoxglove) return true;
  return is_loopback(host_of(origin)) || (!named.empty() && origin == named);
}

}  // namespace pose_wall::tools::live
