// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// OpenMetrics 1.0 as text. Debian's prometheus-cpp 1.0.1 writes the older text of Prometheus (0.0.4): no `# EOF`, no
// units, no sets of states, no info.

#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pose_wall::tools::live {

class OpenMetrics {
 public:
  using Labels = std::vector<std::pair<std::string, std::string>>;

  static constexpr const char* kType = "application/openmetrics-text; version=1.0.0; charset=utf-8";

  // type: "gauge", "counter", "summary", "info", "stateset", "unknown". unit: the end of the name, or empty. The
  // samples that follow are of this family; each name and each set of labels comes once.
  void family(const std::string& name, const char* type, const char* unit, const char* help);
  // A number that is none is left out: a scraper then has no value instead of an old one.
  void sample(const Labels& labels, double value, const char* suffix = "");
  void count(const Labels& labels, std::uint64_t value, const char* suffix = "_total");
  // Of a stateset: the one that holds gets 1, the others 0.
  void states(const Labels& labels, const std::vector<std::string>& all, const std::string& now);

  // With its end. Nothing may be added behind it.
  std::string text() &&;

 private:
  void line(const Labels& labels, const std::string& value, const char* suffix);

  std::string text_, name_;
};

}  // namespace pose_wall::tools::live
