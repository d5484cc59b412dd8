// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Names of threads, so that `top -H` and debuggers tell which of the daemon's threads works or hangs.

#pragma once

#include <pthread.h>

#include <string>

namespace pose_wall::tools::live {

// The calling thread's. The kernel keeps 15 bytes (pthread_setname_np(3)); the rest is left out.
inline void name_this_thread(const std::string& name) {
  constexpr std::size_t kBytesMost = 15;
  // Without a name it works just as well.
  static_cast<void>(pthread_setname_np(pthread_self(), name.substr(0, kBytesMost).c_str()));
}

}  // namespace pose_wall::tools::live
