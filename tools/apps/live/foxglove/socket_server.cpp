// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/foxglove/socket_server.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>
#include <vector>

#include "apps/live/web/event_loop.hpp"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;

// As many as the page has; each may take ten clouds a second.
constexpr std::size_t kClientsMost = 16;
constexpr unsigned kConnectionsMost = 64;  // clients, and those that are still asking or are turned away
// So long after the last sign of life a client is asked for one, and so long after that it is ended.
constexpr std::uint16_t kAskAfter_s = 5, kEndAfter_s = 15;
constexpr std::size_t kPieceBytes = 65536;        // of a message, between those to others
constexpr std::size_t kReceivedBytes = 4096;      // at once; a request of a viewer is shorter
constexpr std::size_t kRequestBytesMost = 65536;  // thousands of subscriptions
// A viewer asks once for each channel, all at once when it opens a layout.
constexpr int kRequestsMost = 500;
constexpr auto kRequestsIn = std::chrono::seconds(1);
constexpr unsigned kUpgradeRequired = 426;  // RFC 9110; the library has no name for it

}  // namespace

struct SocketServer::Session {
  std::unique_ptr<SocketTalk> talk;
  std::optional<SocketMessage> message;      // on its way
  std::size_t sent = 0;                      // of it
  std::optional<Clock::time_point> sent_at;  // of a piece that the client has not taken yet
  std::string request;                       // so far
  Clock::time_point counted_since = Clock::now();
  int requests = 0;  // since then
  bool is_too_loud = false;
};

// What the library calls. It knows the server by the context.
struct SocketLoop {
  static int call(lws* connection, lws_callback_reasons why, void* /*session*/, void* in, std::size_t length) {
    return without_throwing("foxglove", [=] { return take(connection, why, in, length); });
  }

  static int take(lws* connection, lws_callback_reasons why, void* in, std::size_t length) {
    auto* const server = static_cast<SocketServer*>(lws_context_user(lws_get_context(connection)));
    switch (why) {
      case LWS_CALLBACK_HTTP:
        lws_return_http_status(connection, kUpgradeRequired, server->manners_.greeting.c_str());
        return -1;
      case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
        if (server->lets_in(connection)) return 0;
        ++server->turned_away_;
        lws_return_http_status(connection, HTTP_STATUS_FORBIDDEN, nullptr);
        return -1;
      case LWS_CALLBACK_ESTABLISHED:
        server->begin(connection);
        return 0;
      case LWS_CALLBACK_SERVER_WRITEABLE:
        return server->go_on(connection);
      case LWS_CALLBACK_RECEIVE:
        return server->take(connection, {static_cast<const char*>(in), length});
      case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
        server->wake_all();
        return 0;
      case LWS_CALLBACK_CLOSED:
      case LWS_CALLBACK_WSI_DESTROY:
        server->end(connection);
        return 0;
      default:
        return lws_callback_http_dummy(connection, why, nullptr, in, length);
    }
  }
};

SocketServer::SocketServer(HostPort place, Manners manners)
    : place_(std::move(place)), manners_(std::move(manners)), loop_(std::make_unique<EventLoop>()) {}

SocketServer::~SocketServer() {
  stop();
}

void SocketServer::start() {
  // The first is for those who ask for none; nobody gets it.
  const auto protocols = std::make_shared<std::vector<lws_protocols>>();
  protocols->push_back({"http", &SocketLoop::call, 0, 0, 0, nullptr, 0});
  for (const std::string& name : manners_.protocols) {
    protocols->push_back({name.c_str(), &SocketLoop::call, 0, kReceivedBytes, 0, nullptr, 0});
  }
  protocols->push_back({});
  protocols_ = protocols;
  static const lws_retry_bo_t kSigns = {nullptr, 0, 0, kAskAfter_s, kEndAfter_s, 0};
  lws_context_creation_info info{};
  info.protocols = protocols->data();
  info.user = this;
  info.retry_and_idle_policy = &kSigns;
  loop_->start(place_, kConnectionsMost, info, [this] { wake_all(); });
}

void SocketServer::wake() {
  loop_->wake();
}

void SocketServer::stop() {
  loop_->stop();
}

