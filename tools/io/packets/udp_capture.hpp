// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The UDP datagrams of a capture of packets (.pcap, .pcapng), put together where they were sent in fragments.

#pragma once

#include <memory>
#include <string>

#include "io/packets/datagram_source.hpp"

namespace pose_wall::tools {

// What is no UDP over IPv4 is passed over. Behind a place where the capture is cut nothing more comes. Throws
// FrameError when the file is no capture or this build has no libpcap.
std::unique_ptr<DatagramSource> open_udp_capture(const std::string& path);

}  // namespace pose_wall::tools
