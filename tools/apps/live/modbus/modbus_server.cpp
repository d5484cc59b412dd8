// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Modbus TCP: connections and framing, in one thread that no client can hold up.

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "apps/live/modbus/modbus_registers.hpp"
#include "apps/live/thread_name.hpp"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;

// A controller, a second one, a panel, somebody with a laptop: then the one that is silent longest makes room.
constexpr std::size_t kClientsMost = 32;
// How long a stop may wait for the thread.
constexpr int kLook_ms = 100;
// Where there are no descriptors: a hundred looks a second cost nothing.
constexpr auto kRest = std::chrono::milliseconds(10);
// A controller that was switched off leaves its connection open for ever.
constexpr auto kIdleMost = std::chrono::minutes(5);

class Socket {
 public:
  explicit Socket(int file = -1) : file_(file) {}
  Socket(Socket&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() {
    if (file_ >= 0) close(file_);
  }
  int get() const { return file_; }

 private:
  int file_;
};

Socket listen_at(const HostPort& place) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  const int status = getaddrinfo(place.host.c_str(), std::to_string(place.port).c_str(), &hints, &found);
  if (status != 0) throw std::runtime_error(fmt::format("modbus: {}: {}", place.host, gai_strerror(status)));
  Socket server(socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int on = 1;
  setsockopt(server.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const bool listens =
      bind(server.get(), found->ai_addr, found->ai_addrlen) == 0 && listen(server.get(), SOMAXCONN) == 0;
  const int why = errno;
  freeaddrinfo(found);
  if (!listens) {
    throw std::runtime_error(
        fmt::format("modbus: cannot listen at {}:{}: {}{}", place.host, place.port, std::strerror(why),
                    why == EACCES ? " (ports below 1024 need CAP_NET_BIND_SERVICE, which the service has)" : ""));
  }
  return server;
}

// Nothing for one that is no IPv4 address, mapped into IPv6 or not.
std::optional<std::uint32_t> ipv4_of(const sockaddr_storage& address) {
  if (address.ss_family == AF_INET) return ntohl(reinterpret_cast<const sockaddr_in&>(address).sin_addr.s_addr);
  if (address.ss_family != AF_INET6) return std::nullopt;
  const in6_addr& six = reinterpret_cast<const sockaddr_in6&>(address).sin6_addr;
  if (!IN6_IS_ADDR_V4MAPPED(&six)) return std::nullopt;
  constexpr std::size_t kMappedAt = 12;  // RFC 4291, 2.5.5.2
  std::uint32_t four = 0;
  std::memcpy(&four, six.s6_addr + kMappedAt, sizeof four);
  return ntohl(four);
}

struct Client {
  Socket socket;
  std::optional<std::uint32_t> address;
  Clock::time_point heard;
  std::vector<std::uint8_t> bytes;
};

class ModbusServer final : public Sink {
 public:
  ModbusServer(const LoadedConfig& loaded, const Images& images, const StopBoard* stop, CommandBoard* commands)
      : at_(loaded.live.modbus),
        writer_(commands != nullptr ? loaded.planar.command_modbus : ""),
        registers_(images, stop, CommandRegisters(commands, parse_ipv4(writer_))) {}
  ~ModbusServer() override { stop(); }

  void start() override {
    server_ = listen_at(*parse_host_port(at_));
    log_line(Grade::kGood, part(),
             fmt::format("listens; whoever reaches this address can read the images, {}",
                         writer_.empty() ? "nobody can write" : writer_ + " alone can write commands of the drive"));
    ending_ = false;
    thread_ = std::thread([this] { run(); });
  }
  // Controllers ask; nothing is sent to them.
  void take(const LiveResult&) override {}
  void stop() override {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
    server_ = Socket();
  }

  PartHealth health() const override {
    PartHealth health;
    health.part = part();
    health.summary = "serves";
    health.add("clients", clients_now_.load());
    health.add("requests", requests_.load());
    health.add("refused", refused_.load());
    health.add("connections of no Modbus", no_modbus_.load());
    health.add("stop's age when read, mean ms", registers_.answer_ages().mean_ms_text());
    health.add("stop's age when read, worst ms", registers_.answer_ages().worst_ms_text());
    return health;
  }

 private:
  std::string part() const { return "sink modbus " + at_; }

  void run() {
    name_this_thread("modbus-server");
    while (!ending_) {
      std::vector<pollfd> readable = {{server_.get(), POLLIN, 0}};
      for (const Client& client : clients_) readable.push_back({client.socket.get(), POLLIN, 0});
      if (poll(readable.data(), readable.size(), kLook_ms) < 0) continue;
      std::vector<bool> stays(clients_.size(), true);
      for (std::size_t i = 0; i < clients_.size(); ++i) {
        if (readable[i + 1].revents != 0) stays[i] = serve(&clients_[i]);
        if (Clock::now() - clients_[i].heard > kIdleMost) stays[i] = false;
      }
      for (std::size_t i = clients_.size(); i-- > 0;) {
        if (!stays[i]) clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
      }
      if (readable[0].revents != 0) accept_clients();
      clients_now_ = clients_.size();
    }
    clients_.clear();
  }

  // All that wait, but no more than there are places: then those that are there have their turn.
  void accept_clients() {
    for (std::size_t i = 0; i < kClientsMost; ++i) {
      sockaddr_storage from{};
      socklen_t size = sizeof from;
      Socket socket(accept4(server_.get(), reinterpret_cast<sockaddr*>(&from), &size, SOCK_CLOEXEC | SOCK_NONBLOCK));
      if (socket.get() >= 0) {
        admit(std::move(socket), ipv4_of(from));
        continue;
      }
      // Without descriptors the next one waits on, and poll would tell of it again and again.
      if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) std::this_thread::sleep_for(kRest);
      return;
    }
  }

  void admit(Socket socket, std::optional<std::uint32_t> address) {
    if (clients_.size() == kClientsMost) {
      clients_.erase(std::min_element(clients_.begin(), clients_.end(),
                                      [](const Client& a, const Client& b) { return a.heard < b.heard; }));
    }
    clients_.push_back({std::move(socket), address, Clock::now(), {}});
  }

  // False when the connection is at its end.
  bool serve(Client* client) {
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> part{};
    const ssize_t count = recv(client->socket.get(), part.data(), part.size(), 0);
    if (count < 0) return errno == EAGAIN || errno == EINTR;
    if (count == 0) return false;
    client->heard = Clock::now();
    client->bytes.insert(client->bytes.end(), part.begin(), part.begin() + count);
    while (true) {
      const int whole = request_bytes(client->bytes.data(), client->bytes.size());
      if (whole < 0) ++no_modbus_;
      if (whole <= 0) return whole == 0;
      bool was_refused = false;
      ++requests_;
      if (!registers_.answer(client->socket.get(), client->address, client->bytes.data(), whole, &was_refused)) {
        return false;
      }
      if (was_refused) ++refused_;
      client->bytes.erase(client->bytes.begin(), client->bytes.begin() + whole);
    }
  }

  std::string at_, writer_;
  ModbusRegisters registers_;
  Socket server_;
  std::vector<Client> clients_;
  std::thread thread_;
  std::atomic<bool> ending_{false};
  std::atomic<std::uint64_t> clients_now_{0}, requests_{0}, refused_{0}, no_modbus_{0};
};

}  // namespace

std::unique_ptr<Sink> make_modbus_sink(const LoadedConfig& loaded, const Images& images, const StopBoard* stop,
                                       CommandBoard* commands) {
  return std::make_unique<ModbusServer>(loaded, images, stop, commands);
}

}  // namespace pose_wall::tools::live
