// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/web/event_loop.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

#include "apps/live/thread_name.hpp"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;

constexpr unsigned short kHeaderBytesMost = 4096;  // of a request: a browser's are below 1,000
constexpr lws_usec_t kTurnEvery_us = 500'000;      // a viewer that is gone is noticed by what it does not take
// The library comes back at once, again and again, while bytes wait that it does not read: those behind a request, or
// the end of a connection. So many turns of the loop in so long serve sixteen viewers five times over.
constexpr int kTurnsMost = 500;
constexpr auto kTurnsIn = std::chrono::milliseconds(100), kRest = std::chrono::milliseconds(1);

struct Address {
  std::string numbers;  // 0.0.0.0 and ::: all addresses
  bool is_ipv6;
};

// The library wants an address in numbers.
std::optional<Address> resolve(const HostPort& place) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  if (getaddrinfo(place.host.c_str(), nullptr, &hints, &found) != 0 || found == nullptr) return std::nullopt;
  std::array<char, NI_MAXHOST> numbers{};
  const int fault =
      getnameinfo(found->ai_addr, found->ai_addrlen, numbers.data(), numbers.size(), nullptr, 0, NI_NUMERICHOST);
  const Address address{numbers.data(), found->ai_family == AF_INET6};
  freeaddrinfo(found);
  if (fault != 0) return std::nullopt;
  return address;
}

}  // namespace

std::string header_text(lws* connection, lws_token_indexes which) {
  const int length = lws_hdr_total_length(connection, which);
  if (length <= 0) return "";
  std::string text(static_cast<std::size_t>(length) + 1, '\0');  // the copy ends with 0
  if (lws_hdr_copy(connection, text.data(), length + 1, which) < 0) return "";
  text.resize(static_cast<std::size_t>(length));
  return text;
}

std::string host_of(const std::string& header) {
  if (!header.empty() && header.front() == '[') return header.substr(1, header.find(']') - 1);
  return header.substr(0, header.rfind(':'));
}

struct EventLoop::Timer {
  lws_sorted_usec_list_t entry;  // the library knows the timer by it
  EventLoop* loop;
  static void call(lws_sorted_usec_list_t* entry) {
    Timer* const timer = lws_container_of(entry, Timer, entry);
    timer->loop->on_turn_();
    timer->set();
  }
  void set() { lws_sul_schedule(loop->context_, 0, &entry, &Timer::call, kTurnEvery_us); }
};

void EventLoop::start(const HostPort& place, unsigned connections_most, lws_context_creation_info info,
                      std::function<void()> on_turn) {
  lws_set_log_level(0, nullptr);  // it logs what clients do wrong
  const bool has_certificate = info.ssl_cert_filepath != nullptr;
  on_turn_ = std::move(on_turn);
  info.port = place.port;
  info.fd_limit_per_thread = connections_most;
  info.max_http_header_pool = static_cast<unsigned short>(connections_most);
  info.max_http_header_data = kHeaderBytesMost;
  info.timeout_secs = static_cast<unsigned>(kTimeout_s);
  info.keepalive_timeout = kTimeout_s;
  info.server_string = "pose_walld";
  info.alpn = "http/1.1";  // the other one has no Host, and many streams on a socket
  info.options |= LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND;
  if (has_certificate) info.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT;
  if (const std::optional<Address> address = resolve(place)) {
    if (!address->is_ipv6) info.options |= LWS_SERVER_OPTION_DISABLE_IPV6;
    address_ = address->numbers;
    if (address_ != "0.0.0.0" && address_ != "::") info.iface = address_.c_str();
    context_ = lws_create_context(&info);
  }
  if (context_ == nullptr) {
    throw std::runtime_error(
        fmt::format("cannot listen at {}:{}: the port is taken, not allowed, or the address is not this machine's{}",
                    place.host, place.port, has_certificate ? "; or the certificate and its key do not fit" : ""));
  }
  ending_ = false;
  serves_ = true;
  thread_ = std::thread([this] { serve(); });
}

void EventLoop::serve() {
  name_this_thread("web");
  Timer timer{{}, this};
  timer.set();
  int turns = 0;
  Clock::time_point since = Clock::now();
  while (!ending_ && lws_service(context_, 0) >= 0) {
    if (Clock::now() - since > kTurnsIn) turns = 0, since = Clock::now();
    if (++turns > kTurnsMost) std::this_thread::sleep_for(kRest);
  }
  serves_ = false;
  lws_sul_cancel(&timer.entry);
}

void EventLoop::wake() {
  if (context_ != nullptr) lws_cancel_service(context_);
}

void EventLoop::stop() {
  if (context_ == nullptr) return;
  ending_ = true;
  lws_cancel_service(context_);
  thread_.join();
  lws_context_destroy(context_);
  context_ = nullptr;
}

}  // namespace pose_wall::tools::live
