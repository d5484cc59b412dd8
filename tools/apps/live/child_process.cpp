// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/child_process.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace pose_wall::tools::live {

std::string program_beside(const std::string& name, const std::string& missing,
                           const std::vector<std::string>& folders) {
  std::error_code fault;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", fault).parent_path();
  std::string tried;
  for (const std::string& folder : folders) {
    const std::filesystem::path program = (own / folder / name).lexically_normal();
    if (access(program.c_str(), X_OK) == 0) return program;
    tried += fmt::format("{}{}", tried.empty() ? "" : " nor ", program.string());
  }
  throw std::runtime_error(fmt::format("{} {}", missing, tried));
}

pid_t start_child(const std::vector<std::string>& words, const std::vector<std::pair<int, int>>& descriptors) {
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
  int last = STDERR_FILENO;
  for (const auto& [ours, theirs] : descriptors) {
    posix_spawn_file_actions_adddup2(&files, ours, theirs);
    last = std::max(last, theirs);
  }
  posix_spawn_file_actions_addclosefrom_np(&files, last + 1);  // not every library closes its sockets for children
  std::vector<char*> list;
  for (const std::string& word : words) list.push_back(const_cast<char*>(word.c_str()));
  list.push_back(nullptr);
  pid_t process = -1;
  const int fault = posix_spawn(&process, list[0], &files, &attributes, list.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (fault != 0) throw std::runtime_error(fmt::format("{}: {}", words.front(), std::strerror(fault)));
  return process;
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  }
  return fmt::format("ended with status {}", WEXITSTATUS(status));
}

}  // namespace pose_wall::tools::live
