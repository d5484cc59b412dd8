// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/robosense.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/packets/robosense_evidence.hpp"

namespace pose_wall::tools {
namespace {

// A device packet comes about once a second.
constexpr std::int64_t kHeldMost_ns = 2'000'000'000;
constexpr std::size_t kHeldMost = 12'000;  // two seconds of an Airy with two returns: 9,000
// Enough to see how long a packet takes although some were lost.
constexpr std::size_t kPacketsToKnowRoboSense = 6;
constexpr std::size_t kUnlikeMost = 12'000;
// From firing to firing; an Airy turns 0.8 degrees at 1,200 turns a minute.
constexpr double kFiringStepMost_deg = 1.0;
constexpr double kUsualSpeed_deg_per_us = 3600e-6;  // 600 turns a minute
constexpr std::uint64_t kAiryRangeBits = 0x3FFF;

ByteView view_of_bytes(const Bytes& bytes) {
  return {bytes.data(), bytes.size()};
}

}  // namespace

RoboSenseAssembler::RoboSenseAssembler(std::optional<RoboSenseModel> stated, const std::string& device)
    : stated_(stated), device_is_metadata_(!device.empty()) {
  const auto* const bytes = reinterpret_cast<const std::byte*>(device.data());
  device_ = Bytes(bytes, bytes + device.size());
  if (stated) kind_ = std::string("packets of a ") + robosense_traits(*stated).title;
}

bool RoboSenseAssembler::add(const Datagram& datagram) {
  if (is_robosense_device(datagram.payload)) {
    take_device(datagram.payload);
    return true;
  }
  const std::optional<RoboSenseLayout> layout = robosense_layout_of(datagram.payload);
  if (!layout || layout != layout_.value_or(*layout)) return false;
  layout_ = layout;
  if (!has_robosense_points(datagram.payload, *layout)) return true;
  const std::string head_settings = robosense_head_settings(datagram.payload, *layout);
  if (head_settings != head_settings_) {
    head_settings_ = head_settings;
    held_.clear();
    setup_.reset();
  }
  if (!setup_) return hold(datagram);
  if (is_grouped_as(*setup_, datagram.payload)) {
    unlike_ = 0;
    add_blocks(datagram.payload, datagram.captured_ns);
  } else if (++unlike_ == kUnlikeMost) {
    // Settings change before the device packet tells so; this is more than that.
    throw FrameError(say("the blocks of this {} are no longer those of the returns that its device packet names",
                         setup_->traits->title));
  }
  return true;
}

void RoboSenseAssembler::take_device(ByteView device) {
  const ByteView before = view_of_bytes(device_);
  if (!device_.empty()) {
    const std::string told = robosense_serial(before), now = robosense_serial(device);
    if (!told.empty() && !now.empty() && told != now) {
      throw FrameError(
          device_is_metadata_
              ? say("the metadata is the device packet of the RoboSense {}, but the packets are of {}", told, now)
              : say("packets of two RoboSense as of one: {} and {}", told, now));
    }
    if (robosense_settings(before) == robosense_settings(device)) return;
  }
  device_ = Bytes(device.data, device.data + device.size);
  device_is_metadata_ = false;
  setup_.reset();
  if (held_.size() >= kPacketsToKnowRoboSense) settle();
}

bool RoboSenseAssembler::hold(const Datagram& datagram) {
  const ByteView payload = datagram.payload;
  held_.push_back({Bytes(payload.data, payload.data + payload.size), datagram.captured_ns});
  bool is_full = false;
  while (held_.size() > kHeldMost || held_.back().captured_ns - held_.front().captured_ns > kHeldMost_ns) {
    held_.pop_front();
    is_full = true;
  }
  if (!device_.empty() && held_.size() >= kPacketsToKnowRoboSense) settle();
  return !is_full;
}

void RoboSenseAssembler::settle() {
  const std::deque<Held> held = std::exchange(held_, {});
  std::vector<ByteView> packets;
  packets.reserve(held.size());
  for (const Held& packet : held) packets.push_back(view_of_bytes(packet.payload));
  const RoboSenseSetup setup = robosense_setup(packets, view_of_bytes(device_), stated_);
  beams_.clear();
  for (const Laser& laser : setup.lasers) {
    const double elevation_rad = laser.elevation_deg * kRadPerDeg;
    beams_.push_back({laser, std::cos(elevation_rad), std::sin(elevation_rad)});
  }
  kind_ = std::string("packets of a ") + setup.traits->title;
  firing_step_deg_ = setup.step_deg > 0.0 ? setup.step_deg : kUsualSpeed_deg_per_us * setup.firing_us;
  firing_.points.resize(beams_.size());
  setup_ = setup;
  for (std::size_t i = 0; i < held.size(); ++i) add_blocks(packets[i], held[i].captured_ns);
}

void RoboSenseAssembler::add_blocks(ByteView payload, std::int64_t captured_ns) {
  const RoboSenseTraits& traits = *setup_->traits;
  const std::size_t group = setup_->blocks_of_firing(), firings = setup_->firings_of_block();
  const auto in_block = static_cast<double>(firings);
  const double block_ns = 1e3 * setup_->firing_us * in_block;
  std::vector<std::size_t> blocks;  // those that have an azimuth
  std::vector<double> azimuths_deg;
  for (std::size_t block = 0; block < traits.blocks(); block += group) {
    const std::optional<std::uint32_t> azimuth = robosense_azimuth(traits, payload, block);
    if (!azimuth) continue;
    blocks.push_back(block);
    azimuths_deg.push_back(0.01 * *azimuth);
  }
  const PacketSteps steps(azimuths_deg, in_block * firing_step_deg_);
  const std::int64_t packet_ns =
      packet_moment_ns(captured_ns, 1000 * robosense_clock_us(traits, payload), 0, steps, block_ns, ClockIs::kOfBegin);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const bool is_next_there = k + 1 == blocks.size() || blocks[k + 1] == blocks[k] + group;
    const double step_deg = is_next_there ? steps.after_deg(k) / in_block : firing_step_deg_;
    if (step_deg > 0.0 && step_deg <= kFiringStepMost_deg) firing_step_deg_ = step_deg;
    const double began_ns =
        block_ns * static_cast<double>(blocks[k] / group) + steps.moved_ns(k, block_ns, ClockIs::kOfBegin);
    for (std::size_t firing = 0; firing < firings; ++firing) {
      const double at_deg = azimuths_deg[k] + firing_step_deg_ * static_cast<double>(firing);
      firing_.azimuth_deg = at_deg < 360.0 ? at_deg : at_deg - 360.0;
      firing_.time_ns = packet_ns + std::llround(began_ns + 1e3 * setup_->firing_us * static_cast<double>(firing));
      fill_firing(payload, blocks[k], firing);
      add_firing(firing_, firing_step_deg_);
    }
  }
}

