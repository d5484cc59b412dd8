// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros1/node_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>

#include "apps/live/child_process.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr const char* kProgram = "pose_walld_ros1";
// How often it looks whether the process has ended.
constexpr auto kLook = std::chrono::milliseconds(5);

}  // namespace

std::string node_program() {
  return program_beside(kProgram, "the program of ROS 1 is missing: there is no", {"", POSE_WALL_LIBEXEC_FROM_BIN});
}

NodeProcess::NodeProcess(const std::string& program, const std::string& name) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::runtime_error(fmt::format("no socket: {}", std::strerror(errno)));
  }
  // Where the end is kNodeSocket already, dup2 would leave it to be closed in older systems' libraries.
  const int theirs = ends[1] == kNodeSocket ? fcntl(ends[1], F_DUPFD_CLOEXEC, kNodeSocket + 1) : ends[1];
  try {
    process_ = start_child({program, name}, {{theirs, kNodeSocket}});
  } catch (const std::exception&) {
    ::close(ends[0]);
    ::close(ends[1]);
    if (theirs != ends[1]) ::close(theirs);
    throw;
  }
  ::close(ends[1]);
  if (theirs != ends[1]) ::close(theirs);
  socket_ = ends[0];
}

NodeProcess::~NodeProcess() {
  if (process_ > 0) end(std::chrono::milliseconds(0));
}

std::string NodeProcess::end(std::chrono::milliseconds patience) {
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  const auto until = std::chrono::steady_clock::now() + patience;
  int status = 0;
  while (waitpid(process_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(kLook);
      continue;
    }
    kill(process_, SIGKILL);
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    break;
  }
  process_ = -1;
  return how_it_ended(status);
}

}  // namespace pose_wall::tools::live
