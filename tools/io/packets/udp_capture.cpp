// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/udp_capture.hpp"

#include "io/bags/decompress.hpp"

#if POSE_WALL_HAS_PCAP
#include <fmt/format.h>
#include <pcap/pcap.h>

#include <array>
#include <cstdio>
#include <utility>

#include "io/language/language.hpp"
#include "io/packets/ip_packets.hpp"

namespace pose_wall::tools {
namespace {

LinkType link_type(int number) {
  switch (number) {
    case DLT_NULL:
    case DLT_LOOP:
      return LinkType::kNull;
    case DLT_EN10MB:
      return LinkType::kEthernet;
    case DLT_RAW:
      return LinkType::kRaw;
    case DLT_LINUX_SLL:
      return LinkType::kLinuxCooked;
#ifdef DLT_LINUX_SLL2
    case DLT_LINUX_SLL2:
      return LinkType::kLinuxCooked2;
#endif
    default:
      break;
  }
  throw FrameError(
      say("the capture's link layer is of type {}; Ethernet, Linux cooked, raw IP and loopback "
          "are read",
          number));
}

class PcapFile : public DatagramSource {
 public:
  explicit PcapFile(const std::string& path) : pcap_(open(path)), packets_(link_type(pcap_datalink(pcap_.get()))) {}

  std::optional<Datagram> next() override {
    while (!ended_) {
      const long offset = std::ftell(pcap_file(pcap_.get()));
      pcap_pkthdr* header = nullptr;
      const unsigned char* packet = nullptr;
      const int status = pcap_next_ex(pcap_.get(), &header, &packet);
      if (status != 1) ended_ = true;
      if (status == PCAP_ERROR_BREAK) break;
      if (status != 1) refuse_rest(offset);
      // Opened with nanoseconds: tv_usec counts them.
      std::int64_t captured_ns = 0;
      if (__builtin_mul_overflow(std::int64_t{header->ts.tv_sec}, std::int64_t{1'000'000'000}, &captured_ns) ||
          __builtin_add_overflow(captured_ns, std::int64_t{header->ts.tv_usec}, &captured_ns)) {
        ended_ = true;
        throw FrameError(say("offset {}: a time of {} s", offset, std::int64_t{header->ts.tv_sec}));
      }
      const ByteView bytes{reinterpret_cast<const std::byte*>(packet), header->caplen};
      if (std::optional<Datagram> datagram = packets_.add(bytes, captured_ns)) {
        is_any_whole_ = true;
        return datagram;
      }
      if (header->caplen < header->len) cut_ = {cut_.packets + 1, header->caplen, header->len};
    }
    if (!is_any_whole_ && cut_.packets > 0) {
      const Cut cut = std::exchange(cut_, Cut{});
      throw FrameError(
          say("the recording program cut packets: {} were kept to {} bytes of {} and less. Record them whole (a snap "
              "length of 0, tcpdump -s 0)",
              cut.packets, cut.kept_bytes, cut.sent_bytes));
    }
    return std::nullopt;
  }

 private:
  struct Cut {
    std::uint64_t packets = 0;
    std::uint32_t kept_bytes = 0, sent_bytes = 0;  // of the last one
  };

  // libpcap hands out packets of one link layer only. No program parts such a file: tshark -Y keeps the description
  // of each interface, and refuses to write it as pcap (4.0.17, tried 2026-11-29).
  [[noreturn]] void refuse_rest(long offset) {
    const std::string why = pcap_geterr(pcap_.get());
    if (why.find("type of the first interface") != std::string::npos) {
      throw FrameError(say(
          "offset {}: the capture is of interfaces with different link layers, and only packets before the second "
          "one's description can be read. Record the sensor's interface alone: tcpdump -i NAME -w ONE.pcap; or all as "
          "one: tcpdump -i any -w ALL.pcap",
          offset));
    }
    throw FrameError(say("offset {}: the capture is cut: {}", offset, why));
  }

  using Pcap = std::unique_ptr<pcap_t, decltype(&pcap_close)>;

  static Pcap open(const std::string& path) {
    std::array<char, PCAP_ERRBUF_SIZE> error{};
    Pcap pcap(pcap_open_offline_with_tstamp_precision(path.c_str(), PCAP_TSTAMP_PRECISION_NANO, error.data()),
              pcap_close);
    if (!pcap) throw FrameError(fmt::format("offset 0: {}", error.data()));
    return pcap;
  }

  Pcap pcap_;
  IpPackets packets_;
  Cut cut_;
  bool is_any_whole_ = false;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<DatagramSource> open_udp_capture(const std::string& path) {
  return std::make_unique<PcapFile>(path);
}

}  // namespace pose_wall::tools

#else

namespace pose_wall::tools {

std::unique_ptr<DatagramSource> open_udp_capture(const std::string& /*path*/) {
  throw FrameError(missing_support("captures of packets", "libpcap-dev", "POSE_WALL_READ_PCAP"));
}

}  // namespace pose_wall::tools

#endif
