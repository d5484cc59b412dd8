// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/ip_packets.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace pose_wall::tools {
namespace {

constexpr std::uint16_t kIpv4 = 0x0800;
// 802.1Q, 802.1ad, and the one that switches used for two tags before that.
constexpr std::array<std::uint16_t, 3> kTags = {0x8100, 0x88A8, 0x9100};
constexpr std::uint8_t kUdp = 17;
constexpr std::size_t kOpenMax = 64;
// Senders number datagrams with 16 bits: after a minute of a fast sensor the same numbers come again.
constexpr std::int64_t kFragmentsWithin_ns = 1'000'000'000;
constexpr std::size_t kFragmentBytesMax = 2 * 65'535;  // twice a datagram: parts may come twice

std::uint64_t read_card(ByteCursor& packet) {
  std::uint64_t card = 0;
  for (int i = 0; i < 6; ++i) card = card << 8U | packet.number<std::uint8_t>("address of a card");
  return card;
}

// A packet may carry tags of several networks, one behind the other.
bool pass_tags(ByteCursor& packet) {
  auto protocol = packet.number<std::uint16_t>("protocol");
  while (std::find(kTags.begin(), kTags.end(), protocol) != kTags.end()) {
    packet.bytes(2, "VLAN tag");
    protocol = packet.number<std::uint16_t>("protocol");
  }
  return protocol == kIpv4;
}

// Leaves the cursor at the IP header. A packet that is too short throws, as everywhere in these cursors.
bool pass_link_header(ByteCursor& packet, LinkType link, std::uint64_t* card) {
  switch (link) {
    case LinkType::kRaw:
      return true;
    case LinkType::kNull:
      packet.bytes(4, "link header");
      return true;
    case LinkType::kLinuxCooked: {
      packet.bytes(4, "link header");
      const auto card_bytes = packet.number<std::uint16_t>("length of an address");
      *card = read_card(packet);
      if (card_bytes != 6) *card = 0;
      packet.bytes(2, "link header");
      return pass_tags(packet);
    }
    case LinkType::kLinuxCooked2: {
      const auto protocol = packet.number<std::uint16_t>("protocol");
      packet.bytes(9, "link header");
      const auto card_bytes = packet.number<std::uint8_t>("length of an address");
      *card = read_card(packet);
      if (card_bytes != 6) *card = 0;
      packet.bytes(2, "link header");
      if (std::find(kTags.begin(), kTags.end(), protocol) == kTags.end()) return protocol == kIpv4;
      packet.bytes(2, "VLAN tag");
      return pass_tags(packet);
    }
    case LinkType::kEthernet:
      break;
  }
  packet.bytes(6, "link header");
  *card = read_card(packet);
  return pass_tags(packet);
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

std::optional<ByteView> udp_payload(ByteView content, Sender* from) {
  ByteCursor datagram(content);
  datagram.set_big_endian(true);
  from->port = datagram.number<std::uint16_t>("port");
  from->to_port = datagram.number<std::uint16_t>("port");
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
    Sender from;
    if (!pass_link_header(cursor, link_, &from.card)) return std::nullopt;
    const std::optional<IpHeader> header = read_ip_header(cursor);
    if (!header) return std::nullopt;
    std::optional<ByteView> content = header->content;
    if (header->more || header->offset != 0) {
      content = add_fragment({header->source, header->destination, header->identification}, header->content,
                             header->offset, !header->more, captured_ns);
    }
    from.address = header->source;
    if (content) content = udp_payload(*content, &from);
    if (!content) return std::nullopt;
    return Datagram{captured_ns, from, *content};
  } catch (const FrameError&) {
    return std::nullopt;  // too short for what it says it is: no datagram of a sensor
  }
}

std::optional<ByteView> IpPackets::add_fragment(const Key& key, ByteView part, std::uint32_t offset, bool is_last,
                                                std::int64_t captured_ns) {
  Fragments& fragments = open_[key];
  std::int64_t open_ns = 0;
  const bool overflows = __builtin_sub_overflow(captured_ns, fragments.began_ns, &open_ns);
  if (overflows || open_ns > kFragmentsWithin_ns || open_ns < -kFragmentsWithin_ns ||
      fragments.bytes + part.size > kFragmentBytesMax) {
    fragments = Fragments{};
  }
  if (fragments.parts.empty()) {
    fragments.age = next_age_++;
    fragments.began_ns = captured_ns;
  }
  fragments.bytes += part.size;
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
