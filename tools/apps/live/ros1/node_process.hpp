// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The process that roscpp runs in: roscpp ends a process for some calls that anybody can send it, and this is the one
// that it may end.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>

namespace pose_wall::tools::live {

// The socket to the daemon, in the process.
constexpr int kNodeSocket = 3;

// Beside the daemon's own executable in a build, in libexec where it is installed. Throws std::runtime_error that says
// where it was looked for.
std::string node_program();

class NodeProcess {
 public:
  // Starts `program name`, which finds a socket as its descriptor kNodeSocket, no signal blocked and each at its
  // default. It may be ended when the calling thread ends, by PR_SET_PDEATHSIG: the thread must outlive it. Throws
  // std::runtime_error.
  NodeProcess(const std::string& program, const std::string& name);
  ~NodeProcess();
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;

  int socket() const { return socket_; }

  // Hangs up, by which it is asked to end; after this time it is ended by force. Says how it ended: "ended by signal 6
  // (Aborted)". The socket is -1 from then on.
  std::string end(std::chrono::milliseconds patience);

 private:
  int socket_ = -1;
  pid_t process_ = -1;
};

}  // namespace pose_wall::tools::live
