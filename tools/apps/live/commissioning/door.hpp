// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Who may commission: one page at a time, opened by a code that stands in the log alone. Who reads the log stands at
// the machine, or is let in there.

#pragma once

#include <chrono>
#include <string>

namespace pose_wall::tools::live {

class Door {
 public:
  using Clock = std::chrono::steady_clock;

  // Of 2^50 codes nobody guesses one at this pace.
  static constexpr auto kTryEvery = std::chrono::milliseconds(500);
  // A tablet that was put down keeps nobody else's page shut.
  static constexpr auto kIdleMost = std::chrono::hours(1);

  Door();

  // "K7QF-93MD". Each opens one page, and is then replaced.
  const std::string& code() const { return code_; }

  enum class Try { kOpened, kWrong, kTooOften };
  // Blanks, hyphens and small letters do not matter. A page that was open before is shut.
  Try open(const std::string& code, Clock::time_point now = Clock::now());
  // By what the opened page shows with each request. Empty while none is open.
  const std::string& token() const { return token_; }
  // is_at_work: the hour begins anew.
  bool admits(const std::string& token, bool is_at_work, Clock::time_point now = Clock::now());

 private:
  std::string code_, token_;
  Clock::time_point tried_{}, seen_{};
};

}  // namespace pose_wall::tools::live
