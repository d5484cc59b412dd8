// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/robosense_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"
#include "io/packets/robosense_angles.hpp"
#include "io/packets/robosense_evidence.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kTopVersionAt = 41, kBottomVersionAt = 45, kInstallModeAt = 289, kSerialAt = 292;
constexpr std::size_t kReturnsAt = 300, kDirectionAt = 337;
constexpr std::size_t kAiryDataTypeAt = 17, kAiryLinesAt = 32, kHeliosUnitAt = 17;

std::string hex_of(ByteView bytes, std::size_t offset, std::size_t size) {
  std::string text;
  for (std::size_t i = 0; i < size; ++i) text += fmt::format("{:02X}", robosense_number(bytes, offset + i, 1));
  return text;
}

// ros_rslidar: sensors of the first firmware count in 10 mm. rs_driver knows none of them. Where nothing was written,
// ros_rslidar takes 10 mm and rs_driver 5 mm.
double first_kind_unit_m(const RoboSenseTraits& traits, ByteView device) {
  constexpr double kFirst_m = 0.01;
  const std::uint64_t version = robosense_number(device, kTopVersionAt, 3);
  if (version == 0x000000 || version == 0xFFFFFF) {
    throw FrameError(say(
        "the device packet of this {} names no firmware of its top board (bytes 41 to 43: {}): its distances may be "
        "counted in 5 or in 10 mm, and of the maker's two drivers each says another",
        traits.title, hex_of(device, kTopVersionAt, 3)));
  }
  if (version != 0xE90100 && version != 0x55AA5A) return traits.unit_m;
  if (traits.model == RoboSenseModel::kRs16) return kFirst_m;
  // Its halves of blocks are swapped in every second packet.
  throw FrameError(say("a {} of the first firmware (bytes 41 to 43: {}) is not read: the order of its lasers differs",
                       traits.title, hex_of(device, kTopVersionAt, 3)));
}

// The manuals of a Helios, and every decoder but the maker's, which takes 2.5 mm whatever is said.
double helios_unit_m(const RoboSenseTraits& traits, ByteView packet) {
  const std::uint64_t says = robosense_number(packet, kHeliosUnitAt, 1);
  if (says == 1) return traits.unit_m;
  throw FrameError(say(
      "packets of this {} name {} as the step of their distances (byte 17). By its manual 1 is 2.5 mm and 0 is 5 mm, "
      "but the maker's driver takes 2.5 mm for both: only 1 is read",
      traits.title, says));
}

double unit_m(const RoboSenseTraits& traits, ByteView packet, ByteView device) {
  if (traits.model == RoboSenseModel::kRs16 || traits.model == RoboSenseModel::kRs32) {
    return first_kind_unit_m(traits, device);
  }
  if (traits.layout == RoboSenseLayout::kHelios) return helios_unit_m(traits, packet);
  return traits.unit_m;
}

bool turns_back(const RoboSenseTraits& traits, ByteView device) {
  if (traits.model != RoboSenseModel::kBpearl && traits.model != RoboSenseModel::kBpearl4) return false;
  const std::uint64_t direction = robosense_number(device, kDirectionAt, 1);
  if (direction <= 1) return direction == 1;
  throw FrameError(
      say("the device packet of this {} names {} as its direction of rotation (byte 337); 0 and 1 are known",
          traits.title, direction));
}

std::size_t airy_lines(ByteView packet) {
  const std::uint64_t mode = robosense_number(packet, kAiryLinesAt, 1);
  if (mode == 1) return 48;
  if (mode == 2) return 96;
  if (mode == 3) throw FrameError(tr("an Airy of 192 lines is not read: the maker's driver does not read it either"));
  throw FrameError(say("packets of an Airy name {} as their kind (byte 32); 1 is 48 lines and 2 is 96 lines", mode));
}

// Groups of lasers that fire at once, by rs_driver: four of 48 lines, eight of 96.
const std::vector<double>& airy_groups_us(ByteView device, std::size_t lines) {
  static const std::vector<double> normal = {0.0,    5.712,  12.376, 19.04,  25.704, 33.32,
                                             41.888, 50.456, 59.024, 70.448, 81.872, 93.296};
  static const std::vector<double> side = {0.0,    11.424, 22.848, 34.272, 45.696, 54.264,
                                           62.832, 71.4,   79.016, 85.68,  92.344, 99.008};
  static const std::vector<double> airy_m = {0.0,   7.616, 16.184, 24.752, 33.32,  42.84,
                                             52.36, 61.88, 71.4,   79.968, 88.536, 97.104};
  if (lines == 48) return airy_m;
  const std::uint64_t mode = robosense_number(device, kInstallModeAt, 1);
  if (mode == 0) return normal;
  if (mode == 1) return side;
  if (mode == 2) return airy_m;
  throw FrameError(
      say("the device packet of an Airy names {} as its way of installation (byte 289), by which its lasers "
          "fire; 0, 1 and 2 are known",
          mode));
}

