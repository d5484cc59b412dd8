// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The command in a child that gets Ctrl-C at a moment which hangs on no clock.

#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include "apps/command.hpp"

namespace pose_wall::tools::test {

struct Ended {
  int exit_status = -1;  // -1: it did not exit by itself
  std::string text;      // all that it wrote there
};

enum class Stream { kOut = 1, kError = 2 };

// Runs `pose_wall WORDS...` in a child, and interrupts it when it has written `needle` to the stream. It cannot come to
// its end meanwhile if it has more than 4 KiB to write there: the pipe holds no more, and nobody reads on before Ctrl-C
// is on its way. The other stream goes to the file `beside`.
inline Ended interrupted_when_told(const std::vector<std::string>& words, Stream stream, const std::string& needle,
                                   const std::string& beside) {
  constexpr int kPipeBytes = 4096;  // the least that Linux has
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0 || fcntl(ends[1], F_SETPIPE_SZ, kPipeBytes) < 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    std::vector<const char*> argv = {"pose_wall"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    std::FILE* const other = stream == Stream::kOut ? stderr : stdout;
    if (dup2(ends[1], static_cast<int>(stream)) < 0 || std::freopen(beside.c_str(), "w", other) == nullptr) _exit(99);
    ::close(ends[0]);
    const int status = run_command(static_cast<int>(argv.size()), argv.data());
    std::fflush(nullptr);
    _exit(status);
  }
  ::close(ends[1]);
  Ended ended;
  bool is_sent = false;
  std::array<char, 1024> part{};
  for (ssize_t got = 0; (got = ::read(ends[0], part.data(), part.size())) > 0;) {
    ended.text.append(part.data(), static_cast<std::size_t>(got));
    if (is_sent || ended.text.find(needle) == std::string::npos) continue;
    kill(child, SIGINT);
    is_sent = true;
  }
  ::close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) ended.exit_status = WEXITSTATUS(status);
  return ended;
}

}  // namespace pose_wall::tools::test
