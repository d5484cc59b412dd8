// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/ip_packets.hpp"

#include <algorithm>
#include <utility>

namespace pose_wall::tools {
namespace {

constexpr std::uint16_t kIpv4 = 0x0800;
constexpr std::uint16_t kVlan = 0x8100;
constexpr std::uint8_t kUdp = 17;
constexpr std::size_t kOpenMax = 64;

// Leaves the cursor at the IP header. A packet that is too short throws, as everywhere in these cursors.
bool pass_link_header(ByteCursor& packet, LinkType link) {
  switch (link) {
    case LinkType::kRaw:
      return true;
    case LinkType::kNull:
      packet.bytes(4, "link header");
      return true;
    case LinkType::kLinuxCooked:
      packet.bytes(14, "link header");
      return packet.number<std::uint16_t>("protocol") == kIpv4;
    case LinkType::kLinuxCooked2: {
      const auto protocol = packet.number<std::uint16_t>("protocol");
      packet.bytes(18, "link header");
      return protocol == kIpv4;
    }
    case LinkType::kEthernet:
      break;
  }
  packet.bytes(12, "link header");
  auto protocol = packet.number<std::uint16_t>("protocol");
  if (protocol == kVlan) {
    packet.bytes(2, "VLAN tag");
    protocol = packet.number<std::uint16_t>("protocol");
  }
  return protocol == kIpv4;
}

struct IpHeader {
  std::uint32_t source = 0, destination = 0;
  std::uint16_t identification = 0;
  std::uint32_t offset = 0;
  bool more = false;
  ByteView content;
};

std::optional<IpHeader> read_ip_header(ByteCursor& packet) {
  const auto first = packet.number<std::uint8_t>("version");
  const std::size_t header_bytes = 4U * (first & 0x0FU);
  packet.bytes(1, "service");
  const auto total_bytes = packet.number<std::uint16_t>("length");
  if (first >> 4U != 4 || header_bytes < 20 || total_bytes < header_bytes) return std::nullopt;
  IpHeader header;
  header.identification = packet.number<std::uint16_t>("identification");
  const auto fragment = packet.number<std::uint16_t>("fragment");
  header.offset = 8U * (fragment & 0x1FFFU);
  header.more = (fragment & 0x2000U) != 0;
  packet.bytes(1, "time to live");
  const auto protocol = packet.number<std::uint8_t>("protocol");
  packet.bytes(2, "checksum");
  header.source = packet.number<std::uint32_t>("source");
  header.destination = packet.number<std::uint32_t>("destination");
  packet.bytes(header_bytes - 20, "options");
  header.content = packet.bytes(total_bytes - header_bytes, "content");
  if (protocol != kUdp) return std::nullopt;
  return header;
}

std::optional<ByteView> udp_payload(ByteView content) {
  ByteCursor datagram(content);
  datagram.set_big_endian(true);
  datagram.bytes(4, "ports");
  const auto bytes = datagram.number<std::uint16_t>("length");
  datagram.bytes(2, "checksum");
  if (bytes < 8) return std::nullopt;
  return datagram.bytes(bytes - 8U, "payload");
}

}  // namespace

std::optional<Datagram> IpPackets::add(ByteView packet, std::int64_t captured_ns) {
  try {
    ByteCursor cursor(packet);
    cursor.set_big_endian(true);
    if (!pass_link_header(cursor, link_)) return std::nullopt;
    const std::optional<IpHeader> header = read_ip_header(cursor);
    if (!header) return std::nullopt;
    std::optional<ByteView> content = header->content;
    if (header->more || header->offset != 0) {
      content = add_fragment({header->source, header->destination, header->identification}, header->content,
                             header->offset, !header->more);
    }
    if (content) content = udp_payload(*content);
    if (!content) return std::nullopt;
    return Datagram{captured_ns, header->source, *content};
  } catch (const FrameError&) {
    return std::nullopt;  // too short for what it says it is: no datagram of a sensor
  }
}

std::optional<ByteView> IpPackets::add_fragment(const Key& key, ByteView part, std::uint32_t offset, bool is_last) {
  Fragments& fragments = open_[key];
  if (fragments.parts.empty()) fragments.age = next_age_++;
  fragments.parts.insert_or_assign(offset, Bytes(part.data, part.data + part.size));
  if (is_last) fragments.size = offset + static_cast<std::uint32_t>(part.size);
  if (fragments.size == 0 || !put_together(fragments)) {
    if (open_.size() > kOpenMax) forget_oldest();
    return std::nullopt;
  }
  open_.erase(key);
  return ByteView{whole_.data(), whole_.size()};
}

bool IpPackets::put_together(const Fragments& fragments) {
  whole_.clear();
  for (const auto& [offset, part] : fragments.parts) {
    if (offset != whole_.size()) return false;
    whole_.insert(whole_.end(), part.begin(), part.end());
  }
  return whole_.size() == fragments.size;
}

void IpPackets::forget_oldest() {
  open_.erase(std::min_element(open_.begin(), open_.end(),
                               [](const auto& a, const auto& b) { return a.second.age < b.second.age; }));
}

}  // namespace pose_wall::tools
