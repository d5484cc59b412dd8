// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Numbers of a page as base64 of their little-endian bytes: a tenth of the text, and read at once.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools::report {

std::string base64(std::string_view bytes);

// One typed array of the page.
template <typename Number>
class Column {
 public:
  template <typename Value>
  void add(Value value) {
    numbers_.push_back(static_cast<Number>(value));
  }
  std::size_t size() const { return numbers_.size(); }
  std::string text() const {
    return base64({reinterpret_cast<const char*>(numbers_.data()), numbers_.size() * sizeof(Number)});
  }

 private:
  std::vector<Number> numbers_;
};

}  // namespace pose_wall::tools::report
