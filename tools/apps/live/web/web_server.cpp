// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/web/web_server.hpp"

#include <fmt/format.h>
#include <libwebsockets.h>
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "apps/live/log.hpp"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;

// Connections at once: ten times what sixteen viewers, their browsers' spare connections and monitors take.
constexpr unsigned kConnectionsMost = 512;
constexpr unsigned short kHeaderBytesMost = 4096;  // of a request: a browser's are below 1,000
// Whoever is slower with a request, or takes nothing of an answer for so long, holds a descriptor for nothing. Links
// under ground lose packets for a second or two.
constexpr int kTimeout_s = 5;
constexpr lws_usec_t kWakeEvery_us = 500'000;  // a viewer that is gone is noticed by what it does not take
constexpr std::size_t kPieceBytes = 16384;     // of an answer, between those to others
// The library comes back at once, again and again, while bytes wait that it does not read: those behind a request, or
// the end of a connection. So many turns of the loop in so long serve sixteen viewers five times over.
constexpr int kTurnsMost = 500;
constexpr auto kTurnsIn = std::chrono::milliseconds(100), kRest = std::chrono::milliseconds(1);
constexpr std::size_t kHeadBytes = 2048;  // of an answer: the usual headers take 500

std::string header(lws* connection, lws_token_indexes which) {
  const int length = lws_hdr_total_length(connection, which);
  if (length <= 0) return "";
  std::string text(static_cast<std::size_t>(length) + 1, '\0');  // the copy ends with 0
  if (lws_hdr_copy(connection, text.data(), length + 1, which) < 0) return "";
  text.resize(static_cast<std::size_t>(length));
  return text;
}

bool is_get(lws* connection) {
  return lws_hdr_total_length(connection, WSI_TOKEN_GET_URI) > 0;
}

bool is_head(lws* connection) {
  return lws_hdr_total_length(connection, WSI_TOKEN_HEAD_URI) > 0;
}

bool is_post(lws* connection) {
  return lws_hdr_total_length(connection, WSI_TOKEN_POST_URI) > 0;
}

// What it would send is not read where nobody takes it, and the library would wait for it.
bool has_body(lws* connection) {
  const std::string length = header(connection, WSI_TOKEN_HTTP_CONTENT_LENGTH);
  return (!length.empty() && length != "0") || !header(connection, WSI_TOKEN_HTTP_TRANSFER_ENCODING).empty();
}

// Whether a viewer has sent something behind its request, or has gone.
bool says_more(lws* connection) {
  char one = 0;
  const ssize_t got = recv(lws_get_socket_fd(connection), &one, 1, MSG_PEEK | MSG_DONTWAIT);
  return got >= 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
}

// The library writes its own words before the bytes. Who takes nothing of them is ended in time. False: it has gone.
bool write_to(lws* connection, std::string_view bytes, lws_write_protocol kind) {
  std::vector<unsigned char> piece(LWS_PRE + bytes.size());
  std::memcpy(piece.data() + LWS_PRE, bytes.data(), bytes.size());
  if (lws_write(connection, piece.data() + LWS_PRE, bytes.size(), kind) < 0) return false;
  lws_set_timeout(connection, PENDING_TIMEOUT_HTTP_CONTENT, kTimeout_s);
  return true;
}

// The library wants an address in numbers.
std::optional<ListenAddress> resolve(const HostPort& place) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  if (getaddrinfo(place.host.c_str(), nullptr, &hints, &found) != 0 || found == nullptr) return std::nullopt;
  std::array<char, NI_MAXHOST> numbers{};
  const int fault =
      getnameinfo(found->ai_addr, found->ai_addrlen, numbers.data(), numbers.size(), nullptr, 0, NI_NUMERICHOST);
  const ListenAddress address{numbers.data(), found->ai_family == AF_INET6};
  freeaddrinfo(found);
  if (fault != 0) return std::nullopt;
  return address;
}

}  // namespace

WebAnswer web_answer(int status, std::string type, std::shared_ptr<const std::string> content) {
  WebAnswer answer;
  answer.status = status;
  answer.type = std::move(type);
  answer.content = std::move(content);
  return answer;
}

WebAnswer web_answer(int status, std::string type, std::string content) {
  return web_answer(status, std::move(type), std::make_shared<const std::string>(std::move(content)));
}

// Of one request.
struct WebServer::Session {
  std::shared_ptr<const std::string> content;
  std::ifstream file;       // in place of the content
  std::uint64_t bytes = 0;  // of either
  std::uint64_t sent = 0;
  const Take* take = nullptr;  // who takes the body, while it comes
  Clock::time_point began = Clock::now();
  WebRequest request;
  bool closes = false;  // after the answer: what else was sent is not read
  std::unique_ptr<WebStream> stream;
  std::optional<Clock::time_point> sent_at;  // of news that the viewer has not taken yet
};