bool SocketServer::serves() const {
  return loop_->serves();
}

void SocketServer::wake_all() {
  for (const auto& [connection, session] : sessions_) lws_callback_on_writable(connection);
}

// On loopback only under this machine's own names, or a page of somebody else's whose name is pointed here could read
// it (DNS rebinding).
bool SocketServer::lets_in(lws* connection) const {
  if (sessions_.size() >= kClientsMost) return false;
  const std::string asked = header_text(connection, WSI_TOKEN_PROTOCOL);
  const lws_protocols* const given = lws_get_protocol(connection);
  const bool is_spoken = given != nullptr && std::find(manners_.protocols.begin(), manners_.protocols.end(),
                                                       given->name) != manners_.protocols.end();
  if (asked.empty() || !is_spoken) return false;
  if (is_loopback(place_.host) && !is_loopback(host_of(header_text(connection, WSI_TOKEN_HOST)))) return false;
  return manners_.admits(header_text(connection, WSI_TOKEN_ORIGIN));
}

void SocketServer::begin(lws* connection) {
  auto session = std::make_unique<Session>();
  session->talk = manners_.begins();
  sessions_[connection] = std::move(session);
  lws_callback_on_writable(connection);
}

// One piece of a message at a time: what a slow client takes is seen, and others have their turn between. The library
// closes the connection for all that is not 0.
int SocketServer::go_on(lws* connection) {
  const auto found = sessions_.find(connection);
  if (found == sessions_.end()) return 0;
  Session& session = *found->second;
  if (session.is_too_loud) return -1;
  session.sent_at.reset();
  lws_set_timeout(connection, NO_PENDING_TIMEOUT, 0);
  if (!session.message) {
    session.message = session.talk->next();
    session.sent = 0;
    if (!session.message) return 0;
  }
  const SocketMessage& message = *session.message;
  const std::size_t whole = message.head.size() + message.body->size();
  const std::size_t now = std::min(whole - session.sent, kPieceBytes);
  const bool is_first = session.sent == 0, is_last = session.sent + now == whole;
  std::vector<unsigned char> piece(LWS_PRE + now);
  // The head is shorter than a piece.
  const std::size_t of_head = is_first ? message.head.size() : 0;
  std::memcpy(piece.data() + LWS_PRE, message.head.data(), of_head);
  std::memcpy(piece.data() + LWS_PRE + of_head,
              message.body->data() + (is_first ? 0 : session.sent - message.head.size()), now - of_head);
  const int kind = lws_write_ws_flags(message.is_text ? LWS_WRITE_TEXT : LWS_WRITE_BINARY, is_first, is_last);
  if (lws_write(connection, piece.data() + LWS_PRE, now, static_cast<lws_write_protocol>(kind)) < 0) return -1;
  session.sent += now;
  session.sent_at = Clock::now();
  if (is_last) session.message.reset();
  lws_set_timeout(connection, PENDING_TIMEOUT_USER_REASON_BASE, kTimeout_s);
  lws_callback_on_writable(connection);
  return 0;
}

int SocketServer::take(lws* connection, std::string_view piece) {
  const auto found = sessions_.find(connection);
  if (found == sessions_.end()) return -1;
  Session& session = *found->second;
  session.request.append(piece);
  if (Clock::now() - session.counted_since > kRequestsIn) session.requests = 0, session.counted_since = Clock::now();
  if (session.request.size() > kRequestBytesMost || ++session.requests > kRequestsMost) {
    session.is_too_loud = true;
    return -1;
  }
  if (lws_is_final_fragment(connection) == 0) return 0;
  session.talk->hear(session.request, lws_frame_is_binary(connection) == 0);
  session.request.clear();
  lws_callback_on_writable(connection);
  return 0;
}

void SocketServer::end(lws* connection) {
  const auto session = sessions_.find(connection);
  if (session == sessions_.end()) return;
  const std::optional<Clock::time_point>& sent_at = session->second->sent_at;
  const bool took_nothing = sent_at && Clock::now() - *sent_at >= std::chrono::seconds(kTimeout_s);
  if (took_nothing || session->second->is_too_loud) ++cut_off_;
  sessions_.erase(session);
}

}  // namespace pose_wall::tools::live
