// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/robosense_evidence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "io/language/language.hpp"
#include "io/packets/robosense_angles.hpp"

namespace pose_wall::tools {
namespace {

using Models = std::vector<RoboSenseModel>;

// One voice: which models it allows, and how it is named.
struct Voice {
  Models models;
  std::string says;
};

bool holds(const Models& models, RoboSenseModel model) {
  return std::find(models.begin(), models.end(), model) != models.end();
}

Models models_of(RoboSenseLayout layout) {
  Models models;
  for (const RoboSenseTraits& traits : robosense_sensors()) {
    if (traits.layout == layout) models.push_back(traits.model);
  }
  return models;
}

std::string titles_of(const Models& models) {
  std::vector<std::string> titles;
  for (const RoboSenseModel model : models) titles.emplace_back(robosense_traits(model).title);
  return titles.empty() ? std::string(tr("no sensor that is known")) : fmt::format("{}", fmt::join(titles, tr(" or ")));
}

// Byte 30 by the manuals of all sensors of the first kind; bytes 31 and 32 by rs_driver and the manuals of Helios.
Models first_kind_of_head(ByteView packet) {
  const std::uint64_t old_type = robosense_number(packet, 30, 1), type = robosense_number(packet, 31, 1);
  const std::uint64_t version = robosense_number(packet, 32, 1);
  if (old_type == 1) return {RoboSenseModel::kRs16};
  if (old_type == 2) return {RoboSenseModel::kRs32};
  if (type == 3 && version == 4) return {RoboSenseModel::kBpearl4};
  if (old_type == 3 || (type == 3 && version < 4)) return {RoboSenseModel::kBpearl};
  if (old_type == 4 || old_type == 5 || type == 3) return {};  // a Ruby; a Bpearl that came later
  return {RoboSenseModel::kRs16, RoboSenseModel::kRs32, RoboSenseModel::kBpearl};
}

Models helios_of_head(ByteView packet) {
  const std::uint64_t type = robosense_number(packet, 31, 1), version = robosense_number(packet, 32, 1);
  if (type == 6 && version == 3) return {RoboSenseModel::kHelios16p};
  if (type == 6 && (version == 1 || version == 2 || version == 4)) return {RoboSenseModel::kHelios32};
  return {RoboSenseModel::kHelios32, RoboSenseModel::kHelios16p};
}

Voice head_voice(ByteView packet, RoboSenseLayout layout) {
  const Models models = robosense_models_of_head(packet, layout);
  return {models, say("the head of its data says {}", titles_of(models))};
}

std::uint64_t time_field(ByteView packet, std::size_t offset, std::size_t size) {
  return robosense_number(packet, 20 + offset, size);
}

bool has_date(ByteView packet) {
  return time_field(packet, 1, 1) <= 12 && time_field(packet, 2, 1) <= 31 && time_field(packet, 3, 1) < 24 &&
         time_field(packet, 4, 1) < 60 && time_field(packet, 5, 1) <= 60 && time_field(packet, 6, 2) < 1000 &&
         time_field(packet, 8, 2) < 1000;
}

bool has_seconds(ByteView packet) {
  return time_field(packet, 0, 2) == 0 && time_field(packet, 6, 4) < 1'000'000;
}

// A Bpearl counts 5 mm and writes a date; a Bpearl 4 counts 2.5 mm and writes seconds. Their heads differ in two bytes.
Voice form_voice(Models models, const std::vector<ByteView>& packets) {
  const auto forget = [&](RoboSenseModel model, bool (*has_form)(ByteView)) {
    if (std::all_of(packets.begin(), packets.end(), has_form)) return;
    models.erase(std::remove(models.begin(), models.end(), model), models.end());
  };
  forget(RoboSenseModel::kBpearl, has_date);
  forget(RoboSenseModel::kBpearl4, has_seconds);
  return {models, say("the form of its time says {}", titles_of(models))};
}

Voice angle_voice(const Models& all, ByteView packet, ByteView device) {
  Models models;
  for (const RoboSenseModel model : all) {
    const RoboSenseTraits& traits = robosense_traits(model);
    if (robosense_angles(traits, device, robosense_lines(traits, packet))) models.push_back(model);
  }
  if (models.empty() && has_no_rs16_angles(device) && holds(all, RoboSenseModel::kRs16)) return {all, ""};
  return {models, say("the angles of its device packet say {}", titles_of(models))};
}

// The shortest time between two packets: where some were lost others are longer. 0: the clock stands, or there is but
// one packet.
double packet_us(const RoboSenseTraits& traits, const std::vector<ByteView>& packets) {
  constexpr std::int64_t kGapMost_us = 20'000;
  std::int64_t shortest_us = 0;
  for (std::size_t i = 1; i < packets.size(); ++i) {
    const std::int64_t gap_us = robosense_clock_us(traits, packets[i]) - robosense_clock_us(traits, packets[i - 1]);
    if (gap_us > 0 && gap_us < kGapMost_us && (shortest_us == 0 || gap_us < shortest_us)) shortest_us = gap_us;
  }
  return static_cast<double>(shortest_us);
}

// The mean turn from one block to the next that has another azimuth; 0: none was seen. Steps beyond a degree are holes
// of a field of view.
double step_deg(const RoboSenseTraits& traits, const std::vector<ByteView>& packets) {
  constexpr std::uint32_t kHole = 100;
  double sum_deg = 0.0;
  std::size_t steps = 0;
  for (const ByteView& packet : packets) {
    for (std::size_t block = 1; block < traits.blocks(); ++block) {
      const std::optional<std::uint32_t> from = robosense_azimuth(traits, packet, block - 1);
      const std::optional<std::uint32_t> to = robosense_azimuth(traits, packet, block);
      if (!from || !to) continue;
      const std::uint32_t step = (*to + 36'000 - *from) % 36'000;
      if (step == 0 || step > kHole) continue;
      sum_deg += 0.01 * step;
      ++steps;
    }
  }
  return steps == 0 ? 0.0 : sum_deg / static_cast<double>(steps);
}

// How long a firing takes: by the sensor's clock, and by its speed and azimuths. 0: not told.
struct Measured {
  double by_clock_us = 0.0, by_speed_us = 0.0;

  bool is_none() const { return by_clock_us == 0.0 && by_speed_us == 0.0; }
  // The speed is the one that was set; where packets were lost the clock shows a longer time.
  bool fits(double wanted_us) const {
    const auto is_near = [&](double us) { return std::abs(us - wanted_us) <= 0.045 * wanted_us; };
    if (by_clock_us == 0.0) return is_near(by_speed_us);
    return is_near(by_clock_us) || (by_clock_us > 1.5 * wanted_us && is_near(by_speed_us));
  }
};

Measured measured(const RoboSenseTraits& traits, const std::vector<ByteView>& packets, ByteView device) {
  const ByteView packet = packets.back();
  const std::size_t returns = robosense_returns(traits, packet, device), lines = robosense_lines(traits, packet);
  const bool holds_two = lines == 16 && returns == 1;  // firings in a block
  const double firings_of_block = lines == 16
                                      ? 3.0 - static_cast<double>(returns)
                                      : static_cast<double>(traits.channels()) / static_cast<double>(returns * lines);
  Measured times;
  times.by_clock_us = packet_us(traits, packets) / (static_cast<double>(traits.blocks()) * firings_of_block);
  const double speed = robosense_degrees_per_us(device);
  if (speed > 0.0) times.by_speed_us = step_deg(traits, packets) / speed / (holds_two ? 2.0 : 1.0);
  return times;
}

const RoboSenseRhythm* rhythm_of(const RoboSenseTraits& traits, const Measured& times) {
  for (const RoboSenseRhythm& rhythm : traits.rhythms) {
    if (times.is_none() || times.fits(rhythm.firing_us)) return &rhythm;
  }
  return nullptr;
}

// Models whose times are not told are not spoken of.
Voice time_voice(const Models& all, const std::vector<ByteView>& packets, ByteView device) {
  Models models;
  for (const RoboSenseModel model : all) {
    const RoboSenseTraits& traits = robosense_traits(model);
    if (rhythm_of(traits, measured(traits, packets, device)) != nullptr) models.push_back(model);
  }
  return {models, say("the time that its packets take says {}", titles_of(models))};
}

}  // namespace

std::vector<RoboSenseModel> robosense_models_of_head(ByteView packet, RoboSenseLayout layout) {
  if (layout == RoboSenseLayout::kFirst) return first_kind_of_head(packet);
  if (layout == RoboSenseLayout::kHelios) return helios_of_head(packet);
  return {RoboSenseModel::kAiry};
}

std::string robosense_head_settings(ByteView packet, RoboSenseLayout layout) {
  std::string settings;
  for (const RoboSenseModel model : robosense_models_of_head(packet, layout)) settings += static_cast<char>(model);
  if (layout == RoboSenseLayout::kFirst) return settings;
  // Unit of a Helios or returns of an Airy, and its lines.
  for (const std::size_t at : {17U, 32U}) settings += static_cast<char>(robosense_number(packet, at, 1));
  return settings;
}

double robosense_degrees_per_us(ByteView device) {
  constexpr std::size_t kSpeedAt = 8;
  constexpr double kDegreesPerTurn = 360.0, kMicrosecondsPerMinute = 6e7;
  return static_cast<double>(robosense_number(device, kSpeedAt, 2)) * kDegreesPerTurn / kMicrosecondsPerMinute;
}

RoboSenseTold identify_robosense(const std::vector<ByteView>& packets, ByteView device,
                                 std::optional<RoboSenseModel> stated) {
  const RoboSenseLayout layout = robosense_layout_of(packets.front()).value();
  const Models all = models_of(layout);
  if (stated && !holds(all, *stated)) {
    throw FrameError(say("the sensor is said to be a {} ({}), but its packets are those of a {}",
                         robosense_traits(*stated).title, robosense_traits(*stated).word, titles_of(all)));
  }
  const std::vector<Voice> voices = {head_voice(packets.back(), layout), angle_voice(all, packets.back(), device),
                                     time_voice(all, packets, device), form_voice(all, packets)};
  Models left = stated ? Models{*stated} : all;
  std::vector<std::string> heard;
  for (const Voice& voice : voices) {
    if (stated && !holds(voice.models, *stated)) {
      throw FrameError(say("the sensor is said to be a {} ({}), but {}", robosense_traits(*stated).title,
                           robosense_traits(*stated).word, voice.says));
    }
    left.erase(std::remove_if(left.begin(), left.end(), [&](auto model) { return !holds(voice.models, model); }),
               left.end());
    if (voice.models.size() < all.size()) heard.push_back(voice.says);
  }
  if (left.empty()) {
    throw FrameError(say("packets of a RoboSense that is not known, or that contradict themselves: {}",
                         fmt::format("{}", fmt::join(heard, "; "))));
  }
  if (left.size() > 1) {
    throw FrameError(say("packets of a RoboSense, but nothing tells which: it may be a {}; name the sensor that it is",
                         titles_of(left)));
  }
  const RoboSenseTraits& traits = robosense_traits(left.front());
  return {&traits, rhythm_of(traits, measured(traits, packets, device))};
}

}  // namespace pose_wall::tools
