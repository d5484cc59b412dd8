// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

namespace pose_wall {

// Borrowed memory and its length. Owns nothing, checks nothing: indices come from loops over size().
template <typename T>
class Span {
 public:
  Span() = default;
  Span(T* data, std::uint32_t size) : data_(data), size_(size) {}

  T* data() const { return data_; }
  std::uint32_t size() const { return size_; }
  T& operator[](std::uint32_t i) const { return data_[i]; }
  T* begin() const { return data_; }
  T* end() const { return data_ + size_; }
  Span first(std::uint32_t count) const { return Span(data_, count); }
  operator Span<const T>() const { return Span<const T>(data_, size_); }

  // By value and with the length at hand: neither may be thought to change while bytes are written.
  void fill(T value) const {
    T* const end = data_ + size_;
    for (T* at = data_; at != end; ++at) *at = value;
  }

 private:
  T* data_ = nullptr;
  std::uint32_t size_ = 0;
};

}  // namespace pose_wall