// What the library calls. It knows the server by the context.
struct WebLoop {
  // The library is written in C: nothing may be thrown through it.
  static int call(lws* connection, lws_callback_reasons why, void* session, void* in, std::size_t length) {
    try {
      return take(connection, why, session, in, length);
    } catch (const std::exception& fault) {
      log_line(Grade::kBad, "page", fault.what());
      return -1;
    }
  }

  static int take(lws* connection, lws_callback_reasons why, void* /*session*/, void* in, std::size_t length) {
    lws_context* const context = lws_get_context(connection);
    auto* const server = static_cast<WebServer*>(lws_context_user(context));
    switch (why) {
      case LWS_CALLBACK_HTTP:
        return server->begin(connection, {static_cast<const char*>(in), length});
      case LWS_CALLBACK_HTTP_WRITEABLE:
        return server->go_on(connection);
      case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
        return -1;  // nothing else is spoken here
      case LWS_CALLBACK_HTTP_BODY:
        return server->gather_body(connection, {static_cast<const char*>(in), length});
      case LWS_CALLBACK_HTTP_BODY_COMPLETION:
        return server->end_body(connection);
      case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
        server->wake_streams();
        return 0;
      case LWS_CALLBACK_CLOSED_HTTP:
      case LWS_CALLBACK_WSI_DESTROY:
        server->end(connection);
        return 0;
      default:
        return lws_callback_http_dummy(connection, why, nullptr, in, length);
    }
  }

  struct Timer {
    lws_sorted_usec_list_t entry;  // the library knows the timer by it
    WebServer* server;
    static void call(lws_sorted_usec_list_t* entry) {
      Timer* const timer = lws_container_of(entry, Timer, entry);
      timer->server->wake_streams();
      timer->set();
    }
    void set() { lws_sul_schedule(server->context_, 0, &entry, &Timer::call, kWakeEvery_us); }
  };
};

WebServer::WebServer(HostPort place, WebAccess access, std::vector<std::pair<std::string, std::string>> usual_headers)
    : place_(std::move(place)), access_(std::move(access)), usual_headers_(std::move(usual_headers)) {}

WebServer::~WebServer() {
  stop();
}

void WebServer::get(const std::string& path, Give give) {
  gives_[path] = [give = std::move(give)](const WebRequest& /*request*/) { return give(); };
}

void WebServer::get(const std::string& path, Take give) {
  gives_[path] = std::move(give);
}

void WebServer::post(const std::string& path, Take take) {
  takes_[path] = std::move(take);
}

void WebServer::start() {
  static const std::array<lws_protocols, 2> kProtocols = {{{"http", &WebLoop::call, 0, 0, 0, nullptr, 0}, {}}};
  lws_set_log_level(0, nullptr);  // it logs what clients do wrong
  address_ = resolve(place_);
  lws_context_creation_info info{};
  info.port = place_.port;
  info.protocols = kProtocols.data();
  info.user = this;
  info.fd_limit_per_thread = kConnectionsMost;
  info.max_http_header_pool = kConnectionsMost;
  info.max_http_header_data = kHeaderBytesMost;
  info.timeout_secs = static_cast<unsigned>(kTimeout_s);
  info.keepalive_timeout = kTimeout_s;
  info.server_string = "pose_walld";
  info.alpn = "http/1.1";  // the other one has no Host, and many streams on a socket
  info.options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND;
  const std::string& certificate = access_.certificate_file();
  if (!certificate.empty()) {
    info.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT;
    info.ssl_cert_filepath = info.ssl_private_key_filepath = certificate.c_str();
  }
  if (address_) {
    if (!address_->is_ipv6) info.options |= LWS_SERVER_OPTION_DISABLE_IPV6;
    const bool is_any = address_->numbers == "0.0.0.0" || address_->numbers == "::";
    if (!is_any) info.iface = address_->numbers.c_str();
    context_ = lws_create_context(&info);
  }
  if (context_ == nullptr) {
    throw std::runtime_error(fmt::format(
        "cannot listen at {}:{}: the port is taken, not allowed, or the address is not this machine's{}", place_.host,
        place_.port, certificate.empty() ? "" : "; or the certificate and its key do not fit"));
  }
  ending_ = false;
  serves_ = true;
  thread_ = std::thread([this] { serve(); });
}

