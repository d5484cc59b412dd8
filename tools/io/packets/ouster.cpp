// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/ouster.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kTurn_rad = 6.283185307179586;
constexpr std::array<std::uint32_t, 4> kRingsOfSensors = {16, 32, 64, 128};
// Turns and columns are as even as this, and modes differ by half and more.
constexpr double kEvenness = 0.1;
// A network puts packets out of order within milliseconds; so many of 16 columns take 6 ms at 10 Hz and 1,024.
constexpr std::uint32_t kPacketsOfABeginning = 4;
// What is further behind is no late packet: the sensor has begun to count anew.
constexpr std::uint32_t kTurnsLate = 16;
// A packet in a hundred may be lost; a scan that began or ended with the capture lacks more.
constexpr std::uint32_t kComplete_percent = 95;
// A turn takes 0.05 to 0.1 s. Within a longer one the sensor's clock was set.
constexpr std::uint64_t kTurnMost_ns = 1'000'000'000;

// Of its bits, as far as a stamp has them.
std::int64_t stamp_of(std::uint64_t time_ns) {
  return static_cast<std::int64_t>(time_ns & std::numeric_limits<std::int64_t>::max());
}

}  // namespace

OusterAssembler::OusterAssembler(OusterMetadata metadata)
    : metadata_(std::move(metadata)),
      last_number_(metadata_.header == OusterHeader::kFusa ? 0xFFFFFFFFU : 0xFFFFU),
      kind_(say("packets of an Ouster {}", metadata_.product)),
      shown_(metadata_.columns_per_frame, false) {}

std::size_t OusterAssembler::packet_bytes() const {
  return ouster_packet_bytes(metadata_.profile, metadata_.rings, metadata_.columns_per_packet);
}

// Another number of beams, or another profile: which has the size of these packets.
void OusterAssembler::explain_size(std::size_t bytes) {
  if (!hint_.empty()) return;
  const auto fits = [&](const OusterProfile& profile, std::uint32_t rings) {
    return bytes == ouster_packet_bytes(profile, rings, metadata_.columns_per_packet);
  };
  for (const std::uint32_t rings : kRingsOfSensors) {
    if (!fits(metadata_.profile, rings)) continue;
    hint_ = fmt::format(
        "the packets have {} pixels a column, but the metadata's pixels_per_column is {}: it is of another sensor or "
        "mode; read it from the sensor again",
        rings, metadata_.rings);
    return;
  }
  std::vector<std::string> names;
  for (const OusterProfile& profile : ouster_profiles()) {
    if (fits(profile, metadata_.rings)) names.emplace_back(profile.name);
  }
  if (names.empty()) return;
  hint_ = fmt::format(
      "there are packets of the size of {}, but the metadata's udp_profile_lidar is {}: it is of another sensor or "
      "mode; read it from the sensor again",
      fmt::join(names, " or "), metadata_.profile.name);
}

bool OusterAssembler::is_of_this_sensor(ByteView packet, OusterHead* head) {
  if (metadata_.header == OusterHeader::kNone) return true;
  *head = ouster_head(metadata_.header, packet);
  const auto is_other = [&](std::uint64_t serial) {
    return metadata_.serial != 0 && serial != 0 && serial != metadata_.serial;
  };
  const bool is_ours = head->is_lidar && !is_other(head->serial);
  if (is_ours || is_heard_) return is_ours;
  const auto other_kind = metadata_.header == OusterHeader::kFusa ? OusterHeader::kStandard : OusterHeader::kFusa;
  const OusterHead other = ouster_head(other_kind, packet);
  if (other.is_lidar && !is_other(other.serial)) {
    hint_ = fmt::format(
        "the packets have a head of the kind {}, but the metadata's header_type is {}: read it from the sensor again",
        ouster_header_name(other_kind), ouster_header_name(metadata_.header));
  } else if (head->is_lidar) {
    hint_ = fmt::format(
        "the packets are of the Ouster with serial number {}, but the metadata is of the one with {}: its beams are "
        "others; read the metadata from the sensor that sends",
        head->serial, metadata_.serial);
  }
  return false;
}

bool OusterAssembler::add(const Datagram& datagram) {
  if (!contradiction_.empty()) throw FrameError(contradiction_);
  if (datagram.payload.size != packet_bytes()) {
    if (!is_heard_) explain_size(datagram.payload.size);
    return false;
  }
  OusterHead head;
  if (!is_of_this_sensor(datagram.payload, &head)) return false;
  is_heard_ = true;
  hint_.clear();
  if (session_ && *session_ != head.session) end_all();
  session_ = head.session;
  ByteCursor packet(datagram.payload);
  if (metadata_.header != OusterHeader::kNone) packet.bytes(kOusterHeadBytes, "head of a packet");
  bool is_dropped = false;
  for (std::uint32_t i = 0; i < metadata_.columns_per_packet; ++i) {
    const std::size_t bytes = ouster_column_bytes(metadata_.profile, metadata_.rings);
    if (!add_column(packet.bytes(bytes, "column of a packet"), head.frame)) is_dropped = true;
  }
  if (is_dropped) ++dropped_packets_;
  settle();
  return true;
}

