// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "threads.hpp"
#include "base/math/time_units.hpp"

#include <errno.h>  // NOLINT(modernize-deprecated-headers): POSIX names
#include <sched.h>
#include <time.h>  // NOLINT(modernize-deprecated-headers)

namespace pose_wall::runtime {
namespace {

std::int64_t read_ns(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return static_cast<std::int64_t>(t.tv_sec) * kSecond_ns + t.tv_nsec;
}
}  // namespace

std::int64_t monotonic_ns() {
  return read_ns(CLOCK_MONOTONIC);
}

std::int64_t wall_clock_ns() {
  return read_ns(CLOCK_REALTIME);
}

void Mutex::open() {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
  if (pthread_mutex_init(&mutex_, &attributes) != 0) pthread_mutex_init(&mutex_, nullptr);
  pthread_mutexattr_destroy(&attributes);
}

void Condition::open() {
  pthread_condattr_t attributes;
  pthread_condattr_init(&attributes);
  pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
  pthread_cond_init(&condition_, &attributes);
  pthread_condattr_destroy(&attributes);
}

void Condition::wait_until(Mutex* mutex, std::int64_t monotonic_deadline_ns) {
  timespec t;
  t.tv_sec = static_cast<time_t>(monotonic_deadline_ns / kSecond_ns);
  t.tv_nsec = static_cast<long>(monotonic_deadline_ns % kSecond_ns);
  pthread_cond_timedwait(&condition_, mutex->get(), &t);
}

int set_priority(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
}

int set_processor(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (processor < 0 || processor >= CPU_SETSIZE) return EINVAL;
  CPU_SET(static_cast<unsigned>(processor), &set);
  return pthread_setaffinity_np(pthread_self(), sizeof(set), &set);
}

}  // namespace pose_wall::runtime
