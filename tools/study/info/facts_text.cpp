// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <utility>

#include "io/frames/field_value.hpp"
#include "io/language/language.hpp"
#include "io/terminal/text_table.hpp"
#include "study/info/input_facts.hpp"
#include "study/info/wide_text.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kSecondsOf2000 = 946'684'800.0;

// A name and what was found, without head or rule.
class Facts {
 public:
  void add(const char* name, std::string found) { rows_.push_back({name, std::move(found)}); }
  std::string text() const {
    std::size_t width = 0;
    for (const auto& [name, found] : rows_) width = std::max(width, shown_width(name));
    std::string all;
    for (const auto& [name, found] : rows_) all += hanging(name, found, width + 2, kLineWidth);
    return all;
  }

 private:
  std::vector<std::pair<std::string, std::string>> rows_;
};

std::string stamp_text(std::int64_t stamp_ns) {
  const double seconds = static_cast<double>(stamp_ns) * 1e-9;
  std::string text = fmt::format("{:.6f} s", seconds);
  // Before 2000 it counts from the start of something, not from 1970.
  if (seconds > kSecondsOf2000)
    text += fmt::format(" ({:%Y-%m-%d %H:%M:%S} UTC)", fmt::gmtime(stamp_ns / 1'000'000'000));
  return text;
}

void add_stamps(Facts& rows, const StampFacts& stamps, std::size_t frames) {
  if (stamps.count == 0) {
    rows.add(tr("stamps"), tr("none: frames follow each other at --rate"));
    return;
  }
  std::string span = say("{} to {}", stamp_text(stamps.first_ns), stamp_text(stamps.last_ns));
  if (stamps.count < frames) span += say("; {} frames have none", frames - stamps.count);
  rows.add(tr("stamps"), std::move(span));
  rows.add(tr("rate"), steps_text(stamps.steps));
}

bool is_named(const SourceAbout& about) {
  return std::any_of(about.senders.begin(), about.senders.end(), [](const SourceSender& sender) {
    return sender.is_read && std::any_of(sender.facts.begin(), sender.facts.end(),
                                         [](const SourceFact& fact) { return std::string_view(fact.word) == "model"; });
  });
}

// Packets name their sensor: then only whose settings fit is told.
void add_sensor(Facts& rows, const SensorFacts& sensor, bool is_named) {
  rows.add(tr("ranges"), ranges_text(sensor.ranges));
  if (is_unit_doubtful(sensor.ranges)) rows.add(tr("unit?"), unit_doubt(sensor.ranges));
  rows.add(tr("rings"), say("{} ({})", rings_text(sensor), rings_source_text(sensor)));
  rows.add(tr("view"), say("elevation {:.1f}° to {:.1f}°, {:.0f}° of azimuth, about the sensor's axes",
                           sensor.elevation_min_deg, sensor.elevation_max_deg, sensor.azimuth_span_deg));
  if (is_named) {
    rows.add(tr("settings"),
             sensor.is_known() ? say("{}; those of a {}", config_text(sensor), sensor.title) : config_text(sensor));
  } else {
    rows.add(tr("looks like"), class_text(sensor));
  }
}

void add_times(Facts& rows, const ScanTimeFacts& times, bool are_of_packets) {
  const std::string doubt = times_doubt(times);
  if (doubt.empty()) return;
  // Of packets the times are the sensor's own: where packets are missing, scans begin late or end early.
  const std::string advice = are_of_packets ? tr("Where packets are lost, mend that first") : times_advice(times);
  rows.add(tr("times?"), advice.empty() ? doubt : fmt::format("{}. {}", doubt, advice));
}

std::string points_text(std::vector<std::uint32_t> points) {
  std::sort(points.begin(), points.end());
  return say("{} min, {} median, {} max a frame", points.front(), points[points.size() / 2], points.back());
}

std::string layout_text(const LayoutFacts& layout) {
  const char* const order = layout.is_big_endian ? tr("big-endian") : tr("little-endian");
  return say("{} x {} points, {} bytes a point, {}", layout.rows, layout.columns, layout.point_step, order);
}

std::string role_text(const FieldFacts& field) {
  if (field.role.empty()) return tr("(passed over)");
  if (!field.times) return field.role;
  const TimeFacts& times = *field.times;
  if (times.unit.empty()) return say("time: unit unknown, spreads over {:g}", times.spread);
  if (times.is_absolute) return say("time: {}, {:.4f} s a frame, absolute", times.unit, times.spread_s);
  return say("time: {}, {:.4f} s a frame", times.unit, times.spread_s);
}

std::string fields_text(const InputFacts& facts) {
  TextTable table({tr("field"), tr("type"), tr("understood as"), tr("byte")});
  for (const FieldFacts& field : facts.fields()) {
    table.add_row(
        {field.name, std::string(field_type_name(field.type)), role_text(field), std::to_string(field.offset)});
  }
  return table.text(3);
}

std::string topics_text(const SourceAbout& about) {
  TextTable table({tr("topic"), tr("type"), "", tr("messages")});
  for (const SourceTopic& topic : about.topics) {
    table.add_row(
        {topic.name, topic.type, topic.name == about.topic ? tr("looked at") : "", std::to_string(topic.messages)});
  }
  return table.text(3);
}

std::string senders_text(const SourceAbout& about) {
  TextTable table({tr("source"), "", tr("messages")});
  for (const SourceSender& sender : about.senders) {
    table.add_row({sender.name, sender.is_read ? tr("looked at") : tr("not read"), std::to_string(sender.count)});
  }
  return table.text(2);
}

// What its packets tell of each sender.
std::string sender_facts_text(const SourceAbout& about) {
  std::string text;
  for (const SourceSender& sender : about.senders) {
    if (sender.facts.empty()) continue;
    Facts rows;
    rows.add(tr("source"),
             say("{} ({}), {} packets", sender.name, sender.is_read ? tr("looked at") : tr("not read"), sender.count));
    for (const SourceFact& fact : sender.facts) rows.add(tr(fact.word.c_str()), tr(fact.found.c_str()));
    for (const std::string& oddity : sender.oddities) rows.add(tr("odd"), oddity);
    text += '\n' + rows.text();
  }
  return text;
}

}  // namespace

std::string facts_text(const SourceAbout& about, const InputFacts& facts) {
  Facts rows;
  rows.add(tr("kind"), about.kind);
  rows.add(tr("frames"), facts.unreadable() == 0
                             ? std::to_string(facts.frames())
                             : say("{}, {} of them unreadable", facts.frames(), facts.unreadable()));
  if (!facts.points().empty()) {
    rows.add(tr("points"), points_text(facts.points()));
    rows.add(tr("layout"), layout_text(*facts.layout()));
    add_stamps(rows, facts.stamps(), facts.points().size());
    rows.add(tr("no return"), say("{:.1f} % at zero, {:.1f} % not finite", 100.0 * facts.zero_share(),
                                  100.0 * facts.not_finite_share()));
    if (facts.has_returns()) add_sensor(rows, facts.sensor(), is_named(about));
    add_times(rows, facts.scan_times(), is_named(about));
  }
  std::string text = rows.text();
  if (!about.topics.empty()) text += '\n' + topics_text(about);
  if (about.senders.size() > 1)
    text += '\n' + senders_text(about) + tr("No sensor is mixed with another: --source chooses.") + '\n';
  text += sender_facts_text(about);
  if (!facts.fields().empty()) text += '\n' + fields_text(facts);
  if (facts.other_layouts() > 0) text += say("frames with other fields than the first: {}\n", facts.other_layouts());
  return text;
}

}  // namespace pose_wall::tools
