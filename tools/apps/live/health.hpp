// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How a part of the daemon is doing, in the words of /diagnostics: a grade, a summary and facts. The same go into the
// log, the page and the diagnostics of ROS.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pose_wall::tools::live {

// As diagnostic_msgs/DiagnosticStatus numbers them.
enum class Grade : std::uint8_t { kGood = 0, kWarning = 1, kBad = 2, kStale = 3 };

const char* grade_name(Grade grade);

// A thread that is at one thing for so long does not come back, and a new start may mend it: a frame takes 0.2 s at
// most on the slowest controller (bench/README.md).
constexpr std::int64_t kHangs_ns = 10'000'000'000;

struct PartHealth {
  std::string part;  // "source udp 127.0.0.1:2368", "sink modbus 127.0.0.1:502"
  Grade grade = Grade::kGood;
  std::string summary;  // one sentence; it changes only when something happens, for each change is a line of the log
  std::vector<std::pair<std::string, std::string>> facts;  // names and values: "frames" "1203"
  // Of facts whose value is more than a word and a number: the same value in Chinese, by the fact's name.
  std::map<std::string, std::string> chinese_facts = {};

  // "sink mqtt" of "sink mqtt 127.0.0.1:1883": its first two words.
  std::string kind() const { return part.substr(0, end_of_kind()); }
  // What follows: an address, a path, a topic; may be empty.
  std::string place() const {
    const std::size_t end = end_of_kind();
    return end == std::string::npos ? "" : part.substr(end + 1);
  }

  // Facts aside, which change all the time.
  bool fares_as(const PartHealth& other) const {
    return part == other.part && grade == other.grade && summary == other.summary;
  }
  void add(const std::string& name, std::uint64_t count) { facts.emplace_back(name, std::to_string(count)); }
  void add(const std::string& name, const std::string& value) { facts.emplace_back(name, value); }

 private:
  std::size_t end_of_kind() const {
    const std::size_t first = part.find(' ');
    return first == std::string::npos ? first : part.find(' ', first + 1);
  }
};

}  // namespace pose_wall::tools::live
