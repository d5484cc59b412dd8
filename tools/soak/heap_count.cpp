// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "soak/heap_count.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>

namespace {
std::atomic<bool> counting{false};
std::atomic<std::uint64_t> calls{0};

void count_call() {
  if (counting.load(std::memory_order_relaxed)) calls.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

// The C library's own entry points beneath malloc and friends.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size) {
  count_call();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  count_call();
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  count_call();
  return __libc_realloc(block, size);
}
void free(void* block) {
  count_call();
  __libc_free(block);
}
}

namespace pose_wall::tools {

void start_counting_heap_calls() {
  calls = 0;
  counting = true;
}

std::uint64_t heap_calls() {
  return calls;
}

std::int64_t resident_kb() {
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  char text[128] = {};
  const ssize_t count = read(file, text, sizeof text - 1);
  close(file);
  if (count <= 0) return 0;
  char* at = text;
  std::strtoll(at, &at, 10);  // the whole size; the resident part is next, both in pages
  return std::strtoll(at, nullptr, 10) * (sysconf(_SC_PAGESIZE) / 1024);
}

}  // namespace pose_wall::tools