std::vector<Laser> lasers_of(const RoboSenseTraits& traits, const RoboSenseRhythm& rhythm, ByteView device,
                             std::size_t lines) {
  std::optional<std::vector<Laser>> lasers = robosense_angles(traits, device, lines);
  if (!lasers && traits.model == RoboSenseModel::kRs16 && has_no_rs16_angles(device)) lasers = robosense_rs16_design();
  if (!lasers) {
    throw FrameError(
        say("the device packet of this {} does not say where its lasers point: nothing was written there, "
            "or what stands there is no such sensor's",
            traits.title));
  }
  std::vector<double> times_us = rhythm.lasers_us;
  if (traits.layout == RoboSenseLayout::kAiry) {
    times_us.clear();
    for (const double group_us : airy_groups_us(device, lines)) times_us.insert(times_us.end(), lines / 12, group_us);
  }
  for (std::size_t k = 0; k < lasers->size(); ++k) (*lasers)[k].after_ns = 1e3 * times_us[k];
  return *lasers;
}

}  // namespace

std::size_t RoboSenseSetup::firings_of_block() const {
  return lasers.size() == 16 && returns == 1 ? 2 : 1;
}

std::size_t RoboSenseSetup::blocks_of_firing() const {
  if (lasers.size() == 16) return 1;
  return returns * lasers.size() / traits->channels();
}

std::size_t robosense_lines(const RoboSenseTraits& traits, ByteView packet) {
  return traits.layout == RoboSenseLayout::kAiry ? airy_lines(packet) : traits.lasers;
}

std::size_t robosense_returns(const RoboSenseTraits& traits, ByteView packet, ByteView device) {
  if (traits.layout == RoboSenseLayout::kAiry) return robosense_number(packet, kAiryDataTypeAt, 1) == 3 ? 2 : 1;
  // ros_rslidar: before version 08 02 09 of the bottom board there was but one return.
  const std::uint64_t bottom = robosense_number(device, kBottomVersionAt, 3);
  const bool is_first = traits.model == RoboSenseModel::kRs16 || traits.model == RoboSenseModel::kRs32;
  if (is_first && bottom != 0 && bottom < 0x080209) return 1;
  constexpr std::uint64_t kModeMost = 6;  // the nearest, of a Helios
  const std::uint64_t mode = robosense_number(device, kReturnsAt, 1);
  if (mode > kModeMost) {
    throw FrameError(say("the device packet of this {} names {} as its kind of returns (byte 300); 0 to 6 are known",
                         traits.title, mode));
  }
  return mode == 0 ? 2 : 1;
}

RoboSenseSetup robosense_setup(const std::vector<ByteView>& packets, ByteView device,
                               std::optional<RoboSenseModel> stated) {
  const RoboSenseTold told = identify_robosense(packets, device, stated);
  const ByteView packet = packets.back();
  RoboSenseSetup setup;
  setup.traits = told.traits;
  setup.returns = robosense_returns(*told.traits, packet, device);
  setup.lasers = lasers_of(*told.traits, *told.rhythm, device, robosense_lines(*told.traits, packet));
  setup.firing_us = told.rhythm->firing_us;
  setup.unit_m = unit_m(*told.traits, packet, device);
  setup.turns_back = turns_back(*told.traits, device);
  setup.step_deg = robosense_degrees_per_us(device) * setup.firing_us;
  if (!std::all_of(packets.begin(), packets.end(), [&](ByteView one) { return is_grouped_as(setup, one); })) {
    throw FrameError(
        say("the device packet of this {} says that it sends {} of each firing, but the azimuths of its "
            "blocks say otherwise: a device packet of other settings?",
            setup.traits->title, setup.returns == 2 ? tr("two returns") : tr("one return")));
  }
  return setup;
}

bool is_grouped_as(const RoboSenseSetup& setup, ByteView payload) {
  const std::size_t group = setup.blocks_of_firing(), blocks = setup.traits->blocks();
  std::size_t within_differ = 0, between_differ = 0;
  for (std::size_t block = 1; block < blocks; ++block) {
    const bool differs =
        robosense_azimuth(*setup.traits, payload, block) != robosense_azimuth(*setup.traits, payload, block - 1);
    if (differs) ++(block % group == 0 ? between_differ : within_differ);
  }
  const bool stands_still = within_differ + between_differ == 0;
  return within_differ == 0 && (stands_still || between_differ * 2 >= blocks / group - 1);
}

std::string robosense_settings(ByteView device) {
  std::string settings;
  for (const auto& [offset, size] : {std::pair<std::size_t, std::size_t>{40, 10},
                                     {kInstallModeAt, 1},
                                     {kSerialAt, 6},
                                     {kReturnsAt, 1},
                                     {kDirectionAt, 1},
                                     {468, 576},
                                     {1165, 48}}) {
    settings += text_of({device.data + offset, size});
  }
  return settings;
}

std::string robosense_serial(ByteView device) {
  const std::string serial = hex_of(device, kSerialAt, 6);
  return serial == std::string(12, '0') || serial == std::string(12, 'F') ? "" : serial;
}

}  // namespace pose_wall::tools
