// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <algorithm>

namespace pose_wall {

// std::sort recurses; a heap does not, so the stack is known. Equal ones come out in an order that is always the same.
template <typename Iterator, typename Before>
void heap_sort(Iterator begin, Iterator end, Before before) {
  std::make_heap(begin, end, before);
  std::sort_heap(begin, end, before);
}

}  // namespace pose_wall
