// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_walld: the daemon on the machine. A sensor, ROS or a recording in; ROS, Modbus, MQTT, a page, recordings out.

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <thread>

#include "apps/command_line/help_format.hpp"
#include "apps/command_line/language_option.hpp"
#include "apps/command_line/parse_fault.hpp"
#include "apps/live/daemon.hpp"
#include "apps/live/thread_name.hpp"
#include "apps/options/one_of.hpp"
#include "io/config_file/config_place.hpp"
#include "io/config_file/load_config.hpp"
#include "io/language/language.hpp"
#include "io/language/retold.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr int kExitDone = 0, kExitFailed = 1, kExitUsage = 2;
// A clean stop takes a fraction of it; a sink that hangs in a dead disk must not keep the machine from its restart.
constexpr auto kStopAtMost = std::chrono::seconds(1);
// At the end of a recording nobody waits, and twenty clouds of 3 MB may be on their way to a slow disk.
constexpr auto kEndAtMost = std::chrono::seconds(10);
constexpr auto kLookForEnd = std::chrono::milliseconds(10);

struct Words {
  std::string config_file;
  std::vector<std::string> settings;
  std::string http, modbus;
  ReplayPlan replay;
};

// Signals become wishes in a thread of its own; after that to stop the stop must come in time.
class StopSignals {
 public:
  StopSignals() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) sigaddset(&signals_, signal);
    // Before any other thread begins, so that all of them inherit it.
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
    thread_ = std::thread([this] { wait(); });
  }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  ~StopSignals() {
    done_ = true;
    // Wakes the thread where no signal came.
    pthread_kill(thread_.native_handle(), SIGTERM);
    thread_.join();
  }

  const std::atomic<bool>& asked() const { return asked_; }
  // The recording is through: all ends as if somebody had asked for it.
  void ask_at_end() {
    at_most_ = kEndAtMost;
    pthread_kill(thread_.native_handle(), SIGTERM);
  }
  // By SIGUSR1: somebody has looked around the machine.
  std::atomic<bool>& looked() { return looked_; }
  // By SIGHUP: the settings are to be read again.
  std::atomic<bool>& reload() { return reload_; }

 private:
  void wait() {
    name_this_thread("signals");
    int signal = 0;
    while (sigwait(&signals_, &signal) == 0 && is_wish(signal)) {
    }
    if (done_) return;
    asked_ = true;
    // Further signals hurry nothing and cancel nothing.
    const std::chrono::seconds at_most = at_most_;
    const auto until = std::chrono::steady_clock::now() + at_most;
    while (!done_ && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(kLookForEnd);
    if (done_) return;
    log_line(Grade::kBad, "pose_walld",
             fmt::format("a part does not stop within {} s; the process ends without it", at_most.count()));
    _exit(kExitFailed);
  }

  // Where somebody started it at a terminal, SIGHUP says that the terminal is gone.
  bool is_wish(int signal) {
    if (signal == SIGUSR1) return looked_ = true;
    return signal == SIGHUP && !at_terminal_ && (reload_ = true);
  }

  const bool at_terminal_ = isatty(STDIN_FILENO) == 1;
  sigset_t signals_{};
  std::atomic<bool> asked_{false}, looked_{false}, reload_{false}, done_{false};
  std::atomic<std::chrono::seconds> at_most_{kStopAtMost};
  std::thread thread_;
};

// True: with other settings, again.
bool run(Words words) {
  if (!words.http.empty()) words.settings.push_back("http=" + words.http);
  if (!words.modbus.empty()) words.settings.push_back("modbus=" + words.modbus);
  const LoadedConfig loaded = load_config(words.config_file, words.settings);
  tell_notes(loaded, false);
  std::optional<ReplayPlan> replay;
  if (!words.replay.inputs.empty()) replay = words.replay;
  StopSignals signals;
  Daemon daemon(loaded, replay);
  daemon.run({signals.asked(), signals.looked(), signals.reload(),
              [&words] { return load_config(words.config_file, words.settings); },
              [&signals] { signals.ask_at_end(); }});
  return daemon.restarts();
}

