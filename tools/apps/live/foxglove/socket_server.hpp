// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A server of WebSockets. One thread serves all connections by an event loop (libwebsockets). A client that is slow has
// one message on its way to it and nothing else, so it costs neither memory nor others' time; one that takes nothing
// for seconds is ended. The server stops within milliseconds, whatever its clients do.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/config_file/live_settings.hpp"

struct lws;

namespace pose_wall::tools::live {

class EventLoop;

// The head and then the body, as one message.
struct SocketMessage {
  bool is_text = true;
  std::string head;
  std::shared_ptr<const std::string> body;
};

// One client. All calls come from the server's thread.
class SocketTalk {
 public:
  SocketTalk() = default;
  SocketTalk(const SocketTalk&) = delete;
  SocketTalk& operator=(const SocketTalk&) = delete;
  virtual ~SocketTalk() = default;
  // What is sent next; none: nothing is new. Asked again whenever the client has taken what came before.
  virtual std::optional<SocketMessage> next() = 0;
  // What the client sent, whole. Must not wait.
  virtual void hear(std::string_view message, bool is_text) = 0;
};

class SocketServer {
 public:
  struct Manners {
    std::vector<std::string> protocols;  // names of the subprotocol; a client must ask for one of them
    std::string greeting;                // for browsers that come by HTTP
    // Whether a page of this origin may connect; "" is that of programs, which have none.
    std::function<bool(const std::string& origin)> admits;
    std::function<std::unique_ptr<SocketTalk>()> begins;  // a client that was let in
  };

  SocketServer(HostPort place, Manners manners);
  SocketServer(const SocketServer&) = delete;
  SocketServer& operator=(const SocketServer&) = delete;
  ~SocketServer();

  // Throws std::runtime_error where the address cannot be listened at.
  void start();
  // There is news, or may be; from any thread.
  void wake();
  // Ends every connection. May be called twice.
  void stop();

  std::uint64_t turned_away() const { return turned_away_; }  // by origin, name, protocol or number
  std::uint64_t cut_off() const { return cut_off_; }          // that took nothing, or sent too much
  // False once its loop has failed.
  bool serves() const;

 private:
  friend struct SocketLoop;
  struct Session;

  void wake_all();
  bool lets_in(lws* connection) const;
  void begin(lws* connection);
  int go_on(lws* connection);
  int take(lws* connection, std::string_view piece);
  void end(lws* connection);

  HostPort place_;
  Manners manners_;
  std::unordered_map<lws*, std::unique_ptr<Session>> sessions_;
  std::shared_ptr<void> protocols_;  // the library may keep a pointer to them
  std::atomic<std::uint64_t> turned_away_{0}, cut_off_{0};
  std::unique_ptr<EventLoop> loop_;  // last: it ends before what it turns
};

}  // namespace pose_wall::tools::live
