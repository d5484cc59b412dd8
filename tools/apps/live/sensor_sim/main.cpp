// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall_sensor: a LiDAR that is not there. It drives through a simulated road and sends its packets by UDP, at
// their pace; for trying pose_walld without a machine, and for its tests.

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <memory>
#include <random>
#include <thread>

#include "apps/demo/demo_setup.hpp"
#include "apps/live/clocks.hpp"
#include "apps/live/sensor_sim/metadata_server.hpp"
#include "apps/live/sensor_sim/packet_encoder.hpp"
#include "io/config_file/live_settings.hpp"
#include "lab/sim/run_files.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr int kExitFailed = 1, kExitUsage = 2;
using Clock = std::chrono::steady_clock;

std::atomic<bool> stop_asked{false};

struct Words {
  DemoOptions scene;
  std::string to = "127.0.0.1:2368", device_to = "127.0.0.1:7788", http, config_to;
  std::uint32_t frames = 70;  // they go round, and the guard of freshness knows rings of 64
  double rate_hz = 10.0, seconds = 0.0;
  double present_s = 0.0, absent_s = 2.0;
  bool frozen = false;
};

class UdpSender {
 public:
  explicit UdpSender(const std::string& to) : file_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const std::optional<HostPort> place = parse_host_port(to);
    if (!place || inet_pton(AF_INET, place->host.c_str(), &to_.sin_addr) != 1) {
      throw std::invalid_argument(fmt::format("--to {}: ADDRESS:PORT is expected, as 127.0.0.1:2368", to));
    }
    to_.sin_family = AF_INET;
    to_.sin_port = htons(static_cast<std::uint16_t>(place->port));
  }
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;
  ~UdpSender() { close(file_); }

  // A sensor does not care whether anybody listens.
  void send(const std::string& packet) const {
    const ssize_t sent =
        sendto(file_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to_), sizeof to_);
    static_cast<void>(sent);
  }

 private:
  int file_;
  sockaddr_in to_{};
};

std::vector<RangeImage> render(const sim::Setup& setup, const Words& words) {
  const sim::Simulator simulator(setup, words.scene.seed);
  std::vector<RangeImage> images;
  for (std::uint32_t i = 0; i < words.frames && !stop_asked; ++i) {
    images.push_back(range_image(setup.sensor, simulator.render(i)));
  }
  return images;
}

// There and back again, so that the machine never jumps; each range a millimetre off by chance, for a cloud that was
// there before is a frozen sensor's.
RangeImage image_of(const std::vector<RangeImage>& images, std::uint64_t turn, bool frozen) {
  if (frozen) return images.front();
  const std::uint64_t round = images.size() < 2 ? 1 : 2 * (images.size() - 1);
  const std::uint64_t at = turn % round;
  RangeImage image = images[at < images.size() ? at : round - at];
  std::minstd_rand random(static_cast<std::uint32_t>(turn + 1));
  for (double& range_m : image.range_m) {
    const double off_m = 1e-3 * (static_cast<double>(random() % 3) - 1.0);
    if (range_m > 0.0) range_m += off_m;
  }
  return image;
}

bool is_absent(const Words& words, double time_s) {
  return words.present_s > 0.0 && std::fmod(time_s, words.present_s + words.absent_s) >= words.present_s;
}

std::uint64_t send_turns(const std::vector<RangeImage>& images, PacketEncoder* encoder, const Words& words) {
  const UdpSender sender(words.to), device_sender(words.device_to);
  const auto turn = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / words.rate_hz));
  const Clock::time_point begin = Clock::now();
  std::uint64_t sent = 0;
  for (std::uint64_t i = 0; !stop_asked; ++i) {
    const double time_s = static_cast<double>(i) / words.rate_hz;
    if (words.seconds > 0.0 && time_s >= words.seconds) break;
    const Clock::time_point turn_begin = begin + static_cast<std::int64_t>(i) * turn;
    std::this_thread::sleep_until(turn_begin);
    if (is_absent(words, time_s)) continue;
    const std::string device = encoder->device_packet(std::chrono::nanoseconds(turn).count());
    if (!device.empty()) device_sender.send(device);
    const std::vector<std::string> packets =
        encoder->packets(image_of(images, i, words.frozen), monotonic_ns(), std::chrono::nanoseconds(turn).count());
    for (std::size_t k = 0; k < packets.size(); ++k) {
      std::this_thread::sleep_until(turn_begin +
                                    turn * static_cast<std::int64_t>(k) / static_cast<std::int64_t>(packets.size()));
      sender.send(packets[k]);
    }
    ++sent;
  }
  return sent;
}

