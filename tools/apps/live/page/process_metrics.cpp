// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/page/process_metrics.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

namespace pose_wall::tools::live {
namespace {

// By the wall clock; nothing where the kernel does not say.
std::optional<double> started_s() {
  std::string line;
  if (!std::getline(std::ifstream("/proc/self/stat"), line)) return std::nullopt;
  // Behind the name, which may hold whatever: field 22 counts from 1 (proc(5)), and the third one follows.
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  std::string skipped;
  for (int field = 3; field < 22; ++field) fields >> skipped;
  double ticks = 0.0;
  if (!(fields >> ticks)) return std::nullopt;
  std::ifstream kernel("/proc/stat");
  while (std::getline(kernel, line)) {
    if (line.rfind("btime ", 0) == 0)
      return std::stod(line.substr(6)) + ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  return std::nullopt;
}

// But for the folder's own, which is open while it is read.
std::optional<std::uint64_t> open_files() {
  std::error_code fault;
  std::uint64_t count = 0;
  for (std::filesystem::directory_iterator file("/proc/self/fd", fault), end; !fault && file != end;
       file.increment(fault)) {
    ++count;
  }
  return fault || count == 0 ? std::nullopt : std::optional<std::uint64_t>(count - 1);
}

}  // namespace

void add_process_metrics(OpenMetrics* metrics) {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) == 0) {
    const auto of = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    metrics->family("process_cpu_seconds", "counter", "seconds", "Time of processors that the daemon took.");
    metrics->sample({}, of(usage.ru_utime) + of(usage.ru_stime), "_total");
  }
  if (const std::optional<double> start_s = started_s()) {
    metrics->family("process_start_time_seconds", "gauge", "seconds", "When the daemon started, since 1970.");
    metrics->sample({}, *start_s);
  }
  if (const std::optional<std::uint64_t> files = open_files()) {
    metrics->family("process_open_fds", "gauge", "", "Files and connections that the daemon has open.");
    metrics->count({}, *files, "");
  }
  std::uint64_t pages = 0, resident = 0;
  if (std::ifstream("/proc/self/statm") >> pages >> resident) {
    metrics->family("process_resident_memory_bytes", "gauge", "bytes", "Memory that the daemon has in use.");
    metrics->count({}, resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)), "");
  }
}

}  // namespace pose_wall::tools::live
