// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/lslidar.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/packets/lslidar_device.hpp"

namespace pose_wall::tools {
namespace {

// Enough for a clock of which some packets were lost.
constexpr std::size_t kPacketsForClock = 6;
// Device packets come about once a second.
constexpr std::int64_t kWaitForDevice_ns = 2'000'000'000;
constexpr std::size_t kHeldMax = 8'000;  // of two returns 3,400 come in two seconds
// A head turns 0.7 degrees from block to block at 1,200 turns a minute.
constexpr double kStepMost_deg = 5.0;
constexpr double kAzimuthUnit_deg = 0.01;
constexpr std::int64_t kPacketLeast_us = 100;  // one takes 0.2 to 2.4 ms

ByteView held_bytes(const Bytes& bytes) {
  return {bytes.data(), bytes.size()};
}

// How far the head turns from block to block, or from pair to pair; 0: it does not tell.
double step_of(ByteView packet, bool is_dual) {
  const std::size_t last = is_dual ? kLslidarBlocks - 2 : kLslidarBlocks - 1;
  const double turn_deg = turned_deg(lslidar_azimuth_deg(packet, 0), lslidar_azimuth_deg(packet, last));
  const double step_deg = turn_deg / static_cast<double>(is_dual ? last / 2 : last);
  return step_deg <= kStepMost_deg ? step_deg : 0.0;
}

// Blocks that follow each other in time.
std::size_t moments_of(bool is_dual) {
  return is_dual ? kLslidarBlocks / 2 : kLslidarBlocks;
}

}  // namespace

bool LslidarAssembler::add(const Datagram& datagram) {
  const ByteView packet = lslidar_packet(datagram.payload);
  if (is_lslidar_device(packet)) {
    hear_device(packet);
    return true;
  }
  const std::optional<LslidarModel> model = lslidar_model_of(packet);
  if (!model) return false;
  if (traits_ == nullptr) begin(*model);
  if (*model != traits_->model) return false;
  if (!beams_.lasers.empty()) {
    add_blocks(packet, datagram.captured_ns);
    return true;
  }
  held_.push_back({Bytes(packet.data, packet.data + packet.size), datagram.captured_ns});
  if (held_.size() >= kPacketsForClock) start_if_known(false);
  return true;
}

void LslidarAssembler::begin(LslidarModel model) {
  const LslidarTraits& traits = lslidar_traits(model);
  const auto& named = choice_.models;
  if (!named.empty() && std::find(named.begin(), named.end(), model) == named.end()) {
    throw FrameError(say("the sensor is said to be an {} ({}), but its packets are of an {}", choice_.title,
                         choice_.word, traits.beams.title));
  }
  traits_ = &traits;
  kind_ = "packets of an " + traits.beams.title;
}

void LslidarAssembler::hear_device(ByteView device) {
  if (!device_.empty()) return;
  device_ = Bytes(device.data, device.data + device.size);
  if (traits_ == nullptr || beams_.lasers.empty()) return;
  kind_ += lslidar_filter_of(device, traits_->model);
  // Data was read with the angles of the sensor that was named: now it is seen whether it is that one.
  if (traits_->is_first_kind()) lslidar_beams_of(device, traits_->model, choice_.of_first_kind);
}

void LslidarAssembler::start_if_known(bool is_last) {
  if (!traits_->is_first_kind()) {
    start(traits_->beams);
  } else if (!device_.empty()) {
    start(lslidar_beams_of(held_bytes(device_), traits_->model, choice_.of_first_kind));
  } else if (is_last || held_.size() >= kHeldMax ||
             held_.back().captured_ns - held_.front().captured_ns >= kWaitForDevice_ns) {
    if (choice_.of_first_kind == nullptr) refuse_without_device();
    start(*choice_.of_first_kind);
  }
}

void LslidarAssembler::refuse_without_device() const {
  if (traits_->model == LslidarModel::kC16V3) {
    throw FrameError(say(
        "packets of an {}, which do not tell whether its lasers point from -15 to 15 degrees or from -10 to 10; its "
        "device packets do, and none came: record or receive UDP port 2369, too, or name lslidar_c16_15deg or "
        "lslidar_c16_10deg, as its type plate says",
        traits_->beams.title));
  }
  throw FrameError(
      say("packets of an {}, which do not tell whether their unit is 2.5 or 4 mm, nor where the columns of its lasers "
          "stand, and the drivers of its maker disagree; its device packets tell, and none came: record or receive UDP "
          "port 2369, too",
          traits_->beams.title));
}

void LslidarAssembler::start(const BeamTable& beams) {
  beams_ = beams;
  learn_clock();
  if (!device_.empty()) kind_ += lslidar_filter_of(held_bytes(device_), traits_->model);
  firing_.points.resize(beams_.lasers.size());
  for (const Held& held : std::exchange(held_, {})) add_blocks(held_bytes(held.payload), held.captured_ns);
}

// The sensor's clock tells, between packets of which the azimuths say that none is missing.
void LslidarAssembler::learn_clock() {
  std::vector<double> blocks_ns;
  for (std::size_t i = 1; i < held_.size(); ++i) {
    const ByteView before = held_bytes(held_[i - 1].payload), now = held_bytes(held_[i].payload);
    const bool is_dual = is_lslidar_dual(before, *traits_);
    const double step_deg = step_of(before, is_dual), moments = static_cast<double>(moments_of(is_dual));
    const double turn_deg = turned_deg(lslidar_azimuth_deg(before, 0), lslidar_azimuth_deg(now, 0));
    const std::int64_t gap = std::int64_t{lslidar_clock(now, *traits_)} - lslidar_clock(before, *traits_);
    const std::int64_t unit_ns = lslidar_clock_unit_ns(gap, kPacketLeast_us);
    const bool is_known = unit_ns == 1000 || (unit_ns == 1 && !traits_->is_first_kind());
    if (step_deg > 0.0 && is_known && std::abs(turn_deg - moments * step_deg) < step_deg) {
      blocks_ns.push_back(static_cast<double>(gap * unit_ns) / moments);
      clock_unit_ns_ = unit_ns;
    }
  }
  block_ns_ = beams_.cycle_ns * static_cast<double>(traits_->firings_per_block());
  if (blocks_ns.empty()) return;
  std::sort(blocks_ns.begin(), blocks_ns.end());
  block_ns_ = blocks_ns[blocks_ns.size() / 2];
}

// The time of a packet is that of its end.
void LslidarAssembler::add_blocks(ByteView packet, std::int64_t captured_ns) {
  const bool is_dual = is_lslidar_dual(packet, *traits_);
  const std::size_t blocks = is_dual ? 2 : 1, firings = traits_->firings_per_block();
  const std::size_t firing_bytes = 3 * beams_.lasers.size();
  const double packet_ns = block_ns_ * static_cast<double>(moments_of(is_dual));
  std::vector<double> azimuths_deg;
  for (std::size_t block = 0; block < kLslidarBlocks; block += blocks) {
    azimuths_deg.push_back(lslidar_azimuth_deg(packet, block));
  }
  const PacketSteps steps(azimuths_deg, last_step_deg_);
  std::optional<std::int64_t> clock_ns;
  if (clock_unit_ns_ > 0) clock_ns = clock_unit_ns_ * lslidar_clock(packet, *traits_);
  const std::int64_t end_ns =
      packet_moment_ns(captured_ns, clock_ns, kClockSecond_ns, steps, block_ns_, ClockIs::kOfEnd);
  const double mean_step_deg = step_of(packet, is_dual);
  for (std::size_t block = 0; block < kLslidarBlocks; block += blocks) {
    const double azimuth_deg = azimuths_deg[block / blocks];
    if (block + blocks < kLslidarBlocks) {
      last_step_deg_ = steps.after_deg(block / blocks);
    } else if (std::abs(mean_step_deg - last_step_deg_) <= 2.0 * kAzimuthUnit_deg) {
      last_step_deg_ = mean_step_deg;  // azimuths are rounded, and beyond the last there is none
    }
    const double begins_ns =
        block_ns_ * static_cast<double>(block / blocks) + steps.moved_ns(block / blocks, block_ns_, ClockIs::kOfEnd);
    const std::byte* const first = packet.data + block * kLslidarBlockBytes + 4;
    const std::byte* const second = first + (is_dual ? kLslidarBlockBytes : 0);
    for (std::size_t i = 0; i < firings; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(firings);
      firing_.time_ns = end_ns + std::llround(begins_ns + part * block_ns_ - packet_ns);
      fill_firing({first + i * firing_bytes, firing_bytes}, {second + i * firing_bytes, firing_bytes},
                  azimuth_deg + part * last_step_deg_);
      add_firing(firing_, last_step_deg_);
    }
  }
}

void LslidarAssembler::fill_firing(ByteView first, ByteView second, double azimuth_deg) {
  firing_.azimuth_deg = azimuth_deg < 360.0 ? azimuth_deg : azimuth_deg - 360.0;
  const auto lasers = static_cast<double>(beams_.lasers.size()),
             firings = static_cast<double>(traits_->firings_per_block());
  for (std::size_t i = 0; i < beams_.lasers.size(); ++i) {
    const Laser& laser = beams_.lasers[i];
    ScanPoint& point = firing_.points[laser.ring];
    point = ScanPoint{};
    point.ring = laser.ring;
    const double share = static_cast<double>(i) / lasers / firings;  // of a block
    point.t_ns = static_cast<std::uint32_t>(block_ns_ * share);
    const ByteView farther = little_endian_at(second, 3 * i, 2) > little_endian_at(first, 3 * i, 2) ? second : first;
    const double range_m = beams_.ranges.unit_m * little_endian_at(farther, 3 * i, 2);
    if (range_m == 0.0) continue;
    // The lens stands beside the laser: the maker turns it with the laser's own offset.
    const double head_deg = azimuth_deg + last_step_deg_ * share + laser.azimuth_deg;
    const double azimuth_rad = head_deg * kRadPerDeg, lens_rad = (head_deg + beams_.lens.azimuth_deg) * kRadPerDeg;
    const double elevation_rad = laser.elevation_deg * kRadPerDeg;
    const double flat_m = range_m * std::cos(elevation_rad);
    point.x_m = static_cast<float>(flat_m * std::cos(azimuth_rad) + beams_.lens.out_m * std::cos(lens_rad));
    point.y_m = static_cast<float>(-flat_m * std::sin(azimuth_rad) - beams_.lens.out_m * std::sin(lens_rad));
    point.z_m = static_cast<float>(range_m * std::sin(elevation_rad));
    point.intensity = std::to_integer<std::uint8_t>(farther.data[3 * i + 2]);
  }
}

void LslidarAssembler::finish() {
  if (!held_.empty()) start_if_known(true);
  TurnAssembler::finish();
}

}  // namespace pose_wall::tools