// Where the packets go, for the daemon that takes them.
std::string port_settings(const Words& words, const PacketEncoder& encoder) {
  constexpr std::int64_t kTurn_ns = 100'000'000;  // any
  std::string text = "\n# Where pose_wall_sensor sends to.\n";
  const auto add = [&text](const char* key, const std::string& to) {
    if (const std::optional<HostPort> place = parse_host_port(to)) text += fmt::format("{}: {}\n", key, place->port);
  };
  add("udp_port", words.to);
  if (!encoder.device_packet(kTurn_ns).empty()) add("udp_device_port", words.device_to);
  return text;
}

void run(const Words& words) {
  sim::Setup setup = demo_setup(words.scene);
  const std::unique_ptr<PacketEncoder> encoder = make_encoder(setup.sensor);
  if (!words.config_to.empty()) {
    std::ofstream file(words.config_to);
    file << sim::engine_settings(setup, "For the machine that pose_wall_sensor simulates.");
    file << port_settings(words, *encoder);
    if (!file.flush()) throw std::runtime_error(words.config_to + ": cannot be written: " + std::strerror(errno));
  }
  std::unique_ptr<MetadataServer> server;
  if (!words.http.empty()) {
    const auto* ouster = dynamic_cast<const OusterEncoder*>(encoder.get());
    if (ouster == nullptr) throw std::invalid_argument("--http: only an Ouster has metadata");
    server = std::make_unique<MetadataServer>(words.http, ouster->metadata());
  }
  fmt::print("renders {} turns\n", words.frames);
  std::fflush(stdout);
  const std::vector<RangeImage> images = render(setup, words);
  if (stop_asked) return;
  fmt::print("{} sends to {} at {:g} Hz\n", setup.sensor.name, words.to, words.rate_hz);
  std::fflush(stdout);
  fmt::print("sent {} turns\n", send_turns(images, encoder.get(), words));
}

int main_of(int argc, char** argv) {
  CLI::App app("Sends the packets of a simulated LiDAR, there and back along a road.", "pose_wall_sensor");
  Words words;
  app.add_option("--sensor", words.scene.sensor, "As `pose_wall sim --list` describes it; default: os1-64")
      ->check(CLI::IsMember(sensors_with_packets()));
  app.add_option("--scene", words.scene.scene, "As `pose_wall sim --list` shows them; default: a heading at work");
  app.add_option("--set", words.scene.simulation, "NAME=VALUE of the simulation")->allow_extra_args(false);
  app.add_option("--seed", words.scene.seed, "Of the road");
  app.add_option("--frames", words.frames,
                 "Turns of the road, rendered before the first is sent. They go there and back, each range up to a "
                 "millimetre off by chance, so that none counts as frozen; default: 70")
      ->check(CLI::Range(1, 10000));
  app.add_flag("--frozen", words.frozen, "Sends the first turn again and again, bit for bit, as a sensor that froze");
  app.add_option("--to", words.to, "ADDRESS:PORT that listens; default 127.0.0.1:2368");
  app.add_option("--device-to", words.device_to,
                 "ADDRESS:PORT for what a RoboSense says of itself; default 127.0.0.1:7788");
  app.add_option("--http", words.http, "HOST:PORT at which an Ouster tells its metadata");
  app.add_option("--rate", words.rate_hz, "Turns a second")->check(CLI::Range(0.1, 100.0));
  app.add_option("--seconds", words.seconds, "Ends then; default: when it is stopped")->check(CLI::NonNegativeNumber);
  app.add_option("--present", words.present_s, "Falls silent after so many seconds, again and again")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--absent", words.absent_s, "For so many seconds")->check(CLI::NonNegativeNumber);
  app.add_option("--config-to", words.config_to, "Writes the settings that fit the simulated machine there");
  std::signal(SIGINT, [](int) { stop_asked = true; });
  std::signal(SIGTERM, [](int) { stop_asked = true; });
  try {
    app.parse(argc, argv);
    run(words);
    return 0;
  } catch (const CLI::ParseError& fault) {
    return app.exit(fault) == 0 ? 0 : kExitUsage;
  } catch (const std::invalid_argument& fault) {
    fmt::print(stderr, "pose_wall_sensor: {}\n", fault.what());
    return kExitUsage;
  } catch (const std::exception& fault) {
    fmt::print(stderr, "pose_wall_sensor: {}\n", fault.what());
    return kExitFailed;
  }
}

}  // namespace
}  // namespace pose_wall::tools::live

int main(int argc, char** argv) {
  return pose_wall::tools::live::main_of(argc, argv);
}
