// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Sources: see lslidar_models.cpp, and lslidar_ch_driver.cpp of the same driver.

#include "io/packets/lslidar_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kDeviceBytes = 1206;
constexpr std::uint32_t kDeviceBegin = 0x5A00FFA5;
// A laser stands at most so far beside its design; the maker's drivers take no other angle either.
constexpr double kBesideDesign_deg = 1.5;
// Columns of lasers stand 3 to 5 degrees beside each other.
constexpr int kColumn_cdeg = 1500;

std::uint8_t device_byte(ByteView device, std::size_t offset) {
  return std::to_integer<std::uint8_t>(device.data[offset]);
}

int big_endian_at(ByteView device, std::size_t offset) {
  return device_byte(device, offset) << 8 | device_byte(device, offset + 1);
}

double angle_deg(ByteView device, std::size_t offset) {
  return 0.01 * static_cast<std::int16_t>(big_endian_at(device, offset));
}

// The design with the angles that stand at `offset` in this order; nothing where one of them is not near its design.
std::optional<BeamTable> with_angles(const BeamTable& design, ByteView device, std::size_t offset, bool in_halves) {
  BeamTable beams = design;
  const std::size_t lasers = beams.lasers.size();
  for (std::size_t i = 0; i < lasers; ++i) {
    const std::size_t place = in_halves ? i / 2 + i % 2 * (lasers / 2) : i;
    const double told_deg = angle_deg(device, offset + 2 * place);
    if (std::abs(told_deg - beams.lasers[i].elevation_deg) > kBesideDesign_deg) return std::nullopt;
    beams.lasers[i].elevation_deg = told_deg;
  }
  return beams;
}

std::optional<BeamTable> c16_near(const BeamTable& design, ByteView device) {
  // Firmware 2 has them at 234, 2.8 and 3 at 245.
  std::optional<BeamTable> found = with_angles(design, device, 245, false);
  return found ? found : with_angles(design, device, 234, false);
}

BeamTable c16_of(ByteView device, const BeamTable* named) {
  for (const BeamTable* const design :
       {&lslidar_traits(LslidarModel::kC16V3).beams, &beam_table("lslidar-c16-v3-narrow")}) {
    const std::optional<BeamTable> found = c16_near(*design, device);
    if (!found) continue;
    if (named != nullptr && design->highest_deg() != named->highest_deg()) {
      throw FrameError(
          say("the lasers of the LSLidar C16 are said to point up to {:.0f} degrees, but its device packet "
              "says {:.0f}",
              named->highest_deg(), design->highest_deg()));
    }
    return *found;
  }
  if (named != nullptr) return *named;
  throw FrameError(
      tr("the device packet of the LSLidar C16 holds no angles, or angles that are neither within 1.5 degrees of those "
         "from -15 to 15 nor of those from -10 to 10; name lslidar_c16_15deg or lslidar_c16_10deg, as its type plate "
         "says"));
}

// Of two's complement and of sign and size, as the maker's two drivers read it, the one that is an angle of a column.
double column_deg(ByteView device, std::size_t offset) {
  const int bits = big_endian_at(device, offset);
  if (bits <= kColumn_cdeg) return 0.01 * bits;
  if (bits >= 0x10000 - kColumn_cdeg) return 0.01 * (bits - 0x10000);
  if (bits >= 0x8000 && bits <= 0x8000 + kColumn_cdeg) return 0.01 * (0x8000 - bits);
  throw FrameError(
      say("the device packet of the LSLidar C32 has 0x{:04x} as the angle of a column of lasers, which no "
          "driver of its maker reads as one",
          bits));
}

// Its lasers stand in two columns by turns of elevation, which are two and two in the order of firing: so the two later
// drivers (f29e947a, and lidar_c32_V2.01 in carlowiesse/LS-LIDAR-C32-ROS2). They agree within these limits.
void set_columns(BeamTable* beams, ByteView device) {
  const double even_deg = column_deg(device, 190), odd_deg = column_deg(device, 186), apart_deg = even_deg - odd_deg;
  const bool are_written = even_deg != 0.0 || odd_deg != 0.0;
  if (are_written && (apart_deg <= 3.0 || apart_deg >= 4.6)) {
    throw FrameError(
        say("the device packet of the LSLidar C32 puts the columns of its lasers {:.2f} degrees apart; the "
            "drivers of its maker agree for 3 to 4.6 degrees alone",
            apart_deg));
  }
  for (std::size_t i = 0; i < beams->lasers.size(); ++i) {
    beams->lasers[i].azimuth_deg = lslidar_c32_column(false, i) == 0 ? even_deg : odd_deg;
  }
}

