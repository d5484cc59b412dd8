// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Messages as the bytes that go over the wire, for any type by its name: Cyclone neither packs nor unpacks them.
//
// The messages of ROS are written and read by one description for all (ros_messages.hpp, message_cursor.hpp), so that
// Cyclone needs no types of its own.

#pragma once

#include <string>

#include "io/bags/byte_cursor.hpp"

struct ddsi_sertype;
struct ddsi_serdata;

namespace pose_wall::tools::live {

// For dds_create_topic_sertype, which takes it over.
ddsi_sertype* new_raw_type(const std::string& type_name);

// bytes: the message behind its four bytes of CDR head. For dds_writecdr, which takes it over; null without memory.
ddsi_serdata* new_raw_sample(const ddsi_sertype* type, const std::string& bytes);

// Valid as long as the sample. Empty where it is no message but the end of an instance.
ByteView raw_bytes(const ddsi_serdata* sample);

}  // namespace pose_wall::tools::live
