// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "live/log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>

namespace pose_wall::tools::live {
namespace {

// sd-daemon(3): a line may begin with its syslog level.
const char* journal_level(Grade grade) {
  switch (grade) {
    case Grade::kGood:
      return "<6>";
    case Grade::kWarning:
      return "<4>";
    default:
      return "<3>";
  }
}

// Of today, in UTC, to the millisecond.
std::string time_text() {
  const auto now = std::chrono::system_clock::now();
  const auto since_epoch_ms = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count();
  const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z ", parts, since_epoch_ms % 1000);
}

// Names and messages of others must not forge lines.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  return text;
}

}  // namespace

const char* grade_name(Grade grade) {
  switch (grade) {
    case Grade::kGood:
      return "ok";
    case Grade::kWarning:
      return "warning";
    case Grade::kBad:
      return "error";
    case Grade::kStale:
      return "stale";
  }
  return "?";
}

void log_line(Grade grade, const std::string& part, const std::string& fact) {
  static const bool to_journal = std::getenv("JOURNAL_STREAM") != nullptr;
  const std::string line =
      fmt::format("{}{}{}: {}\n", to_journal ? journal_level(grade) : time_text(),
                  to_journal ? "" : fmt::format("{:7} ", grade_name(grade)), one_line(part), one_line(fact));
  // One call, so that threads do not mix their lines. A log that cannot be written is nothing to stop for.
  const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
  static_cast<void>(written);
}

void HealthLog::note(const std::vector<PartHealth>& parts) {
  for (const PartHealth& part : parts) {
    const auto known =
        std::find_if(last_.begin(), last_.end(), [&](const PartHealth& before) { return before.part == part.part; });
    const bool is_news = known == last_.end() || known->grade != part.grade || known->summary != part.summary;
    if (is_news) log_line(part.grade, part.part, part.summary);
  }
  last_ = parts;
}

}  // namespace pose_wall::tools::live
