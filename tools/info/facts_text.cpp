// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "frames/field_value.hpp"
#include "info/input_facts.hpp"
#include "terminal/counted.hpp"
#include "terminal/text_table.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kSecondsOf2000 = 946'684'800.0;

std::string stamp_text(std::int64_t stamp_ns) {
  const double seconds = static_cast<double>(stamp_ns) * 1e-9;
  std::string text = fmt::format("{:.6f} s", seconds);
  // Before 2000 it counts from the start of something, not from 1970.
  if (seconds > kSecondsOf2000)
    text += fmt::format(" ({:%Y-%m-%d %H:%M:%S} UTC)", fmt::gmtime(stamp_ns / 1'000'000'000));
  return text;
}

void add_stamps(TextTable& table, const StampFacts& stamps, std::size_t frames) {
  if (stamps.count == 0) {
    table.add_row({"stamps", "none: frames follow each other at --rate"});
    return;
  }
  table.add_row(
      {"stamps", fmt::format("{} to {}{}", stamp_text(stamps.first_ns), stamp_text(stamps.last_ns),
                             stamps.count < frames ? fmt::format("; {} frames have none", frames - stamps.count)
                                                   : std::string{})});
  if (stamps.interval_s > 0.0) {
    table.add_row({"rate", fmt::format("{:.2f} Hz (median of the steps), longest step {:.3f} s, {}, {} backwards",
                                       1.0 / stamps.interval_s, stamps.longest_s, counted(stamps.gaps, "gap"),
                                       counted(stamps.backwards, "step"))});
  } else if (stamps.backwards > 0) {
    table.add_row({"rate", fmt::format("unknown, {} backwards", counted(stamps.backwards, "step"))});
  }
}

void add_sensor(TextTable& table, const SensorFacts& sensor) {
  if (sensor.guess.empty()) return;
  table.add_row({"rings", sensor.rings > 0 ? fmt::format("{} (by {})", sensor.rings, sensor.rings_by) : "none found"});
  table.add_row({"view", fmt::format("elevation {:.1f}° to {:.1f}°, {:.0f}° of azimuth, about the sensor's axes",
                                     sensor.elevation_min_deg, sensor.elevation_max_deg, sensor.azimuth_span_deg)});
  table.add_row({"looks like", sensor.guess});
}

std::string points_text(std::vector<std::uint32_t> points) {
  std::sort(points.begin(), points.end());
  return fmt::format("{} min, {} median, {} max a frame", points.front(), points[points.size() / 2], points.back());
}

std::string fields_text(const InputFacts& facts) {
  TextTable table({"field", "type", "understood as", "byte"});
  for (const FieldFacts& field : facts.fields()) {
    const std::string role = field.role.empty() ? "(passed over)" : field.role;
    table.add_row({field.name, std::string(field_type_name(field.type)),
                   field.note.empty() ? role : role + ": " + field.note, std::to_string(field.offset)});
  }
  return table.text(3);
}

std::string topics_text(const SourceAbout& about) {
  TextTable table({"topic", "type", "", "messages"});
  for (const SourceTopic& topic : about.topics) {
    table.add_row(
        {topic.name, topic.type, topic.name == about.topic ? "looked at" : "", std::to_string(topic.messages)});
  }
  return table.text(3);
}

}  // namespace

std::string facts_text(const SourceAbout& about, const InputFacts& facts) {
  TextTable table({"", ""});
  table.add_row({"kind", about.kind});
  table.add_row({"frames", facts.unreadable() == 0
                               ? std::to_string(facts.frames())
                               : fmt::format("{}, {} of them unreadable", facts.frames(), facts.unreadable())});
  if (!facts.points().empty()) {
    table.add_row({"points", points_text(facts.points())});
    table.add_row({"layout", facts.layout()});
    add_stamps(table, facts.stamps(), facts.points().size());
    if (const std::optional<RangeFacts> ranges = facts.ranges()) {
      table.add_row({"ranges", fmt::format("{:.2f} m min, {:.2f} m median, {:.2f} m max", ranges->min_m,
                                           ranges->median_m, ranges->max_m)});
    }
    table.add_row({"no return", fmt::format("{:.1f} % at zero, {:.1f} % not finite", 100.0 * facts.zero_share(),
                                            100.0 * facts.not_finite_share())});
    add_sensor(table, facts.sensor());
  }
  std::string text = table.text(2);
  text.erase(0, text.find('\n', text.find('\n') + 1) + 1);  // neither head nor rule
  if (!about.topics.empty()) text += '\n' + topics_text(about);
  if (!facts.fields().empty()) text += '\n' + fields_text(facts);
  if (facts.other_layouts() > 0) {
    text += fmt::format("{} with other fields than the first\n", counted(facts.other_layouts(), "frame"));
  }
  return text;
}

}  // namespace pose_wall::tools
