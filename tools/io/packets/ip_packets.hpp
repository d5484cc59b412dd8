// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// UDP out of link-layer packets: headers passed over, fragments of IPv4 put together.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "io/packets/datagram_source.hpp"

namespace pose_wall::tools {

// As captures number the layer below IP.
enum class LinkType { kNull, kEthernet, kRaw, kLinuxCooked, kLinuxCooked2 };

class IpPackets {
 public:
  explicit IpPackets(LinkType link) : link_(link) {}

  // The datagram that this packet is, or completes; its payload lasts until the next call.
  std::optional<Datagram> add(ByteView packet, std::int64_t captured_ns);

 private:
  struct Fragments {
    std::map<std::uint32_t, Bytes> parts;  // by offset
    std::uint32_t size = 0;                // 0: the last part has not come
    std::uint64_t age = 0;
    std::int64_t began_ns = 0;
    std::size_t bytes = 0;
  };
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint16_t>;  // source, destination, identification

  std::optional<ByteView> add_fragment(const Key& key, ByteView part, std::uint32_t offset, bool is_last,
                                       std::int64_t captured_ns);
  bool put_together(const Fragments& fragments);
  void forget_oldest();

  LinkType link_;
  std::map<Key, Fragments> open_;
  std::uint64_t next_age_ = 0;
  Bytes whole_;
};

}  // namespace pose_wall::tools