// False for one that comes too late, or for the second time.
bool OusterAssembler::add_column(ByteView bytes, std::uint32_t frame) {
  ByteCursor column(bytes);
  const auto time_ns = column.number<std::uint64_t>("time of a column");
  const auto index = column.number<std::uint16_t>("number of a column");
  const auto status_or_frame = column.number<std::uint16_t>("status of a column");
  const bool is_legacy = metadata_.profile.is_legacy();
  if (is_legacy) column.bytes(4, "encoder of a column");
  const std::size_t pixel_bytes = metadata_.profile.pixel_bytes;
  const ByteView pixels = column.bytes(metadata_.rings * pixel_bytes, "pixels of a column");
  const bool is_valid =
      is_legacy ? column.number<std::uint32_t>("status of a column") == 0xFFFFFFFFU : (status_or_frame & 1U) != 0;
  if (!is_valid) return true;
  Turn* const turn = turn_of(is_legacy ? status_or_frame : frame, index, time_ns);
  if (turn == nullptr) return false;
  if (index >= metadata_.columns_per_frame) return true;
  if (turn->times_ns[index]) return false;
  turn->times_ns[index] = time_ns;
  ++turn->columns;
  // The window was set up anew: the metadata's is of no use.
  if (metadata_.window && !metadata_.window->holds(index)) metadata_.window.reset();
  for (std::uint32_t ring = 0; ring < metadata_.rings; ++ring) {
    add_pixel({pixels.data + ring * pixel_bytes, pixel_bytes}, ring, index, *turn);
  }
  return true;
}

// Nothing for a frame that has been handed on. One far ahead is of a sensor that counts anew, or damaged: it does not
// keep those between from being read.
OusterAssembler::Turn* OusterAssembler::turn_of(std::uint32_t frame, std::uint32_t index, std::uint64_t time_ns) {
  if (current_ && current_->number == frame) return &*current_;
  if (next_ && next_->number == frame) return &*next_;
  const std::optional<std::uint32_t> reference = current_ ? current_->number : ended_;
  if (reference && ahead_of(frame, *reference) <= kTurnsLate) return nullptr;
  if (reference && ahead_of(*reference, frame) != 1) mode_is_known_ = false;
  if (!current_) {
    current_ = new_turn(frame);
    return &*current_;
  }
  if (next_ && ahead_of(current_->number, next_->number) < ahead_of(current_->number, frame)) {
    end_current();
    current_ = std::exchange(next_, std::nullopt);
  }
  check_mode(frame, index, time_ns);
  next_ = new_turn(frame);
  return &*next_;
}

OusterAssembler::Turn OusterAssembler::new_turn(std::uint32_t frame) const {
  Turn turn;
  turn.number = frame;
  turn.times_ns.resize(metadata_.columns_per_frame);
  turn.scan.rings = metadata_.rings;
  turn.scan.points.assign(std::size_t{metadata_.rings} * metadata_.columns_per_frame, ScanPoint{});
  return turn;
}

void OusterAssembler::add_pixel(ByteView bytes, std::uint32_t ring, std::uint32_t column, Turn& turn) const {
  ScanPoint& point = turn.scan.points[std::size_t{ring} * metadata_.columns_per_frame + column];
  const OusterReturn pixel = ouster_return(metadata_.profile, bytes, metadata_.takes_farther);
  // The rings come from the top, as rows of an image.
  point.ring = static_cast<std::uint16_t>(metadata_.rings - 1 - ring);
  if (pixel.range_m == 0.0 || !metadata_.has_laser(ring)) return;
  point.intensity = pixel.reflectivity;
  const double encoder_rad = kTurn_rad * (1.0 - static_cast<double>(column) / metadata_.columns_per_frame);
  const double azimuth_rad = encoder_rad - metadata_.azimuth_deg[ring] * kRadPerDeg;
  const double altitude_rad = metadata_.altitude_deg[ring] * kRadPerDeg;
  const double beam_m = pixel.range_m - std::hypot(metadata_.beam_origin_out_m, metadata_.beam_origin_up_m);
  const double flat_m = beam_m * std::cos(altitude_rad);
  const double x_m = flat_m * std::cos(azimuth_rad) + metadata_.beam_origin_out_m * std::cos(encoder_rad);
  const double y_m = flat_m * std::sin(azimuth_rad) + metadata_.beam_origin_out_m * std::sin(encoder_rad);
  const double z_m = beam_m * std::sin(altitude_rad) + metadata_.beam_origin_up_m;
  const auto& matrix = metadata_.sensor_from_lidar;
  const auto row = [&](std::size_t i) {
    return static_cast<float>(matrix[i] * x_m + matrix[i + 1] * y_m + matrix[i + 2] * z_m + matrix[i + 3]);
  };
  point.x_m = row(0);
  point.y_m = row(4);
  point.z_m = row(8);
}

