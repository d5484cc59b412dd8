// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <ctime>

#include "apps/live/health_words.hpp"
#include "io/language/retold.hpp"

namespace pose_wall::tools::live {
namespace {

// Of one part in one window: a start and a short loss are told whole, a machine that cannot keep up is not.
constexpr int kSameMost = 3;
// A part has some five ways to fare; words that are always others, as of errors with a number, stop here.
constexpr std::size_t kSummariesMost = 8;

std::atomic<Grade> least_grave{Grade::kGood};

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

// How many bytes the UTF-8 character at `at` has; 0 where there is none (RFC 3629, 4, but for the overlong ones).
std::size_t character_bytes(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(at);
  const std::size_t bytes = first < 0x80                    ? 1
                            : first >= 0xC2 && first < 0xE0 ? 2
                            : first >= 0xE0 && first < 0xF0 ? 3
                            : first >= 0xF0 && first < 0xF5 ? 4
                                                            : 0;
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return 0;
  }
  return bytes;
}

// Names and messages of others must not forge lines, nor break who reads the log as text.
std::string one_line(const std::string& text) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = character_bytes(text, at);
    const bool is_control = static_cast<unsigned char>(text[at]) < 0x20 || text[at] == 0x7F;
    if (bytes == 0 || is_control) {
      line += bytes == 0 ? '?' : ' ';
      ++at;
    } else {
      line.append(text, at, bytes);
      at += bytes;
    }
  }
  return line;
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

void set_log_level(Grade least) {
  least_grave = least;
}

Grade log_level_of(const std::string& name) {
  return name == "error" ? Grade::kBad : name == "warning" ? Grade::kWarning : Grade::kGood;
}

void log_line(Grade grade, const std::string& part, const std::string& fact) {
  if (grade >= least_grave.load()) log_anyway(grade, part, fact);
}

void log_anyway(Grade grade, const std::string& part, const std::string& fact) {
  static const bool to_journal = std::getenv("JOURNAL_STREAM") != nullptr;
  const std::string line = fmt::format("{}{}{}: {}\n", to_journal ? journal_level(grade) : time_text(),
                                       to_journal ? "" : fmt::format("{:7} ", grade_words(language(), grade)),
                                       one_line(part_words(language(), part)), one_line(retold(language(), fact)));
  // One call, so that threads do not mix their lines. A log that cannot be written is nothing to stop for.
  const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
  static_cast<void>(written);
}

void HealthLog::note(const std::vector<PartHealth>& parts, Clock::time_point now) {
  for (const PartHealth& part : parts) {
    const auto [known, is_new] = courses_.try_emplace(part.part);
    Course& course = known->second;
    if (is_new) course.window_began = now;
    if (now - course.window_began >= kWindow) end_window(&course, now);
    if (is_new || !course.last.fares_as(part)) note_change(part, &course);
    course.last = part;
  }
}

void HealthLog::note_change(const PartHealth& part, Course* course) {
  course->has_changed = true;
  const auto said = course->told.find(part.summary);
  const bool is_new = said == course->told.end() && course->told.size() < kSummariesMost;
  const bool is_told = is_new || (said != course->told.end() && !course->is_damped && said->second < kSameMost);
  if (is_told) {
    ++course->told[part.summary];
    write_(part.grade, part.part, part.summary);
    return;
  }
  ++course->untold;
  if (std::exchange(course->is_damped, true)) return;
  write_(part.grade, part.part,
         fmt::format("{}; it goes to and fro: from here on one line sums up {} s", part.summary, kWindow.count()));
}

// A window without a change ends the damping; what was said stays known as long as it lasts.
void HealthLog::end_window(Course* course, Clock::time_point now) {
  course->window_began = now;
  const bool rests = !std::exchange(course->has_changed, false);
  const std::uint64_t untold = std::exchange(course->untold, 0);
  if (untold > 0) {
    write_(course->last.grade, course->last.part,
           fmt::format("{}; changed {} more times in {} s", course->last.summary, untold, kWindow.count()));
    return;
  }
  if (!rests) return;
  if (std::exchange(course->is_damped, false)) {
    write_(course->last.grade, course->last.part, fmt::format("{}; it rests", course->last.summary));
  }
  course->told.clear();
}

}  // namespace pose_wall::tools::live
