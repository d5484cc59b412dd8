// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/one_sender.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

#include "io/language/language.hpp"
#include "io/packets/sensors.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kCandidatesMax = 8;  // sensors at once, until one is decided for
constexpr std::size_t kKnownMax = 64;      // senders whose words are kept
// Scans of one sender without a whole one, as of a sensor that loses many packets: then it is the one.
constexpr std::size_t kScansMax = 3;
// A bridge repeats a packet at once; a few may come between.
constexpr std::size_t kLastPackets = 4;
constexpr std::int64_t kRepeatedWithin_ns = 500'000;
// In the year 2116; differences of such times do not overflow.
constexpr std::int64_t kTimeMost_ns = std::numeric_limits<std::int64_t>::max() / 2;

std::string address_text(std::uint32_t address) {
  return fmt::format("{}.{}.{}.{}", address >> 24U, address >> 16U & 0xFFU, address >> 8U & 0xFFU, address & 0xFFU);
}

std::string card_text(std::uint64_t card) {
  std::string text;
  for (int shift = 40; shift >= 0; shift -= 8)
    text += fmt::format("{}{:02x}", text.empty() ? "" : ":", card >> shift & 0xFFU);
  return text;
}

// RoboSense's and LSLidar's packets about the sensor begin alike; ports that its data go to stand in both behind
// byte 24.
constexpr std::size_t kDevicePortsAt = 24, kDevicePorts = 4;

bool is_device_packet(ByteView payload) {
  return payload.size > kDevicePortsAt + 2 * kDevicePorts && little_endian_at(payload, 0, 4) == 0x5A00FFA5U;
}

bool names_port(const std::vector<std::byte>& payload, std::uint16_t port) {
  for (std::size_t i = 0; i < kDevicePorts; ++i) {
    const std::size_t at = kDevicePortsAt + 2 * i;
    if ((std::to_integer<unsigned>(payload[at]) << 8U | std::to_integer<unsigned>(payload[at + 1])) == port)
      return true;
  }
  return false;
}

// Why it is refused; "" where it is not.
template <typename Told>
std::string add_told(ScanAssembler* assembler, const Told& told) {
  try {
    assembler->add({0, told.from, {told.payload.data(), told.payload.size()}});
  } catch (const FrameError& fault) {
    return fault.what();
  }
  return "";
}

}  // namespace

SourceIdentity identity_of_sender(const Sender& from) {
  SourceIdentity who;
  if (from.address != 0) who.address = address_text(from.address);
  who.port = from.to_port;
  who.from_port = from.port;
  if (from.card != 0) who.mac = card_text(from.card);
  if (!from.frame_id.empty()) who.frame_id = from.frame_id;
  return who;
}

OneSender::OneSender(Make make, std::string wanted) : make_(std::move(make)), gate_(std::move(wanted)) {}

const SourceIdentity& OneSender::identity_of(const Sender& from) {
  const auto known = std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.from == from; });
  if (known != known_.end()) return known->who;
  if (known_.size() == kKnownMax) known_.pop_front();
  known_.push_back({from, identity_of_sender(from)});
  return known_.back().who;
}

bool OneSender::is_repeated(Candidate* candidate, const Datagram& datagram) {
  const ByteView payload = datagram.payload;
  std::deque<Packet>& last_ones = candidate->last_ones;
  for (const Packet& last : last_ones) {
    if (std::abs(datagram.captured_ns - last.captured_ns) <= kRepeatedWithin_ns &&
        last.payload.size() == payload.size && std::memcmp(last.payload.data(), payload.data, payload.size) == 0) {
      return true;
    }
  }
  Packet oldest;  // its memory is used again
  if (last_ones.size() == kLastPackets) {
    oldest = std::move(last_ones.front());
    last_ones.pop_front();
  }
  oldest.captured_ns = datagram.captured_ns;
  oldest.payload.assign(payload.data, payload.data + payload.size);
  last_ones.push_back(std::move(oldest));
  return false;
}

bool OneSender::is_data_of_sensor(const Datagram& datagram) const {
  return datagram.payload.size == data_bytes_ || recognised_title(datagram) != nullptr;
}

bool OneSender::add(const Datagram& datagram) {
  if (datagram.captured_ns < 0 || datagram.captured_ns > kTimeMost_ns) {
    throw FrameError(say("a packet of the time {} ns; 0 to {} are allowed", datagram.captured_ns, kTimeMost_ns));
  }
  if (is_device_packet(datagram.payload)) return add_device(datagram);
  const SourceIdentity& who = identity_of(datagram.from);
  Candidate* const candidate = gate_.may_be(who) ? candidate_of(datagram.from) : nullptr;
  if (candidate == nullptr) {
    if (gate_.may_be(who) && chosen_ == nullptr) return begin(datagram);
    if (is_data_of_sensor(datagram)) gate_.hear(who);
    return false;
  }
  if (datagram.payload.size == candidate->data_bytes && is_repeated(candidate, datagram)) return true;
  return add_to(candidate, datagram);
}

bool OneSender::begin(const Datagram& datagram) {
  if (!spare_) spare_ = make_();
  if (!spare_) return false;
  if (candidates_.size() == kCandidatesMax) {  // those that cannot be read give way, then the one that began first
    const auto bad =
        std::find_if(candidates_.begin(), candidates_.end(), [](const auto& c) { return !c->fault.empty(); });
    candidates_.erase(bad != candidates_.end() ? bad : candidates_.begin());
  }
  auto candidate = std::make_unique<Candidate>();
  candidate->from = datagram.from;
  candidate->inner = std::move(spare_);
  Candidate* const begun = candidate.get();
  candidates_.push_back(std::move(candidate));
  const bool is_data = add_to(begun, datagram);
  if (!begun->fault.empty()) return false;  // it is known, so that it is counted and not tried anew
  if (!is_data) {
    spare_ = std::move(begun->inner);
    candidates_.pop_back();
    return false;
  }
  data_bytes_ = begun->data_bytes = datagram.payload.size;
  is_repeated(begun, datagram);
  for (const Told& told : told_) tell(begun, told);
  return true;
}

