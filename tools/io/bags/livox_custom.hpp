// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// CustomMsg, in which Livox's drivers give points with their own times.

#pragma once

#include "io/bags/cloud_message.hpp"

namespace pose_wall::tools {

// The points stay as they lie in the message, with fields offset_time (ns), x, y, z, reflectivity, tag and line. Where
// the header has no stamp, the time of the first point is it. Throws FrameError that names the place.
DecodedCloud decode_livox_custom(MessageEncoding encoding, ByteView message, const Place& place);

// As span_of_cloud().
ScanSpan span_of_livox_custom(MessageEncoding encoding, ByteView message, const Place& place);

// As source_of_cloud().
SourceIdentity source_of_livox_custom(MessageEncoding encoding, ByteView message, const Place& place);

}  // namespace pose_wall::tools
