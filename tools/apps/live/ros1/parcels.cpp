// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros1/parcels.hpp"

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace pose_wall::tools::live {
namespace {

// "PWP1", of this shape of parcels: daemon and node of different versions do not understand each other.
constexpr std::uint32_t kMagic = 0x31505750;
constexpr std::uint32_t kKindLast = static_cast<std::uint32_t>(ParcelKind::kStatus);
// Room is made for as much as has come already, and this.
constexpr std::size_t kRoomStep = 256 * 1024;
// A buffer of this size is kept for the next: clouds have some 5 MB.
constexpr std::size_t kRoomKept = 16 * 1024 * 1024;

bool is_for_later(int error) {
  return error == EAGAIN || error == EINTR;
}

}  // namespace

std::string parcel_head(const Parcel& parcel) {
  if (parcel.type.size() > kParcelTypeMost || parcel.bytes.size > kParcelBytesMost) {
    throw std::length_error("too long for a parcel");
  }
  const std::array<std::uint32_t, 5> words = {kMagic, static_cast<std::uint32_t>(parcel.kind), parcel.number,
                                              static_cast<std::uint32_t>(parcel.type.size()),
                                              static_cast<std::uint32_t>(parcel.bytes.size)};
  static_assert(sizeof words == kParcelHeadBytes);
  std::string head(kParcelHeadBytes, '\0');
  std::memcpy(head.data(), words.data(), sizeof words);
  return head.append(parcel.type);
}

bool send_parcel(int socket, const Parcel& parcel) {
  std::string head = parcel_head(parcel);
  // It reads the bytes only.
  std::array<iovec, 2> parts = {
      {{head.data(), head.size()}, {const_cast<std::byte*>(parcel.bytes.data), parcel.bytes.size}}};
  while (parts[0].iov_len + parts[1].iov_len > 0) {
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    const ssize_t count = sendmsg(socket, &message, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    std::size_t gone = static_cast<std::size_t>(count);
    for (iovec& part : parts) {
      const std::size_t of_this = std::min(gone, part.iov_len);
      part.iov_base = static_cast<char*>(part.iov_base) + of_this;
      part.iov_len -= of_this;
      gone -= of_this;
    }
  }
  return true;
}

ParcelReader::Outcome ParcelReader::read(int socket, const Take& take) {
  std::byte* to = raw_head_.data() + filled_;
  std::size_t room = kParcelHeadBytes - filled_;
  if (filled_ >= kParcelHeadBytes) {
    const std::size_t there = filled_ - kParcelHeadBytes;
    if (body_.size() == there) body_.resize(std::min(expected_, 2 * there + kRoomStep));
    to = body_.data() + there;
    room = std::min(body_.size(), expected_) - there;
  }
  const ssize_t count = recv(socket, to, room, MSG_DONTWAIT);
  if (count < 0 && is_for_later(errno)) return Outcome::kOpen;
  if (count <= 0) return Outcome::kClosed;
  filled_ += static_cast<std::size_t>(count);
  if (filled_ == kParcelHeadBytes && !read_head()) return Outcome::kBroken;
  if (filled_ < kParcelHeadBytes || filled_ < kParcelHeadBytes + expected_) return Outcome::kOpen;
  filled_ = 0;
  const std::string_view type(reinterpret_cast<const char*>(body_.data()), head_.type_size);
  take({static_cast<ParcelKind>(head_.kind), head_.number, type, {body_.data() + head_.type_size, head_.bytes_size}});
  if (body_.size() > kRoomKept) body_ = {};
  return Outcome::kOpen;
}

bool ParcelReader::read_head() {
  std::memcpy(&head_, raw_head_.data(), sizeof head_);
  expected_ = std::size_t{head_.type_size} + head_.bytes_size;
  return head_.magic == kMagic && head_.kind >= 1 && head_.kind <= kKindLast && head_.type_size <= kParcelTypeMost &&
         head_.bytes_size <= kParcelBytesMost;
}

bool ParcelQueue::push(const Parcel& parcel) {
  std::string bytes = parcel_head(parcel);
  bytes.append(text_of(parcel.bytes));
  const auto is_like_it = [&](const Waiting& other) {
    return other.kind == ParcelKind::kMessage && parcel.kind == ParcelKind::kMessage && other.number == parcel.number;
  };
  // What has begun to be sent must end.
  const auto begin = waiting_.begin() + (sent_ > 0 ? 1 : 0);
  const bool is_full = static_cast<std::size_t>(std::count_if(begin, waiting_.end(), is_like_it)) >= messages_most_;
  if (is_full) waiting_.erase(std::find_if(begin, waiting_.end(), is_like_it));
  waiting_.push_back({parcel.kind, parcel.number, std::move(bytes)});
  return !is_full;
}

bool ParcelQueue::send(int socket) {
  while (!waiting_.empty()) {
    const std::string& bytes = waiting_.front().bytes;
    const ssize_t count = ::send(socket, bytes.data() + sent_, bytes.size() - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) return is_for_later(errno);
    sent_ += static_cast<std::size_t>(count);
    if (sent_ < bytes.size()) continue;
    waiting_.pop_front();
    sent_ = 0;
  }
  return true;
}

void ParcelQueue::clear() {
  waiting_.clear();
  sent_ = 0;
}

}  // namespace pose_wall::tools::live