// True where it is the candidate's data.
bool OneSender::add_to(Candidate* candidate, const Datagram& datagram) {
  if (!candidate->fault.empty()) {
    const bool is_all =
        std::all_of(candidates_.begin(), candidates_.end(), [](const auto& c) { return !c->fault.empty(); });
    if (is_all || candidate == chosen_) throw FrameError(candidate->fault);
    return false;
  }
  bool is_data = false;
  try {
    is_data = candidate->inner->add(datagram);
  } catch (const FrameError& fault) {
    candidate->fault = fault.what();
    return add_to(candidate, datagram);
  }
  if (is_data) gate_.hear(identity_of(candidate->from));
  gather(candidate);
  if (candidate == chosen_) push_scans(candidate);
  if (chosen_ == nullptr && (candidate->is_whole || candidate->scans.size() >= kScansMax)) decide_for(candidate);
  return is_data;
}

void OneSender::push_scans(Candidate* candidate) {
  for (Scan& scan : candidate->scans) push(std::move(scan));
  candidate->scans.clear();
}

void OneSender::gather(Candidate* candidate) {
  while (std::optional<Scan> scan = candidate->inner->take()) {
    candidate->is_whole = candidate->is_whole || scan->is_complete;
    candidate->scans.push_back(std::move(*scan));
  }
}

void OneSender::decide_for(Candidate* candidate) {
  push_scans(candidate);
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(),
                                   [&](const auto& other) { return other.get() != candidate; }),
                    candidates_.end());
  chosen_ = candidate;
  gate_.decide(identity_of(candidate->from));
}

// Between two sensors of one address the port that it names decides.
bool OneSender::belongs(const Told& told, const Candidate& candidate) const {
  if (!may_be_one_device(told.from, candidate.from)) return false;
  const SourceIdentity who = identity_of_sender(told.from);
  const std::vector<HeardSource>& heard = gate_.heard();
  const auto of_device = std::count_if(heard.begin(), heard.end(), [&](const HeardSource& other) {
    return other.who.address == who.address && other.who.mac == who.mac;
  });
  return of_device < 2 || names_port(told.payload, candidate.from.to_port);
}

void OneSender::tell(Candidate* candidate, const Told& told) const {
  if (candidate->fault.empty() && belongs(told, *candidate)) {
    candidate->fault = add_told(candidate->inner.get(), told);
  }
}

bool OneSender::add_device(const Datagram& datagram) {
  Told told{datagram.from, {datagram.payload.data, datagram.payload.data + datagram.payload.size}};
  bool is_taken = false;
  for (const auto& candidate : candidates_) {
    if (!belongs(told, *candidate)) continue;
    add_to(candidate.get(), datagram);
    is_taken = true;
    if (chosen_ != nullptr) break;
  }
  const auto same = std::find_if(told_.begin(), told_.end(), [&](const Told& t) { return t.from == told.from; });
  if (same != told_.end()) {
    *same = std::move(told);
  } else if (told_.size() < kCandidatesMax) {
    told_.push_back(std::move(told));
  }
  return is_taken;
}

OneSender::Candidate* OneSender::candidate_of(const Sender& from) {
  const auto found =
      std::find_if(candidates_.begin(), candidates_.end(), [&](const auto& c) { return c->from == from; });
  return found != candidates_.end() ? found->get() : nullptr;
}

void OneSender::finish() {
  std::string fault;
  if (candidates_.empty() && !told_.empty()) {  // it knows what its data would be
    if (!spare_) spare_ = make_();
    if (spare_) add_told(spare_.get(), told_.front());
  }
  for (const auto& candidate : candidates_) {
    try {
      if (candidate->fault.empty()) candidate->inner->finish();
    } catch (const FrameError& refused) {
      candidate->fault = refused.what();
    }
    if (fault.empty()) fault = candidate->fault;
    gather(candidate.get());
  }
  if (chosen_ == nullptr) {
    const auto best = std::max_element(candidates_.begin(), candidates_.end(), [](const auto& a, const auto& b) {
      return std::make_pair(a->is_whole, a->scans.size()) < std::make_pair(b->is_whole, b->scans.size());
    });
    if (best != candidates_.end() && !(*best)->scans.empty()) decide_for(best->get());
  } else {
    push_scans(chosen_);
  }
  if (!fault.empty() && (chosen_ == nullptr || !chosen_->fault.empty())) throw FrameError(fault);
}

const char* OneSender::kind() const {
  if (!candidates_.empty()) return candidates_.front()->inner->kind();
  return spare_ ? spare_->kind() : "packets of no known sensor";
}

bool OneSender::stamps_are_of_arrival() const {
  return candidates_.empty() || candidates_.front()->inner->stamps_are_of_arrival();
}

std::string OneSender::hint() const {
  const ScanAssembler* const asked = candidates_.empty() ? spare_.get() : candidates_.front()->inner.get();
  std::string hint = asked != nullptr ? asked->hint() : "";
  if (!hint.empty() || !candidates_.empty() || told_.empty()) return hint;
  return say("there are packets in which a sensor describes itself, from {}, but none of its data",
             identity_of_sender(told_.front().from).text());
}

}  // namespace pose_wall::tools
