// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/terminal/progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>

namespace pose_wall::tools {
namespace {

constexpr std::size_t kBarCells = 30;
constexpr std::size_t kNoteMax = 32;

}  // namespace

bool is_terminal(int stream) {
  return ::isatty(stream) == 1;
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::uint64_t>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

ProgressBar::ProgressBar(std::size_t total, bool enabled, const char* unit)
    : total_(total), enabled_(enabled), unit_(unit) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::advance(const std::string& note) {
  ++done_;
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (done_ < total_ && drawn_ && now - drawn_at_ < std::chrono::milliseconds(100)) return;
  drawn_at_ = now;
  draw(note);
}

void ProgressBar::print_above(const std::string& line) {
  clear();
  fmt::print(stderr, "{}\n", line);
}

void ProgressBar::draw(const std::string& note) {
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - started_).count();
  const double per_second = elapsed_s > 0.0 ? static_cast<double>(done_) / elapsed_s : 0.0;
  const double left_s = per_second > 0.0 ? static_cast<double>(total_ - done_) / per_second : 0.0;
  const std::size_t filled = total_ > 0 ? kBarCells * done_ / total_ : kBarCells;
  std::string bar;
  for (std::size_t i = 0; i < kBarCells; ++i) bar += i < filled ? "█" : "░";
  fmt::print(stderr, "\r\x1b[K{} {}/{}  {}  {}", bar, done_, total_,
             say("{:.1f} {}/s  {} left", per_second, tr(unit_), duration_text(left_s)), note.substr(0, kNoteMax));
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::clear() {
  if (!drawn_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace pose_wall::tools
