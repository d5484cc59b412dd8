// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A small web server: answers to GET, streams of events, and short messages by POST where somebody takes them. One
// thread serves all connections by an event loop (libwebsockets). So a client that is slow, idle or silent costs a
// descriptor and nobody's time. The server stops within milliseconds, whatever its clients do.

#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "apps/live/web/web_access.hpp"
#include "io/config_file/live_settings.hpp"

struct lws;

namespace pose_wall::tools::live {

class EventLoop;

// What one viewer gets bit by bit. All calls come from the server's thread.
class WebStream {
 public:
  WebStream() = default;
  WebStream(const WebStream&) = delete;
  WebStream& operator=(const WebStream&) = delete;
  virtual ~WebStream() = default;
  // What is sent next; none: nothing is new. Asked again whenever the viewer has taken what came before.
  virtual std::shared_ptr<const std::string> next() = 0;
};

struct WebAnswer {
  int status = 200;
  std::string type = "text/plain";
  std::shared_ptr<const std::string> content;
  std::vector<std::pair<std::string, std::string>> headers;  // "retry-after", "5": beside those of all answers
  std::unique_ptr<WebStream> stream;                         // in place of the content
  std::string file;                                          // likewise: a file of any size, read as it is sent
};
WebAnswer web_answer(int status, std::string type, std::shared_ptr<const std::string> content);
WebAnswer web_answer(int status, std::string type, std::string content);

struct WebRequest {
  std::string cookies;  // as the browser sends them
  std::string body;     // of a POST: JSON
  std::string accept;   // the types of content that are wanted; empty: it is not said
};

class WebServer {
 public:
  // In the server's thread: must not wait, as everybody else does meanwhile.
  using Give = std::function<WebAnswer()>;
  using Take = std::function<WebAnswer(const WebRequest&)>;

  // usual_headers: of each answer.
  WebServer(HostPort place, WebAccess access, std::vector<std::pair<std::string, std::string>> usual_headers);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  ~WebServer();

  // Before start. A path that nobody has named gets 404, another method 405. A body is JSON of at most kBodyBytesMost.
  static constexpr std::size_t kBodyBytesMost = 65536;
  void get(const std::string& path, Give give);
  void get(const std::string& path, Take give);
  void post(const std::string& path, Take take);
  // Throws std::runtime_error where the address cannot be listened at, or the certificate is of no use.
  void start();
  // Streams have news, or may have; from any thread.
  void wake();
  // Ends every connection. May be called twice.
  void stop();

  const WebAccess& access() const { return access_; }
  // Viewers of streams that took nothing for seconds, and were ended.
  std::uint64_t cut_off() const { return cut_off_; }
  // False once its loop has failed.
  bool serves() const;

 private:
  friend struct WebLoop;
  struct Session;

  void wake_streams();
  int begin(lws* connection, const std::string& path);
  int begin_body(lws* connection, const Take& take);
  int gather_body(lws* connection, std::string_view bytes);
  int end_body(lws* connection);
  int give(lws* connection, WebAnswer answer, bool closes);
  int go_on(lws* connection);
  static int complete(lws* connection, bool closes);
  int send_content(lws* connection, Session* session);
  int send_news(lws* connection, Session* session);
  bool send_head(lws* connection, const WebAnswer& answer, std::uint64_t bytes) const;
  std::optional<WebAnswer> refusal_of(lws* connection, const std::string& path);
  void end(lws* connection);

  HostPort place_;
  WebAccess access_;
  std::vector<std::pair<std::string, std::string>> usual_headers_;
  std::unordered_map<std::string, Take> gives_, takes_;
  std::unordered_map<lws*, std::unique_ptr<Session>> sessions_;
  std::atomic<std::uint64_t> cut_off_{0};
  std::unique_ptr<EventLoop> loop_;  // last: it ends before what it turns
};

}  // namespace pose_wall::tools::live
