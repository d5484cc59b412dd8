// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros1/node_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

namespace pose_wall::tools::live {
namespace {

constexpr const char* kProgram = "pose_walld_ros1";
// How often it looks whether the process has ended.
constexpr auto kLook = std::chrono::milliseconds(5);

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  }
  return fmt::format("ended with status {}", WEXITSTATUS(status));
}

// With the other end of the socket, and with no signal blocked or ignored: those of the daemon are none of its.
int spawn(pid_t* process, const std::string& program, const std::string& name, int socket) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&files);
  posix_spawnattr_init(&attributes);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawn_file_actions_adddup2(&files, socket, kNodeSocket);
  const char* words[] = {program.c_str(), name.c_str(), nullptr};
  const int fault =
      posix_spawn(process, program.c_str(), &files, &attributes, const_cast<char* const*>(words), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  return fault;
}

}  // namespace

std::string node_program() {
  std::error_code fault;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", fault).parent_path();
  std::string tried;
  for (const char* place : {"", POSE_WALL_LIBEXEC_FROM_BIN}) {
    const std::filesystem::path program = (folder / place / kProgram).lexically_normal();
    if (access(program.c_str(), X_OK) == 0) return program;
    tried += fmt::format("{}{}", tried.empty() ? "" : " nor ", program.string());
  }
  throw std::runtime_error(fmt::format("the program of ROS 1 is missing: there is no {}", tried));
}

NodeProcess::NodeProcess(const std::string& program, const std::string& name) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::runtime_error(fmt::format("no socket: {}", std::strerror(errno)));
  }
  // Where the end is kNodeSocket already, dup2 would leave it to be closed in older systems' libraries.
  const int theirs = ends[1] == kNodeSocket ? fcntl(ends[1], F_DUPFD_CLOEXEC, kNodeSocket + 1) : ends[1];
  const int fault = spawn(&process_, program, name, theirs);
  ::close(ends[1]);
  if (theirs != ends[1]) ::close(theirs);
  if (fault != 0) {
    ::close(ends[0]);
    throw std::runtime_error(fmt::format("{}: {}", program, std::strerror(fault)));
  }
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
