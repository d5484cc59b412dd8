// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/soak/heap_count.hpp"

#include <errno.h>  // NOLINT(modernize-deprecated-headers): POSIX names
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>

namespace {
std::atomic<bool> counting{false};
std::atomic<std::uint64_t> calls{0};

[[maybe_unused]] void count_call() {
  if (counting.load(std::memory_order_relaxed)) calls.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

#if defined(__SANITIZE_ADDRESS__)
// Of the sanitizer's runtime; GCC does not ship the header that declares it.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                                         void (*on_free)(const volatile void*));
#elif !defined(__SANITIZE_THREAD__)
// The C library's own entry points beneath malloc and friends; operator new comes by malloc, its aligned form by
// aligned_alloc or posix_memalign.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void* __libc_valloc(std::size_t size);
void* __libc_pvalloc(std::size_t size);
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
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count_call();
  return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  count_call();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  count_call();
  if (alignment < sizeof(void*) || (alignment & (alignment - 1)) != 0) return EINVAL;
  void* const taken = __libc_memalign(alignment, size);
  if (taken == nullptr) return ENOMEM;
  *block = taken;
  return 0;
}
void* valloc(std::size_t size) {
  count_call();
  return __libc_valloc(size);
}
void* pvalloc(std::size_t size) {
  count_call();
  return __libc_pvalloc(size);
}
void free(void* block) {
  count_call();
  __libc_free(block);
}
}
#endif

namespace pose_wall::tools {

bool heap_calls_are_counted() {
#if defined(__SANITIZE_THREAD__)
  return false;
#else
  return true;
#endif
}

void start_counting_heap_calls() {
#if defined(__SANITIZE_ADDRESS__)
  static const int hooked = __sanitizer_install_malloc_and_free_hooks(
      [](const volatile void*, std::size_t) { count_call(); }, [](const volatile void*) { count_call(); });
  static_cast<void>(hooked);
#endif
  calls = 0;
  counting = true;
}

std::uint64_t stop_counting_heap_calls() {
  counting = false;
  return calls;
}

std::int64_t resident_kb() {
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return kResidentUnknown_kb;
  char text[128] = {};
  const ssize_t count = read(file, text, sizeof text - 1);
  close(file);
  if (count <= 0) return kResidentUnknown_kb;
  char* at = text;
  std::strtoll(at, &at, 10);  // the whole size; the resident part is next, both in pages
  const long long pages = std::strtoll(at, nullptr, 10);
  return pages > 0 ? pages * (sysconf(_SC_PAGESIZE) / 1024) : kResidentUnknown_kb;
}

}  // namespace pose_wall::tools