void WebServer::serve() {
  WebLoop::Timer timer{{}, this};
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

void WebServer::wake() {
  if (context_ != nullptr) lws_cancel_service(context_);
}

void WebServer::stop() {
  if (context_ == nullptr) return;
  ending_ = true;
  lws_cancel_service(context_);
  thread_.join();
  lws_context_destroy(context_);
  context_ = nullptr;
}

void WebServer::wake_streams() {
  for (const auto& [connection, session] : sessions_) {
    if (session->stream) lws_callback_on_writable(connection);
  }
}

// Why it is not answered. One small request with ranges could ask for the page a thousand times.
std::optional<WebAnswer> WebServer::refusal_of(lws* connection, const std::string& path) {
  const bool is_taken = takes_.count(path) > 0, is_reading = is_get(connection) || is_head(connection);
  if (!is_reading && !(is_taken && is_post(connection))) {
    WebAnswer answer = web_answer(405, "text/plain", "only GET and HEAD: nothing can be changed here\n");
    answer.headers.emplace_back("allow", "GET, HEAD");
    return answer;
  }
  if (is_reading && has_body(connection)) return web_answer(400, "text/plain", "a request has no body here\n");
  if (!header(connection, WSI_TOKEN_HTTP_RANGE).empty()) return web_answer(416, "text/plain", "parts are not given\n");
  if (!access_.is_own_name(header(connection, WSI_TOKEN_HOST))) {
    return web_answer(421, "text/plain",
                      is_loopback(place_.host) ? "ask for localhost or 127.0.0.1\n"
                                               : "ask by this machine's address or name, or by one of http_names\n");
  }
  const WebAccess::Login login = access_.login(header(connection, WSI_TOKEN_HTTP_AUTHORIZATION));
  if (login == WebAccess::Login::kTooOften) {
    WebAnswer answer = web_answer(429, "text/plain", "too many logins at once: try again\n");
    answer.headers.emplace_back("retry-after", "1");
    return answer;
  }
  if (login != WebAccess::Login::kGood) {
    WebAnswer answer = web_answer(401, "text/plain", "log in by name and password\n");
    answer.headers.emplace_back("www-authenticate", R"(Basic realm="pose_wall", charset="UTF-8")");
    return answer;
  }
  if (is_reading && gives_.count(path) == 0) return web_answer(404, "text/plain", "there is nothing of this name\n");
  return std::nullopt;
}

bool WebServer::send_head(lws* connection, const WebAnswer& answer, std::uint64_t bytes) const {
  std::array<unsigned char, LWS_PRE + kHeadBytes> head{};
  unsigned char* const begin = head.data() + LWS_PRE;
  unsigned char *at = begin, *const end = head.data() + head.size();
  const lws_filepos_t length = answer.stream ? LWS_ILLEGAL_HTTP_CONTENT_LEN : bytes;
  if (lws_add_http_common_headers(connection, static_cast<unsigned>(answer.status), answer.type.c_str(), length, &at,
                                  end) != 0) {
    return false;
  }
  const auto has_own = [&answer](const std::string& name) {
    return std::any_of(answer.headers.begin(), answer.headers.end(),
                       [&](const auto& own) { return own.first == name; });
  };
  for (const auto* headers : {&usual_headers_, &answer.headers}) {
    for (const auto& [name, value] : *headers) {
      if (headers == &usual_headers_ && has_own(name)) continue;
      const std::string with_colon = name + ":";
      if (lws_add_http_header_by_name(connection, reinterpret_cast<const unsigned char*>(with_colon.c_str()),
                                      reinterpret_cast<const unsigned char*>(value.data()),
                                      static_cast<int>(value.size()), &at, end) != 0) {
        return false;
      }
    }
  }
  return lws_finalize_write_http_header(connection, begin, &at, end) == 0;
}

// The library closes the connection for all that is not 0.
int WebServer::begin(lws* connection, const std::string& path) {
  std::optional<WebAnswer> refusal = refusal_of(connection, path);
  if (refusal) return give(connection, std::move(*refusal), is_post(connection) || has_body(connection));
  if (is_post(connection)) return begin_body(connection, takes_.at(path));
  const WebRequest request{header(connection, WSI_TOKEN_HTTP_COOKIE), ""};
  return give(connection, gives_.at(path)(request), false);
}

// A page of somebody else's can have a browser send text, and nothing that is called JSON.
int WebServer::begin_body(lws* connection, const Take& take) {
  const std::string kind = header(connection, WSI_TOKEN_HTTP_CONTENT_TYPE);
  const std::string length = header(connection, WSI_TOKEN_HTTP_CONTENT_LENGTH);
  std::uint64_t bytes = 0;
  const auto [end, fault] = std::from_chars(length.data(), length.data() + length.size(), bytes);
  if (kind.compare(0, std::strlen("application/json"), "application/json") != 0) {
    return give(connection, web_answer(415, "text/plain", "a message is application/json here\n"), true);
  }
  if (fault != std::errc() || end != length.data() + length.size() || bytes == 0) {
    return give(connection, web_answer(411, "text/plain", "a message tells its length here\n"), true);
  }
  if (bytes > kBodyBytesMost) {
    return give(connection,
                web_answer(413, "text/plain", fmt::format("a message has at most {} bytes here\n", kBodyBytesMost)),
                true);
  }
  auto session = std::make_unique<Session>();
  session->take = &take;
  session->request.cookies = header(connection, WSI_TOKEN_HTTP_COOKIE);
  sessions_[connection] = std::move(session);
  lws_set_timeout(connection, PENDING_TIMEOUT_HTTP_CONTENT, kTimeout_s);
  return 0;
}

// A message must be there in time as a whole: bytes that come one by one lengthen nothing.
int WebServer::gather_body(lws* connection, std::string_view bytes) {
  const auto session = sessions_.find(connection);
  if (session == sessions_.end() || session->second->take == nullptr) {  // it was refused, and is not read
    lws_set_timeout(connection, PENDING_TIMEOUT_HTTP_CONTENT, kTimeout_s);
    return 0;
  }
  std::string& body = session->second->request.body;
  body.append(bytes);
  const bool is_late = Clock::now() - session->second->began > std::chrono::seconds(kTimeout_s);
  return is_late || body.size() > kBodyBytesMost ? -1 : 0;
}

int WebServer::end_body(lws* connection) {
  const auto session = sessions_.find(connection);
  if (session == sessions_.end() || session->second->take == nullptr) return gather_body(connection, {});
  const Take& take = *session->second->take;
  const WebRequest request = std::move(session->second->request);
  sessions_.erase(session);
  return give(connection, take(request), false);
}

int WebServer::give(lws* connection, WebAnswer answer, bool closes) {
  auto session = std::make_unique<Session>();
  if (!answer.file.empty()) {
    session->file.open(answer.file, std::ios::binary | std::ios::ate);
    if (!session->file) answer = web_answer(404, "text/plain", "the file is gone\n");
  }
  session->bytes = session->file.is_open() ? static_cast<std::uint64_t>(session->file.tellg())
                   : answer.content        ? answer.content->size()
                                           : 0;
  session->file.seekg(0);
  if (!send_head(connection, answer, session->bytes)) return -1;
  if (is_head(connection) || (!answer.stream && session->bytes == 0)) return complete(connection, closes);
  session->content = std::move(answer.content);
  session->stream = std::move(answer.stream);
  session->closes = closes;
  sessions_[connection] = std::move(session);
  lws_set_timeout(connection, PENDING_TIMEOUT_HTTP_CONTENT, kTimeout_s);
  lws_callback_on_writable(connection);
  return 0;
}

// The library wants to be told to close what it says is not kept.
int WebServer::complete(lws* connection, bool closes) {
  return closes || lws_http_transaction_completed(connection) != 0 ? -1 : 0;
}

int WebServer::go_on(lws* connection) {
  const auto session = sessions_.find(connection);
  if (session == sessions_.end() || session->second->take != nullptr) return 0;
  return session->second->stream ? send_news(connection, session->second.get())
                                 : send_content(connection, session->second.get());
}

int WebServer::send_content(lws* connection, Session* session) {
  const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(session->bytes - session->sent, kPieceBytes));
  const bool is_last = session->sent + now == session->bytes;
  std::string from_file;
  if (session->file.is_open()) {
    from_file.resize(now);
    if (!session->file.read(from_file.data(), static_cast<std::streamsize>(now))) return -1;  // it became shorter
  }
  const std::string_view piece = session->file.is_open()
                                     ? std::string_view(from_file)
                                     : std::string_view(*session->content).substr(session->sent, now);
  if (!write_to(connection, piece, is_last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP)) return -1;
  session->sent += now;
  if (is_last) {
    const bool closes = session->closes;
    sessions_.erase(connection);
    return complete(connection, closes);
  }
  lws_callback_on_writable(connection);
  return 0;
}

int WebServer::send_news(lws* connection, Session* session) {
  if (says_more(connection)) return -1;
  session->sent_at.reset();
  lws_set_timeout(connection, NO_PENDING_TIMEOUT, 0);
  const std::shared_ptr<const std::string> news = session->stream->next();
  if (!news) return 0;
  if (!write_to(connection, *news, LWS_WRITE_HTTP)) return -1;
  session->sent_at = Clock::now();
  lws_callback_on_writable(connection);
  return 0;
}

void WebServer::end(lws* connection) {
  const auto session = sessions_.find(connection);
  if (session == sessions_.end()) return;
  const std::optional<Clock::time_point>& sent_at = session->second->sent_at;
  if (sent_at && Clock::now() - *sent_at >= std::chrono::seconds(kTimeout_s)) ++cut_off_;
  sessions_.erase(session);
}

}  // namespace pose_wall::tools::live
