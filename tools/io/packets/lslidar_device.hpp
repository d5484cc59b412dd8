// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What an LSLidar says of itself about once a second, by a port of its own (2369): device packets, DIFOP in the maker's
// words.

#pragma once

#include <array>
#include <optional>
#include <string>

#include "io/bags/byte_cursor.hpp"
#include "io/beams/beam_table.hpp"
#include "io/packets/lslidar_models.hpp"

namespace pose_wall::tools {

bool is_lslidar_device(ByteView payload);

// The lasers of a sensor of firmware 2 or 3 by its device packet: their angles and their unit. Of a C16 `named` is the
// design that was said to be its, or none. Throws FrameError for what cannot be known from it, or contradicts that.
BeamTable lslidar_beams_of(ByteView device, LslidarModel model, const BeamTable* named);

// "" or what a sensor of firmware 4 or 5 leaves out: ", which removes rain, fog and dust (level 2)".
std::string lslidar_filter_of(ByteView device, LslidarModel model);

// Angles of the four mirror faces of a CH128X1, and what its lasers of every other group stand higher.
struct LslidarFaces {
  std::array<double, 4> face_deg;
  double offset_deg;
};
LslidarFaces lslidar_faces_of(ByteView device);

}  // namespace pose_wall::tools
