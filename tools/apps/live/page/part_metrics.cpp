// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/page/part_metrics.hpp"

#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>

#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {
namespace {

// What of the facts has a name of its own, which stays when facts get other names.
struct Stable {
  const char *fact, *name, *type, *help;
  const char* label = nullptr;  // its value is the part's kind, without "sink"
  double factor = 1.0;
};

constexpr Stable kStable[] = {
    {"packets", "pose_wall_packets_received", "counter", "Packets that came by UDP, of whatever sender."},
    {"packets of no use", "pose_wall_packets_useless", "counter", "Packets that are none of the sensor's."},
    {"packets lost by the kernel", "pose_wall_packets_lost_by_kernel", "counter",
     "Packets that came faster than they were read."},
    {"packets lost on the way", "pose_wall_packets_lost_on_the_way", "counter",
     "Packets that are missing by their numbers."},
    {"results lost to slowness", "pose_wall_results_lost", "counter", "Results that a slow sink did not take.", "sink"},
    {"results recorded", "pose_wall_results_recorded", "counter", "Results that the recorder wrote."},
    {"results not recorded", "pose_wall_results_not_recorded", "counter",
     "Results that the recorder could not write: its disk is full or gone."},
    {"messages acknowledged", "pose_wall_mqtt_messages_acknowledged", "counter", "Messages that the broker took."},
    {"messages not sent", "pose_wall_mqtt_messages_not_sent", "counter",
     "Messages that were due while the broker was away or behind."},
    {"frames lost to slowness", "pose_wall_stop_frames_lost", "counter", "Frames that the obstacle stop did not see."},
    {"frames refused", "pose_wall_stop_frames_refused", "counter", "Frames of which the obstacle stop made no use."},
    {"disk free MB", "pose_wall_recording_disk_free_bytes", "gauge", "Room on the disk of the recordings.", nullptr,
     kBytesPerMb},
    {"black box disk free MB", "pose_wall_black_box_disk_free_bytes", "gauge", "Room on the disk of the black box.",
     nullptr, kBytesPerMb},
    {"waiting", "pose_wall_settings_waiting", "gauge", "Settings of the file that wait for a restart."},
    {"refused", "pose_wall_settings_refused", "gauge", "1: the file was refused when it was last read."},
};

// Nothing where the text is no number as a whole.
std::optional<double> number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_whole = !text.empty() && end == text.c_str() + text.size();
  return is_whole && std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

// Of the parts in question: another one may have a fact of the same name.
bool is_of(const PartHealth& part, const Stable& stable) {
  const std::string name = stable.name, kind = part.kind();
  const auto is_about = [&name](const char* what) { return name.rfind(what, 0) == 0; };
  if (is_about("pose_wall_settings_")) return kind == "settings";
  if (is_about("pose_wall_packets_")) return kind == "source udp";
  if (is_about("pose_wall_mqtt_")) return kind == "sink mqtt";
  if (is_about("pose_wall_stop_")) return kind == "planar stop";
  return true;
}

OpenMetrics::Labels of_part(const PartHealth& part) {
  OpenMetrics::Labels labels = {{"part", part.kind()}};
  if (!part.place().empty()) labels.emplace_back("place", part.place());
  return labels;
}

}  // namespace

void add_stable_metrics(OpenMetrics* metrics, const std::vector<PartHealth>& parts) {
  for (const Stable& stable : kStable) {
    std::map<std::string, double> sums;  // by the label; of two parts of one kind both
    for (const PartHealth& part : parts) {
      if (!is_of(part, stable)) continue;
      const std::string kind = part.kind(), sink = kind.rfind("sink ", 0) == 0 ? kind.substr(5) : kind;
      for (const auto& [name, value] : part.facts) {
        if (name != stable.fact) continue;
        if (const std::optional<double> number = number_in(value)) {
          sums[stable.label != nullptr ? sink : ""] += *number * stable.factor;
        }
      }
    }
    if (sums.empty()) continue;
    const std::string name = stable.name, type = stable.type;
    const bool is_bytes = name.size() > 6 && name.compare(name.size() - 6, 6, "_bytes") == 0;
    metrics->family(name, stable.type, is_bytes ? "bytes" : "", stable.help);
    for (const auto& [label, sum] : sums) {
      const OpenMetrics::Labels labels =
          stable.label != nullptr ? OpenMetrics::Labels{{stable.label, label}} : OpenMetrics::Labels{};
      metrics->sample(labels, sum, type == "counter" ? "_total" : "");
    }
  }
}

void add_part_metrics(OpenMetrics* metrics, const std::vector<PartHealth>& parts) {
  metrics->family("pose_wall_part_grade", "stateset", "", "How each part of the daemon fares.");
  const std::vector<std::string> grades = {grade_name(Grade::kGood), grade_name(Grade::kWarning),
                                           grade_name(Grade::kBad), grade_name(Grade::kStale)};
  std::map<OpenMetrics::Labels, std::map<std::string, double>> facts;  // each once, whatever a part says
  for (const PartHealth& part : parts) {
    const auto [facts_of, is_new] = facts.try_emplace(of_part(part));
    if (!is_new) continue;
    metrics->states(of_part(part), grades, grade_name(part.grade));
    for (const auto& [name, value] : part.facts) {
      if (const std::optional<double> number = number_in(value)) facts_of->second[name] = *number;
    }
  }
  metrics->family("pose_wall_part_fact", "unknown", "", "Counts and numbers of each part, as /health has them.");
  for (const auto& [part, numbers] : facts) {
    for (const auto& [name, number] : numbers) {
      OpenMetrics::Labels labels = part;
      labels.emplace_back("fact", name);
      metrics->sample(labels, number);
    }
  }
}

}  // namespace pose_wall::tools::live
