// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/velodyne.hpp"

#include <cmath>
#include <utility>

#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

// Enough for a clock of which some packets were lost.
constexpr std::size_t kPacketsToKnow = 6;

double azimuth_of(ByteView payload, std::size_t block) {
  return 0.01 * little_endian_at(payload, block * kVelodyneBlockBytes + 2, 2);
}

}  // namespace

bool VelodyneAssembler::add(const Datagram& datagram) {
  if (!is_velodyne_data(datagram.payload)) return false;
  const ByteView payload = datagram.payload;
  if (traits_ == nullptr) {
    if (!held_.empty() && velodyne_product(payload) != product_) return false;
    product_ = velodyne_product(payload);
    held_.push_back({Bytes(payload.data, payload.data + payload.size), datagram.captured_ns});
    if (held_.size() == kPacketsToKnow) identify();
    return true;
  }
  if (velodyne_product(payload) != product_) return false;  // of another sensor behind the same address
  add_blocks(payload, datagram.captured_ns);
  return true;
}

void VelodyneAssembler::identify() {
  const std::vector<Held> held = std::exchange(held_, {});
  std::vector<ByteView> packets;
  packets.reserve(held.size());
  for (const Held& packet : held) packets.push_back({packet.payload.data(), packet.payload.size()});
  traits_ = &velodyne_traits(identify_velodyne(packets, stated_));
  kind_ = "packets of a " + traits_->title();
  firing_.points.resize(traits_->lasers());
  for (std::size_t i = 0; i < held.size(); ++i) add_blocks(packets[i], held[i].captured_ns);
}

void VelodyneAssembler::add_blocks(ByteView payload, std::int64_t captured_ns) {
  // Of a pair of blocks the first holds the last return. The second holds the strongest, or the second strongest where
  // the last is the strongest: dust before a wall would be taken for the wall.
  const std::size_t step = is_velodyne_dual(payload) ? 2 : 1;
  const std::size_t firings = traits_->firings_per_block(), firing_bytes = 3 * traits_->lasers();
  const double block_ns = static_cast<double>(firings) * traits_->beams.cycle_ns;
  std::vector<double> azimuths_deg;
  for (std::size_t block = 0; block < kVelodyneBlocks; block += step)
    azimuths_deg.push_back(azimuth_of(payload, block));
  const PacketSteps steps(azimuths_deg, last_turn_deg_);
  const std::int64_t packet_ns = packet_moment_ns(captured_ns, 1000 * velodyne_clock_us(payload),
                                                  1000 * kVelodyneHour_us, steps, block_ns, ClockIs::kOfBegin);
  for (std::size_t k = 0; k < azimuths_deg.size(); ++k) {
    const double turn_deg = steps.after_deg(k);
    const std::byte* const lasers = payload.data + k * step * kVelodyneBlockBytes + 4;
    const double began_ns = static_cast<double>(k) * block_ns + steps.moved_ns(k, block_ns, ClockIs::kOfBegin);
    for (std::size_t i = 0; i < firings; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(firings);
      const double firing_ns = static_cast<double>(i) * traits_->beams.cycle_ns;
      const auto time_ns = packet_ns + std::llround(began_ns + firing_ns);
      fill_firing({lasers + i * firing_bytes, firing_bytes}, azimuths_deg[k] + part * turn_deg, turn_deg, time_ns);
      add_firing(firing_, turn_deg);
    }
  }
  last_turn_deg_ = steps.after_deg(azimuths_deg.size());
}

void VelodyneAssembler::fill_firing(ByteView lasers, double azimuth_deg, double turn_deg, std::int64_t time_ns) {
  firing_.azimuth_deg = azimuth_deg < 360.0 ? azimuth_deg : azimuth_deg - 360.0;
  firing_.time_ns = time_ns;
  const double block_ns = static_cast<double>(traits_->firings_per_block()) * traits_->beams.cycle_ns;
  for (std::size_t i = 0; i < traits_->lasers(); ++i) {
    const Laser& laser = traits_->beams.lasers[i];
    ScanPoint& point = firing_.points[laser.ring];
    point = ScanPoint{};
    point.ring = laser.ring;
    point.t_ns = static_cast<std::uint32_t>(laser.after_ns);
    const double range_m = traits_->beams.ranges.unit_m * little_endian_at(lasers, 3 * i, 2);
    if (range_m == 0.0) continue;
    const double elevation_rad = laser.elevation_deg * kRadPerDeg;
    const double turned_by_deg = turn_deg * laser.after_ns / block_ns;
    const double azimuth_rad = (azimuth_deg + turned_by_deg + laser.azimuth_deg) * kRadPerDeg;
    const double flat_m = range_m * std::cos(elevation_rad);
    point.x_m = static_cast<float>(flat_m * std::cos(azimuth_rad));
    point.y_m = static_cast<float>(-flat_m * std::sin(azimuth_rad));
    point.z_m = static_cast<float>(range_m * std::sin(elevation_rad) + laser.up_m);
    point.intensity = std::to_integer<std::uint8_t>(lasers.data[3 * i + 2]);
  }
}

void VelodyneAssembler::finish() {
  if (!held_.empty()) identify();
  TurnAssembler::finish();
}

}  // namespace pose_wall::tools
