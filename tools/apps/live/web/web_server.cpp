// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/web/web_server.hpp"

#include <fmt/format.h>
#include <libwebsockets.h>
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

#include "apps/live/web/event_loop.hpp"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;

// Connections at once: ten times what sixteen viewers, their browsers' spare connections and monitors take.
constexpr unsigned kConnectionsMost = 512;
constexpr std::size_t kPieceBytes = 16384;  // of an answer, between those to others
constexpr std::size_t kHeadBytes = 2048;    // of an answer: the usual headers take 500

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
  const std::string length = header_text(connection, WSI_TOKEN_HTTP_CONTENT_LENGTH);
  return (!length.empty() && length != "0") || !header_text(connection, WSI_TOKEN_HTTP_TRANSFER_ENCODING).empty();
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
  static int call(lws* connection, lws_callback_reasons why, void* /*session*/, void* in, std::size_t length) {
    return without_throwing("page", [=] { return take(connection, why, in, length); });
  }

  static int take(lws* connection, lws_callback_reasons why, void* in, std::size_t length) {
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
};

WebServer::WebServer(HostPort place, WebAccess access, std::vector<std::pair<std::string, std::string>> usual_headers)
    : place_(std::move(place)),
      access_(std::move(access)),
      usual_headers_(std::move(usual_headers)),
      loop_(std::make_unique<EventLoop>()) {}

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
  lws_context_creation_info info{};
  info.protocols = kProtocols.data();
  info.user = this;
  const std::string& certificate = access_.certificate_file();
  if (!certificate.empty()) info.ssl_cert_filepath = info.ssl_private_key_filepath = certificate.c_str();
  loop_->start(place_, kConnectionsMost, info, [this] { wake_streams(); });
}

void WebServer::wake() {
  loop_->wake();
}

void WebServer::stop() {
  loop_->stop();
}

bool WebServer::serves() const {
  return loop_->serves();
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
  if (!header_text(connection, WSI_TOKEN_HTTP_RANGE).empty())
    return web_answer(416, "text/plain", "parts are not given\n");
  if (!access_.is_own_name(header_text(connection, WSI_TOKEN_HOST))) {
    return web_answer(421, "text/plain",
                      is_loopback(place_.host) ? "ask for localhost or 127.0.0.1\n"
                                               : "ask by this machine's address or name, or by one of http_names\n");
  }
  const WebAccess::Login login = access_.login(header_text(connection, WSI_TOKEN_HTTP_AUTHORIZATION));
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
  const WebRequest request{header_text(connection, WSI_TOKEN_HTTP_COOKIE), "",
                           header_text(connection, WSI_TOKEN_HTTP_ACCEPT)};
  return give(connection, gives_.at(path)(request), false);
}

// A page of somebody else's can have a browser send text, and nothing that is called JSON.
int WebServer::begin_body(lws* connection, const Take& take) {
  const std::string kind = header_text(connection, WSI_TOKEN_HTTP_CONTENT_TYPE);
  const std::string length = header_text(connection, WSI_TOKEN_HTTP_CONTENT_LENGTH);
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
  session->request.cookies = header_text(connection, WSI_TOKEN_HTTP_COOKIE);
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