std::size_t RoboSenseAssembler::return_at(std::size_t block, std::size_t firing, std::size_t laser,
                                          std::size_t which) const {
  const RoboSenseTraits& traits = *setup_->traits;
  const std::size_t lasers = beams_.size();
  // Of 16 lasers a block holds two firings, or two returns of one.
  if (lasers == 16) return robosense_block_start(traits, block) + 4 + 3 * (laser + 16 * (firing + which));
  const std::size_t blocks_of_return = lasers / traits.channels();
  const std::size_t of_laser = block + which * blocks_of_return + laser / traits.channels();
  return robosense_block_start(traits, of_laser) + 4 + 3 * (laser % traits.channels());
}

void RoboSenseAssembler::fill_firing(ByteView payload, std::size_t block, std::size_t firing) {
  const RoboSenseTraits& traits = *setup_->traits;
  const std::uint64_t bits = traits.layout == RoboSenseLayout::kAiry ? kAiryRangeBits : 0xFFFF;
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    const Laser& laser = beams_[i].laser;
    ScanPoint& point = firing_.points[laser.ring];
    point = ScanPoint{};
    point.ring = laser.ring;
    point.t_ns = static_cast<std::uint32_t>(std::lround(laser.after_ns));
    // The farther return is the later one: dust before a wall would be taken for the wall.
    double range_m = 0.0;
    for (std::size_t which = 0; which < setup_->returns; ++which) {
      const std::size_t at = return_at(block, firing, i, which);
      const double other_m = setup_->unit_m * static_cast<double>(robosense_number(payload, at, 2) & bits);
      if (other_m < traits.nearest_m || other_m > traits.farthest_m || other_m <= range_m) continue;
      range_m = other_m;
      point.intensity = static_cast<float>(robosense_number(payload, at + 2, 1));
    }
    const double share = 1e-3 * laser.after_ns / setup_->firing_us;
    if (range_m > 0.0) place(beams_[i], range_m, firing_.azimuth_deg + firing_step_deg_ * share, &point);
  }
}

// The lens stands at the head's azimuth, whichever way the laser looks.
void RoboSenseAssembler::place(const Beam& beam, double range_m, double azimuth_deg, ScanPoint* point) const {
  const RoboSenseTraits& traits = *setup_->traits;
  const double direction = setup_->turns_back ? -1.0 : 1.0;
  const double lens_rad = direction * azimuth_deg * kRadPerDeg;
  const double beam_rad = direction * (azimuth_deg + beam.laser.azimuth_deg) * kRadPerDeg;
  const double flat_m = range_m * beam.cos_elevation;
  point->x_m = static_cast<float>(flat_m * std::cos(beam_rad) + traits.lens_out_m * std::cos(lens_rad));
  point->y_m = static_cast<float>(-flat_m * std::sin(beam_rad) - traits.lens_out_m * std::sin(lens_rad));
  point->z_m = static_cast<float>(range_m * beam.sin_elevation + traits.lens_up_m);
}

std::string RoboSenseAssembler::hint() const {
  if (!layout_ && !device_.empty() && !device_is_metadata_) {
    return say("there are device packets of a RoboSense, but none of its data (MSOP, port {})", kRoboSensePort);
  }
  if (!layout_ || !device_.empty()) return "";
  return say(
      "there is data of a RoboSense, but no device packet of it (DIFOP, port {}), without which neither the "
      "angles of its lasers nor the number of its returns are known: record or receive that port, too, or give a "
      "saved device packet of this sensor ({} bytes) as metadata",
      kRoboSenseDevicePort, kRoboSenseBytes);
}

void RoboSenseAssembler::finish() {
  if (!held_.empty() && device_.empty()) throw FrameError(hint());
  if (!held_.empty()) settle();
  TurnAssembler::finish();
}

}  // namespace pose_wall::tools
