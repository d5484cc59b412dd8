// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/sensor_sim/robosense_encoder.hpp"

#include <cmath>
#include <stdexcept>

namespace pose_wall::tools::live {
namespace {

constexpr std::size_t kBytes = 1248;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

constexpr const char* kFirstHead = "\x55\xAA\x05\x0A\x5A\xA5\x50\xA0";

// What differs between the packets of these sensors.
struct Form {
  std::string head;      // first bytes
  std::size_t channels;  // of a block
  std::size_t blocks;    // of a packet
  bool is_calendar;      // time as a date
  double angle_deg;      // unit of the angles in the device packet
  std::size_t angles;    // for so many lasers it has room
  std::size_t type_at;   // where the head names its kind
  std::string type;      // and how

  bool has_first_head() const { return head == kFirstHead; }
};

Form form_of(const BeamTable& beams) {
  const std::string first = kFirstHead, second = "\x55\xAA\x05\x5A";
  if (&beams == &robosense_rs16()) return {first, 32, 12, true, 0.0001, 16, 30, "\x01"};
  if (&beams == &robosense_rs32()) return {first, 32, 12, true, 0.001, 32, 30, "\x02"};
  if (&beams == &robosense_bpearl()) return {first, 32, 12, true, 0.01, 32, 30, "\x03"};
  // The kind alone parts a later Bpearl from the first.
  if (&beams == &robosense_bpearl4()) return {first, 32, 12, false, 0.01, 32, 31, "\x03\x04"};
  if (&beams == &robosense_helios16p()) return {second, 32, 12, false, 0.01, 32, 31, "\x06\x03"};
  if (&beams == &robosense_helios32()) return {second, 32, 12, false, 0.01, 32, 31, "\x06\x01"};
  if (&beams == &robosense_airy()) return {second, 48, 8, false, 0.01, 96, 32, "\x02"};
  throw std::invalid_argument(beams.title + ": no packets of such a sensor are known");
}

void put_big(std::string* bytes, std::size_t offset, std::int64_t number, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t shift = 8 * (size - 1 - i);
    (*bytes)[offset + i] = static_cast<char>((static_cast<std::uint64_t>(number) >> shift) & 0xFFU);
  }
}

void put_text(std::string* bytes, std::size_t offset, const std::string& text) {
  bytes->replace(offset, text.size(), text);
}

// As if the first of January, 2026, had been when the clock began: the sensor's calendar, or Unix seconds.
void put_time(std::string* bytes, std::int64_t time_ns, bool is_calendar) {
  constexpr std::size_t kAt = 20;
  const std::int64_t second = time_ns / kSecond_ns, us = time_ns % kSecond_ns / 1000;
  if (!is_calendar) {
    put_big(bytes, kAt, 1'767'225'600 + second, 6);
    put_big(bytes, kAt + 6, us, 4);
    return;
  }
  const std::int64_t fields[] = {26, 1, 1 + second / 86'400 % 28, second / 3600 % 24, second / 60 % 60, second % 60};
  for (std::size_t i = 0; i < 6; ++i) put_big(bytes, kAt + i, fields[i], 1);
  put_big(bytes, kAt + 6, us / 1000, 2);
  put_big(bytes, kAt + 8, us % 1000, 2);
}

// Sign and size.
void put_angle(std::string* bytes, std::size_t offset, double angle_deg, double unit_deg) {
  put_big(bytes, offset, angle_deg < 0.0 ? 1 : 0, 1);
  put_big(bytes, offset + 1, std::llround(std::abs(angle_deg) / unit_deg), 2);
}

}  // namespace

std::string RoboSenseEncoder::packet(const RangeImage& image, std::uint32_t first, std::int64_t time_ns) const {
  const Form form = form_of(beams_);
  const std::size_t lasers = beams_.lasers.size(), block_bytes = 4 + 3 * form.channels;
  std::string bytes(kBytes, '\0');
  put_text(&bytes, 0, form.head);
  put_time(&bytes, time_ns, form.is_calendar);
  put_text(&bytes, form.type_at, form.type);
  // Helios: distances in 2.5 mm. Airy: one return. Nothing is known of a first head's.
  if (!form.has_first_head()) bytes[17] = '\x01';
  for (std::size_t slot = 0; slot < form.blocks * form.channels; ++slot) {
    const std::size_t block = slot / form.channels, channel = slot % form.channels;
    const std::size_t start = 42 + block * block_bytes;
    const auto column = static_cast<std::uint32_t>(first + slot / lasers);
    if (channel == 0) {
      put_big(&bytes, start, 0xFFEE, 2);
      put_big(&bytes, start + 2, std::llround(36'000.0 * column / image.columns), 2);
    }
    const std::size_t at = image.at(beams_.lasers[slot % lasers].ring, column);
    put_big(&bytes, start + 4 + 3 * channel, std::llround(image.range_m[at] / beams_.ranges.unit_m), 2);
    put_big(&bytes, start + 6 + 3 * channel, std::min(255LL, std::llround(image.intensity[at])), 1);
  }
  return bytes;
}

std::vector<std::string> RoboSenseEncoder::packets(const RangeImage& image, std::int64_t began_ns, std::int64_t) {
  const Form form = form_of(beams_);
  if (image.rings != beams_.lasers.size()) throw std::invalid_argument(beams_.title + ": another number of rings");
  const auto of_packet = static_cast<std::uint32_t>(form.blocks * form.channels / beams_.lasers.size());
  std::vector<std::string> packets;
  for (std::uint32_t first = 0; first + of_packet <= image.columns; first += of_packet) {
    // Its lasers keep their time, however fast the head turns.
    packets.push_back(packet(image, first, began_ns + std::llround(beams_.cycle_ns * first)));
  }
  return packets;
}

std::string RoboSenseEncoder::device_packet(std::int64_t turn_ns) const {
  const Form form = form_of(beams_);
  std::string bytes(kBytes, '\0');
  put_text(&bytes, 0, std::string("\xA5\xFF\0\x5A\x11\x11\x55\x55", 8));
  put_big(&bytes, 8, 60 * kSecond_ns / turn_ns, 2);
  put_big(&bytes, 34, 36'000, 2);
  put_text(&bytes, 40, std::string("\0\x06\x23\x09\0\x08\x03\x01\x01\x01", 10));  // firmware of both boards
  put_text(&bytes, 292, "SIMUL8");
  bytes[300] = form.has_first_head() ? '\x01' : '\x04';  // the strongest return
  for (std::size_t k = 0; k < beams_.lasers.size(); ++k) {
    const Laser& laser = beams_.lasers[k];
    if (form.angles == 16) {
      put_big(&bytes, 1165 + 3 * k, std::llround(std::abs(laser.elevation_deg) / form.angle_deg), 3);
      continue;
    }
    put_angle(&bytes, 468 + 3 * k, laser.elevation_deg, form.angle_deg);
    put_angle(&bytes, 468 + 3 * (form.angles + k), laser.azimuth_deg, form.angle_deg);
  }
  return bytes;
}

}  // namespace pose_wall::tools::live
