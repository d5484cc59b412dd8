// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Numbers for monitors as OpenMetrics 1.0, or as the older text of Prometheus (0.0.4), which knows no `# EOF`, no
// units, no sets of states and no info. Debian's prometheus-cpp 1.0.1 writes the older one alone.

#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pose_wall::tools::live {

enum class MetricsFormat { kOpenMetrics, kText };

// By the header Accept: the older text for who asks for text/plain, and names OpenMetrics nowhere.
MetricsFormat metrics_format(const std::string& accept);
// The header Content-Type.
const char* metrics_type(MetricsFormat format);

class OpenMetrics {
 public:
  using Labels = std::vector<std::pair<std::string, std::string>>;

  explicit OpenMetrics(MetricsFormat format) : format_(format) {}

  // type: "gauge", "counter", "histogram", "summary", "info", "stateset", "unknown". unit: the end of the name, or
  // empty. The samples that follow are of this family; each name and each set of labels comes once.
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

  MetricsFormat format_;
  std::string text_, name_;
};

}  // namespace pose_wall::tools::live
