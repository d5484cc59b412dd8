// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// POSIX threads in the shape this runtime needs. Failures return errno's numbers; nothing throws.

#pragma once

#include <pthread.h>

#include <cstdint>

namespace pose_wall::runtime {

// Nanoseconds of CLOCK_MONOTONIC.
std::int64_t monotonic_ns();
// Nanoseconds of CLOCK_REALTIME.
std::int64_t wall_clock_ns();

// The holder inherits the priority of the waiting threads, if the system can do that. Holders only move pointers.
class Mutex {
 public:
  void open();
  void close() { pthread_mutex_destroy(&mutex_); }
  void lock() { pthread_mutex_lock(&mutex_); }
  void unlock() { pthread_mutex_unlock(&mutex_); }
  pthread_mutex_t* get() { return &mutex_; }

 private:
  pthread_mutex_t mutex_;
};

class Locked {
 public:
  explicit Locked(Mutex* mutex) : mutex_(mutex) { mutex_->lock(); }
  ~Locked() { mutex_->unlock(); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  Mutex* mutex_;
};

// The other way round: for work outside a lock that is taken again afterwards.
class Unlocked {
 public:
  explicit Unlocked(Mutex* mutex) : mutex_(mutex) { mutex_->unlock(); }
  ~Unlocked() { mutex_->lock(); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  Mutex* mutex_;
};

class Condition {
 public:
  void open();
  void close() { pthread_cond_destroy(&condition_); }
  void wait(Mutex* mutex) { pthread_cond_wait(&condition_, mutex->get()); }
  void wait_until(Mutex* mutex, std::int64_t monotonic_deadline_ns);
  void wake_all() { pthread_cond_broadcast(&condition_); }

 private:
  pthread_cond_t condition_;
};

// Of the calling thread. 0 or errno.
int set_priority(int priority);
int set_processor(int processor);

}  // namespace pose_wall::runtime
