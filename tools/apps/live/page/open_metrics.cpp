// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/page/open_metrics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/json/json_words.hpp"

namespace pose_wall::tools::live {
namespace {

// Names of folders and messages of others come in labels. One byte that is no UTF-8 would cost the whole scrape.
std::string escaped(const std::string& text) {
  std::string escaped;
  for (const char letter : Json::parse(json_text(text)).get<std::string>()) {
    if (letter == '\\' || letter == '"') escaped += '\\';
    if (letter == '\n') {
      escaped += "\\n";
    } else if (static_cast<unsigned char>(letter) >= 0x20) {
      escaped += letter;
    }
  }
  return escaped;
}

// The older text names a family as its samples, and has no type for these.
std::pair<std::string, const char*> as_text(const std::string& name, const std::string& type) {
  if (type == "counter") return {name + "_total", "counter"};
  if (type == "info") return {name + "_info", "gauge"};
  if (type == "stateset") return {name, "gauge"};
  return {name, type == "gauge"       ? "gauge"
                : type == "histogram" ? "histogram"
                : type == "summary"   ? "summary"
                                      : "untyped"};
}

}  // namespace

MetricsFormat metrics_format(const std::string& accept) {
  const bool wants_text = accept.find("text/plain") != std::string::npos;
  const bool knows_open = accept.find("application/openmetrics-text") != std::string::npos;
  return wants_text && !knows_open ? MetricsFormat::kText : MetricsFormat::kOpenMetrics;
}

const char* metrics_type(MetricsFormat format) {
  return format == MetricsFormat::kText ? "text/plain; version=0.0.4; charset=utf-8"
                                        : "application/openmetrics-text; version=1.0.0; charset=utf-8";
}

void OpenMetrics::family(const std::string& name, const char* type, const char* unit, const char* help) {
  name_ = name;
  if (format_ == MetricsFormat::kText) {
    const auto [told, kind] = as_text(name, type);
    text_ += fmt::format("# HELP {} {}\n# TYPE {} {}\n", told, escaped(help), told, kind);
    return;
  }
  text_ += fmt::format("# TYPE {} {}\n", name, type);
  if (*unit != '\0') text_ += fmt::format("# UNIT {} {}\n", name, unit);
  text_ += fmt::format("# HELP {} {}\n", name, escaped(help));
}

void OpenMetrics::sample(const Labels& labels, double value, const char* suffix) {
  if (std::isfinite(value)) line(labels, fmt::format("{}", value), suffix);
}

void OpenMetrics::count(const Labels& labels, std::uint64_t value, const char* suffix) {
  line(labels, std::to_string(value), suffix);
}

void OpenMetrics::states(const Labels& labels, const std::vector<std::string>& all, const std::string& now) {
  for (const std::string& state : all) {
    Labels with = labels;
    with.emplace_back(name_, state);
    line(with, state == now ? "1" : "0", "");
  }
}

void OpenMetrics::line(const Labels& labels, const std::string& value, const char* suffix) {
  text_ += name_ + suffix;
  const char* before = "{";
  for (const auto& [name, text] : labels) {
    text_ += fmt::format("{}{}=\"{}\"", before, name, escaped(text));
    before = ",";
  }
  text_ += fmt::format("{} {}\n", labels.empty() ? "" : "}", value);
}

std::string OpenMetrics::text() && {
  if (format_ == MetricsFormat::kOpenMetrics) text_ += "# EOF\n";
  return std::move(text_);
}

}  // namespace pose_wall::tools::live