// A turn's time over a column's is the sensor's number of columns, whatever part of them came.
void OusterAssembler::check_mode(std::uint32_t next_frame, std::uint32_t next_index, std::uint64_t next_time_ns) {
  if (ahead_of(current_->number, next_frame) != 1) return;
  const auto came = [](const std::optional<std::uint64_t>& time_ns) { return time_ns.has_value(); };
  const auto& times_ns = current_->times_ns;
  const auto first = std::find_if(times_ns.begin(), times_ns.end(), came);
  const auto last = std::find_if(times_ns.rbegin(), times_ns.rend(), came);
  if (first == times_ns.end() || **last <= **first || next_time_ns <= **last) return;
  const auto first_index = first - times_ns.begin(), last_index = times_ns.rend() - last - 1;
  const double column_ns = static_cast<double>(**last - **first) / static_cast<double>(last_index - first_index);
  const double columns = static_cast<double>(next_time_ns - **first) / column_ns + static_cast<double>(first_index) -
                         static_cast<double>(next_index);
  const auto is_about = [&](std::uint32_t count) { return std::abs(columns - count) <= kEvenness * count; };
  mode_is_known_ = mode_is_known_ || is_about(metadata_.columns_per_frame);
  for (const std::uint32_t of_mode : kOusterColumns) {
    if (of_mode == metadata_.columns_per_frame || !is_about(of_mode)) continue;
    contradiction_ = fmt::format(
        "the sensor turns in {} columns, but the metadata's columns_per_frame is {}: it is of another lidar_mode; read "
        "it from the sensor again",
        of_mode, metadata_.columns_per_frame);
    current_.reset();
    next_.reset();
    throw FrameError(contradiction_);
  }
}

bool OusterAssembler::is_whole(const Turn& turn) const {
  const std::uint32_t of_frame = metadata_.columns_per_frame;
  return turn.columns == (metadata_.window ? metadata_.window->columns(of_frame) : of_frame);
}

// Of the window that the metadata tells; or where two turns one after another have all that turns have shown so far,
// for metadata may tell no window, or not that of now.
bool OusterAssembler::is_complete(const Turn& turn) {
  std::uint32_t shown = 0;
  for (std::uint32_t i = 0; i < metadata_.columns_per_frame; ++i) {
    shown_[i] = shown_[i] || turn.times_ns[i].has_value();
    if (shown_[i]) ++shown;
  }
  const auto are_most = [](std::uint32_t columns, std::uint32_t of) { return columns * 100 >= of * kComplete_percent; };
  const std::uint32_t before = std::exchange(columns_before_, turn.columns), of_frame = metadata_.columns_per_frame;
  return are_most(turn.columns, metadata_.window ? metadata_.window->columns(of_frame) : of_frame) ||
         (are_most(turn.columns, shown) && are_most(before, shown));
}

// A frame ends where the next one is well begun, and once all its columns are there. The latter holds from the time
// on when they are known to be all.
void OusterAssembler::settle() {
  if (next_ && (next_->columns >= kPacketsOfABeginning * metadata_.columns_per_packet || is_whole(*next_))) {
    end_current();
    current_ = std::exchange(next_, std::nullopt);
  }
  if (current_ && !next_ && mode_is_known_ && is_whole(*current_)) end_current();
}

void OusterAssembler::end_current() {
  Turn turn = *std::exchange(current_, std::nullopt);
  ended_ = turn.number;
  if (turn.columns == 0) return;
  std::uint64_t from_ns = std::numeric_limits<std::uint64_t>::max(), to_ns = 0;
  for (const std::optional<std::uint64_t>& time_ns : turn.times_ns) {
    if (!time_ns) continue;
    from_ns = std::min(from_ns, *time_ns);
    to_ns = std::max(to_ns, *time_ns);
  }
  turn.scan.is_complete = is_complete(turn);
  if (to_ns - from_ns > kTurnMost_ns) return;
  turn.scan.stamp_ns = stamp_of(from_ns);
  for (std::size_t i = 0; i < turn.scan.points.size(); ++i) {
    const std::optional<std::uint64_t>& time_ns = turn.times_ns[i % metadata_.columns_per_frame];
    if (time_ns) turn.scan.points[i].t_ns = static_cast<std::uint32_t>(*time_ns - from_ns);
  }
  push(std::move(turn.scan));
}

// The sensor was started or set up anew: it counts anew, and may measure other columns.
void OusterAssembler::end_all() {
  finish();
  ended_.reset();
  mode_is_known_ = false;
  columns_before_ = 0;
  std::fill(shown_.begin(), shown_.end(), false);
}

void OusterAssembler::finish() {
  if (current_) end_current();
  if (next_) {
    current_ = std::exchange(next_, std::nullopt);
    end_current();
  }
}

}  // namespace pose_wall::tools
