// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the daemon and its process of ROS 1 hand each other through a socket: parcels of a kind, a number, a type and
// bytes. Neither side trusts the other's: lengths are checked, and room is made as the bytes come.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/bags/byte_cursor.hpp"

namespace pose_wall::tools::live {

enum class ParcelKind : std::uint32_t {
  kSubscribe = 1,  // number: the queue's length; bytes: the topic. The first has the number 0 in messages
  kAdvertise = 2,  // number: 1 for a latched topic; bytes: as advertised_bytes has it. Counted likewise
  kStart = 3,      // after all of the above
  kMessage = 4,    // of the topic with this number; type: as the publisher says
  kStatus = 5,     // bytes: as status_bytes has it
};

// Its parts belong to somebody else.
struct Parcel {
  ParcelKind kind{};
  std::uint32_t number = 0;
  std::string_view type;
  ByteView bytes;
};

// roscpp refuses longer messages.
constexpr std::size_t kParcelBytesMost = 1'000'000'000;
// The longest type that is read has 40 characters; a publisher may say anything.
constexpr std::size_t kParcelTypeMost = 1024;
// Magic, kind, number, length of the type, length of the bytes, as this machine has 32 bits.
constexpr std::size_t kParcelHeadBytes = 20;

// Head and type, as they go before the bytes. Throws std::length_error for more than the above.
std::string parcel_head(const Parcel& parcel);

// Waits until all of it is sent; false where the other side is gone. For one thread at a time.
bool send_parcel(int socket, const Parcel& parcel);

class ParcelReader {
 public:
  enum class Outcome { kOpen, kClosed, kBroken };
  using Take = std::function<void(const Parcel& parcel)>;

  // Reads once what is there, without waiting, and hands on the parcel that it completes. kClosed: the other side is
  // gone, maybe in the middle of a parcel. kBroken: what came is no parcel, and nothing after it can be read.
  Outcome read(int socket, const Take& take);

 private:
  struct Head {
    std::uint32_t magic, kind, number, type_size, bytes_size;
  };
  bool read_head();

  std::array<std::byte, kParcelHeadBytes> raw_head_{};
  Head head_{};
  std::vector<std::byte> body_;
  std::size_t filled_ = 0;    // of head and body
  std::size_t expected_ = 0;  // of the body
};

// Parcels on their way to who may be slow: nobody waits, and of each topic the newest messages count.
class ParcelQueue {
 public:
  // messages_most: of one topic. All other kinds wait as long as it takes.
  explicit ParcelQueue(std::size_t messages_most) : messages_most_(messages_most) {}

  // False where an older message of the same topic was lost for it.
  bool push(const Parcel& parcel);
  // Sends what the socket takes now; false where the other side is gone.
  bool send(int socket);
  bool is_empty() const { return waiting_.empty(); }
  void clear();

 private:
  struct Waiting {
    ParcelKind kind;
    std::uint32_t number;
    std::string bytes;
  };

  std::size_t messages_most_;
  std::deque<Waiting> waiting_;
  std::size_t sent_ = 0;  // of the first
};

}  // namespace pose_wall::tools::live
