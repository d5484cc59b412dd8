// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Who sent something, and the one rule of who is who: one sender is read, and every other one is named and refused, in
// files and live alike. No input is ever a mixture of two sensors.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pose_wall::tools {

// What an input tells of a sender; what it does not tell stays empty.
struct SourceIdentity {
  std::string address;                  // "192.168.1.201"
  std::uint16_t port = 0;               // that it sends to; 0: not told
  std::uint16_t from_port = 0;          // that it sends from; behind a router it alone may tell
  std::string mac;                      // "02:00:00:00:00:01"
  std::string serial;                   // that its packets carry
  std::optional<std::string> frame_id;  // "" is one, too
  std::optional<std::uint8_t> lidar_id;

  // "192.168.1.201:2368, serial 1220", "frame_id lidar_left, lidar_id 1"
  std::string text() const;

  // Whether `name` means it: its text, one part of it with or without the word before ("frame_id lidar_left",
  // "lidar_left"), or its address without the port. A port, which is a bare number, needs its address.
  bool is_named(std::string_view name) const;
};

bool operator==(const SourceIdentity& a, const SourceIdentity& b);
inline bool operator!=(const SourceIdentity& a, const SourceIdentity& b) {
  return !(a == b);
}

// As messages of ROS tell it: frames of ROS before 2012 begin with a slash, which tf2 does not know.
std::string frame_id_of(std::string_view in_header);

struct HeardSource {
  SourceIdentity who;
  std::uint64_t count = 0;  // of its datagrams or messages
};

// Is told of each source heard and decides for one, for good: the first for which `decide` is called, or `admits`.
// Where `wanted` names one, it decides for no other.
class SourceGate {
 public:
  explicit SourceGate(std::string wanted = "") : wanted_(std::move(wanted)) {}

  // Counts; at most kSourcesNamed are told apart in heard(), the rest is counted in others().
  void hear(const SourceIdentity& from);

  // Whether it is, or could still become, the one that is read.
  bool may_be(const SourceIdentity& from) const;

  // It gave the first cloud or turn that is whole. False when another one is read, or wanted.
  bool decide(const SourceIdentity& from);

  // Where one message is a whole cloud: both.
  bool admits(const SourceIdentity& from) {
    hear(from);
    return decide(from);
  }

  const std::string& wanted() const { return wanted_; }
  const std::optional<SourceIdentity>& chosen() const { return chosen_; }
  const std::vector<HeardSource>& heard() const { return heard_; }
  std::uint64_t others() const { return others_; }

  // Of those heard and not read, others() among them.
  std::uint64_t refused() const;

  // What tells it apart from the others heard, as --source takes it: "lidar_id 1".
  std::string name_of(const SourceIdentity& who) const;

  // "2 sources on /points: frame_id lidar_left is read; frame_id lidar_right (10 messages) is not; --source chooses".
  // Empty while there is one. `where` stands behind "sources" ("on /points"; may be empty), `one` is what is counted
  // ("message"; empty: without counts, as what is said once), `chooser` what names the one that is read.
  std::string note(std::string_view where, std::string_view one, std::string_view chooser = "--source") const;

  // Why `wanted` cannot be had: nobody heard is meant by it, or several are. Empty where one is.
  std::string fault(std::string_view where, std::string_view one) const;

 private:
  std::string wanted_;
  std::optional<SourceIdentity> chosen_;
  std::vector<HeardSource> heard_;
  std::uint64_t others_ = 0;
};

// Who sends under ever new names must not fill the memory.
constexpr std::size_t kSourcesNamed = 16;

}  // namespace pose_wall::tools
