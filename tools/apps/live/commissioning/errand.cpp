// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/commissioning/errand.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <thread>

#include "apps/live/child_process.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr int kNice = 10;  // a third of what others get when all want the processors, and not nothing
constexpr auto kPatience = std::chrono::minutes(20);  // two minutes of an OS0-128 take ten on a small ARM64 controller
constexpr auto kLook = std::chrono::milliseconds(20);
constexpr long kKeptBytes = 1'000'000;  // what doctor tells as JSON has 10,000

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using Paper = std::unique_ptr<std::FILE, Closer>;  // a nameless file: no pipe can fill up

Paper new_paper() {
  Paper paper(std::tmpfile());
  if (!paper) throw std::runtime_error(fmt::format("no temporary file: {}", std::strerror(errno)));
  return paper;
}

std::string end_of(std::FILE* file) {
  std::fseek(file, 0, SEEK_END);
  const long bytes = std::ftell(file), kept = std::min(bytes, kKeptBytes);
  std::fseek(file, bytes - kept, SEEK_SET);
  std::string text(static_cast<std::size_t>(kept), '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  return text;
}

}  // namespace

ErrandOutcome run_errand(const std::vector<std::string>& words, const std::atomic<bool>& given_up) {
  std::vector<std::string> all = {
      program_beside("pose_wall", "the command of the package pose-wall is missing: there is no", {"", "../bin"})};
  all.insert(all.end(), words.begin(), words.end());
  const Paper output = new_paper(), errors = new_paper();
  const pid_t child = start_child(all, {{fileno(output.get()), STDOUT_FILENO}, {fileno(errors.get()), STDERR_FILENO}});
  setpriority(PRIO_PROCESS, static_cast<id_t>(child), kNice);
  int status = 0;
  const auto until = std::chrono::steady_clock::now() + kPatience;
  pid_t ended = 0;
  while ((ended = waitpid(child, &status, WNOHANG)) == 0) {
    if (given_up || std::chrono::steady_clock::now() > until) kill(child, SIGKILL);
    std::this_thread::sleep_for(kLook);
  }
  if (ended != child) throw std::runtime_error(fmt::format("pose_wall {}: {}", words.front(), std::strerror(errno)));
  if (given_up) throw std::runtime_error("was given up");
  if (!WIFEXITED(status)) throw std::runtime_error(fmt::format("pose_wall {} {}", words.front(), how_it_ended(status)));
  return {WEXITSTATUS(status), end_of(output.get()), end_of(errors.get())};
}

}  // namespace pose_wall::tools::live