// The same program with the same words takes this one's place: for systemd it is the same process. What a library left
// open would keep its port.
void start_again(char** argv) {
  close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  execv("/proc/self/exe", argv);
  throw std::runtime_error(fmt::format("cannot be started again: {}", std::strerror(errno)));
}

std::string footer() {
  return fmt::format(
      "{}\n"
      "  pose_walld --config pose_wall.yaml --http 127.0.0.1:8080\n"
      "  pose_walld --replay road.bag --http 127.0.0.1:8080 --modbus 127.0.0.1:1502\n"
      "  pose_walld --config pose_wall.yaml --set source=ros1 --set ros1=1\n"
      "{}\n{}",
      tr("Examples:"),
      tr("It listens on loopback unless another address is given. `pose_wall check-config FILE` shows every key."),
      tr("Exit status: 0 stopped as asked or the recording is through, 1 a part failed or is not in this build, "
         "a recording holds no cloud, 2 wrong words or settings."));
}

void add_options(CLI::App* app, Words* words) {
  use_help_format(*app);
  app->add_option("-c,--config", words->config_file,
                  config_help(tr("Settings, as config/pose_wall.yaml; default: the defaults")));
  app->add_option("-s,--set", words->settings, tr("KEY=VALUE over the file; may be repeated"))->allow_extra_args(false);
  app->add_option("--http", words->http, tr("Serve the page at HOST:PORT; short for --set http="));
  app->add_option("--modbus", words->modbus, tr("Serve the process image at HOST:PORT; short for --set modbus="));
  ReplayPlan* replay = &words->replay;
  auto* inputs = app->add_option("--replay", replay->inputs,
                                 tr("Play these recordings instead of the source: files, folders, bags, captures"));
  const auto of_replay = [inputs](CLI::Option* option) { option->needs(inputs); };
  of_replay(
      app->add_option("--speed", replay->speed, tr("Times real time; 0: as fast as frames are measured, none lost"))
          ->check(number_within(0.0, 1000.0)));
  of_replay(app->add_flag("--step", replay->step, tr("One frame for each line of standard input")));
  of_replay(app->add_flag("--repeat", replay->repeat, tr("From the start again at the end")));
  of_replay(app->add_option("--topic", replay->topic, tr("Of bags: the topic with the clouds")));
  of_replay(app->add_option("--source", replay->source,
                            tr("Of bags and captures with several sensors: the one that is read; default: the first")));
  of_replay(app->add_option("--metadata", replay->metadata, tr("Of captures: what the sensor says of itself")));
  app->set_version_flag("--version", std::string("pose_walld ") + pose_wall_version(),
                        tr("Display program version information and exit"));
  add_language_option(*app);
  app->footer(footer());
}

int complain(const std::exception& fault, int status) {
  fmt::print(stderr, "pose_walld: {}\n", retold(language(), fault.what()));
  return status;
}

int main_of(int argc, char** argv) {
  choose_language_by(argc, argv, "pose_walld");
  CLI::App app(
      tr("Measures how a machine stands in its roadway, from power-on on: sensor or ROS in; ROS, Modbus, page out."),
      "pose_walld");
  Words words;
  add_options(&app, &words);
  try {
    app.parse(argc, argv);
    if (run(words)) start_again(argv);
    return kExitDone;
  } catch (const CLI::ParseError& fault) {
    if (fault.get_exit_code() == 0) return app.exit(fault);
    fmt::print(stderr, "pose_walld: {}\n{}\n", parse_fault_text(app, fault), tr("See pose_walld --help."));
    return kExitUsage;
  } catch (const ConfigError& fault) {
    return complain(fault, kExitUsage);
  } catch (const std::exception& fault) {
    return complain(fault, kExitFailed);
  }
}

}  // namespace
}  // namespace pose_wall::tools::live

int main(int argc, char** argv) {
  return pose_wall::tools::live::main_of(argc, argv);
}