void set_dense_columns(BeamTable* beams, ByteView device) {
  const std::array<double, 4> angles_deg = {column_deg(device, 186), column_deg(device, 190), column_deg(device, 188),
                                            column_deg(device, 192)};
  for (std::size_t i = 0; i < beams->lasers.size(); ++i) {
    beams->lasers[i].azimuth_deg = angles_deg.at(lslidar_c32_column(true, i));
  }
}

BeamTable c32_of(ByteView device) {
  if (device_byte(device, 1202) != 3) {
    throw FrameError(
        say("the device packet of the LSLidar C32 is of firmware {}; only firmware 3 is read of those with packets of "
            "1206 bytes, because the maker's drivers disagree about the others",
            device_byte(device, 1202)));
  }
  const bool is_dense = device_byte(device, 1195) == 0x21;
  const BeamTable& design = beam_table(is_dense ? "lslidar-c32-v3-dense" : "lslidar-c32-v3");
  // The older driver has them in the order of firing, the newer one the lower half first.
  std::optional<BeamTable> found = with_angles(design, device, 245, false);
  if (!found) found = with_angles(design, device, 245, true);
  if (!found) {
    throw FrameError(
        tr("the device packet of the LSLidar C32 holds no angles within 1.5 degrees of its design: it is not known "
           "where its lasers point"));
  }
  if (is_dense) {
    set_dense_columns(&*found, device);
  } else {
    set_columns(&*found, device);
  }
  found->ranges.unit_m = device_byte(device, 1203) > 0x4F ? 0.004 : 0.0025;
  return *found;
}

}  // namespace

bool is_lslidar_device(ByteView payload) {
  return lslidar_packet(payload).size == kDeviceBytes && little_endian_at(payload, 0, 4) == kDeviceBegin;
}

BeamTable lslidar_beams_of(ByteView device, LslidarModel model, const BeamTable* named) {
  return model == LslidarModel::kC16V3 ? c16_of(device, named) : c32_of(device);
}

std::string lslidar_filter_of(ByteView device, LslidarModel model) {
  if (lslidar_traits(model).is_first_kind()) return "";
  const bool is_v5 = model == LslidarModel::kC16V5 || model == LslidarModel::kC32V5;
  std::string filter;
  if (const int level = device_byte(device, is_v5 ? 49 : 110)) {
    filter += fmt::format(", which removes rain, fog and dust (level {})", level);
  }
  if (const int level = is_v5 ? device_byte(device, 51) : 0) {
    filter += fmt::format(", which removes tails (level {})", level);
  }
  return filter;
}

LslidarFaces lslidar_faces_of(ByteView device) {
  LslidarFaces faces = {{}, angle_deg(device, 240)};
  for (std::size_t i = 0; i < 4; ++i) faces.face_deg[i] = angle_deg(device, 242 + 2 * i);
  // Not written: the design's.
  const bool is_written =
      std::any_of(faces.face_deg.begin(), faces.face_deg.end(), [](double angle) { return angle != 0.0; });
  if (!is_written) faces.face_deg = {0.0, -0.17, -0.34, -0.51};
  for (const double angle :
       {faces.face_deg[0], faces.face_deg[1], faces.face_deg[2], faces.face_deg[3], faces.offset_deg}) {
    if (std::abs(angle) <= kBesideDesign_deg) continue;
    throw FrameError(
        say("the device packet of the LSLidar CH128X1 has a mirror face at {:.2f} degrees; at most {} are "
            "allowed",
            angle, kBesideDesign_deg));
  }
  if (faces.face_deg[3] > 0.0) {
    throw FrameError(
        tr("the faces of the mirror rise, as those of an LSLidar CH64W or CB64S1: it is no CH128X1, and is not read"));
  }
  return faces;
}

}  // namespace pose_wall::tools
