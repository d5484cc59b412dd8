// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros1/master_line.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "apps/live/thread_name.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::string_view kScheme = "http://";
// How often it looks whether a name was resolved or a time is over.
constexpr int kLook_ms = 50;

class File {
 public:
  explicit File(int number) : number_(number) {}
  ~File() {
    if (number_ >= 0) ::close(number_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

bool is_for_later(int error) {
  return error == EAGAIN || error == EINTR || error == EINPROGRESS;
}

// Bytes on their way from one side to the other; no more is read before they are written.
struct Direction {
  std::string waiting;
  bool from_ended = false;

  bool reads() const { return waiting.empty() && !from_ended; }
  // False where the side failed.
  bool read(int from) {
    char bytes[16384];
    const ssize_t count = recv(from, bytes, sizeof bytes, 0);
    if (count < 0) return is_for_later(errno);
    from_ended = count == 0;
    waiting.assign(bytes, static_cast<std::size_t>(count));
    return true;
  }
  bool write(int to) {
    const ssize_t count = send(to, waiting.data(), waiting.size(), MSG_NOSIGNAL);
    if (count < 0) return is_for_later(errno);
    waiting.erase(0, static_cast<std::size_t>(count));
    return true;
  }
};

}  // namespace

std::optional<HostPort> parse_master_uri(const std::string& uri) {
  if (uri.compare(0, kScheme.size(), kScheme) != 0) return std::nullopt;
  std::string rest = uri.substr(kScheme.size());
  if (!rest.empty() && rest.back() == '/') rest.pop_back();
  return parse_host_port(rest);
}

bool is_told(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

MasterAddress master_of_environment() {
  constexpr const char* kUsual = "http://localhost:11311";  // https://wiki.ros.org/ROS/EnvironmentVariables
  const std::string uri = is_told("ROS_MASTER_URI") ? std::getenv("ROS_MASTER_URI") : kUsual;
  const std::optional<HostPort> place = parse_master_uri(uri);
  if (place) return {uri, *place};
  throw std::runtime_error(fmt::format("ROS_MASTER_URI: '{}' is no address of a master; allowed: {}", uri, kUsual));
}

// By a thread of its own, because nobody can hurry a name server: it may outlive the line.
struct MasterLine::Lookup {
  std::atomic<bool> done{false};
  bool found = false;
  sockaddr_in address{};

  void run(const HostPort& master) {
    addrinfo hints{};
    hints.ai_family = AF_INET;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* list = nullptr;
    if (getaddrinfo(master.host.c_str(), std::to_string(master.port).c_str(), &hints, &list) == 0 && list != nullptr) {
      std::memcpy(&address, list->ai_addr, std::min<std::size_t>(sizeof address, list->ai_addrlen));
      found = true;
    }
    if (list != nullptr) freeaddrinfo(list);
    done = true;
  }
};

// One connection of roscpp and its twin to the master.
class MasterLine::Call {
 public:
  explicit Call(int asker) : asker_(asker), heard_(Clock::now()) {}

  bool has_ended() const { return ended_; }
  bool reached_master() const { return reached_; }

  void connect_to(const Lookup& lookup) {
    if (master_ || ended_) return;
    master_ = std::make_unique<File>(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const auto* address = reinterpret_cast<const sockaddr*>(&lookup.address);
    const bool goes = lookup.found && master_->number() >= 0 &&
                      (::connect(master_->number(), address, sizeof lookup.address) == 0 || is_for_later(errno));
    ended_ = !goes;
  }

  // Two entries; one that is not looked at has a negative number.
  void add_to(std::vector<pollfd>* polled) const {
    polled->push_back(master_ ? entry(asker_.number(), question_, answer_) : pollfd{asker_.number(), 0, 0});
    polled->push_back(entry(master_ ? master_->number() : -1, answer_, question_));
  }

  void work(const pollfd& asker, const pollfd& master, Clock::time_point now) {
    if (!master_) {
      // Nobody waits for a name on behalf of one who hung up.
      ended_ = ended_ || asker.revents != 0 || now - heard_ > kPatience;
      return;
    }
    reached_ = reached_ || (master.revents != 0 && (master.revents & POLLERR) == 0);
    const bool well = move(asker, asker_.number(), master, master_->number(), &question_) &&
                      move(master, master_->number(), asker, asker_.number(), &answer_);
    // Between calls roscpp keeps the connection; only who asked waits for an answer.
    if ((asker.revents & POLLIN) != 0) {
      asked_ = true;
      heard_ = now;
    }
    if (reached_ && (master.revents & POLLIN) != 0) asked_ = false;
    const bool over =
        (question_.from_ended && question_.waiting.empty()) || (answer_.from_ended && answer_.waiting.empty());
    ended_ = !well || over || ((asked_ || !reached_) && now - heard_ > kPatience);
  }

 private:
  static pollfd entry(int file, const Direction& from_it, const Direction& to_it) {
    const int events = (from_it.reads() ? POLLIN : 0) | (to_it.waiting.empty() ? 0 : POLLOUT);
    return {file, static_cast<short>(events), 0};
  }

  static bool move(const pollfd& from, int from_file, const pollfd& to, int to_file, Direction* direction) {
    if ((to.revents & POLLOUT) != 0 && !direction->waiting.empty() && !direction->write(to_file)) return false;
    if ((from.revents & (POLLIN | POLLHUP | POLLERR)) == 0 || !direction->reads()) return true;
    return direction->read(from_file);
  }

  File asker_;
  std::unique_ptr<File> master_;
  Direction question_, answer_;
  Clock::time_point heard_;
  bool asked_ = false, reached_ = false, ended_ = false;
};

MasterLine::MasterLine(const HostPort& master)
    : master_(master), ends_at_(Clock::time_point::max().time_since_epoch().count()) {
  listens_ = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  wakes_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof own;
  auto* address = reinterpret_cast<sockaddr*>(&own);
  const bool listens = listens_ >= 0 && wakes_ >= 0 && bind(listens_, address, size) == 0 &&
                       listen(listens_, static_cast<int>(kCallsMost)) == 0 &&
                       getsockname(listens_, address, &size) == 0;
  if (!listens) {
    const std::string why = std::strerror(errno);
    if (listens_ >= 0) ::close(listens_);
    if (wakes_ >= 0) ::close(wakes_);
    throw std::runtime_error(fmt::format("no port of 127.0.0.1 to reach the master of ROS by: {}", why));
  }
  port_ = ntohs(own.sin_port);
  thread_ = std::thread([this] { run(); });
}

MasterLine::~MasterLine() {
  closing_ = true;
  end_within(std::chrono::milliseconds(0));
  thread_.join();
  ::close(listens_);
  ::close(wakes_);
}

std::string MasterLine::uri() const {
  return fmt::format("http://127.0.0.1:{}", port_);
}

void MasterLine::end_within(std::chrono::milliseconds time) {
  ends_at_ = (Clock::now() + time).time_since_epoch().count();
  const std::uint64_t once = 1;
  const ssize_t written = write(wakes_, &once, sizeof once);
  static_cast<void>(written);  // full: it wakes up anyhow
}

std::shared_ptr<const MasterLine::Lookup> MasterLine::look_up() {
  if (!lookup_) {
    lookup_ = std::make_shared<Lookup>();
    std::thread([lookup = lookup_, master = master_] { lookup->run(master); }).detach();
  }
  return lookup_->done ? lookup_ : nullptr;
}

void MasterLine::take_call() {
  const int asker = accept4(listens_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (asker < 0) return;
  auto call = std::make_unique<Call>(asker);
  if (calls_.size() < kCallsMost) calls_.push_back(std::move(call));
}

void MasterLine::run() {
  name_this_thread("ros1-line");
  std::vector<pollfd> polled;
  while (!closing_) {
    polled = {{listens_, POLLIN, 0}, {wakes_, POLLIN, 0}};
    for (const auto& call : calls_) call->add_to(&polled);
    poll(polled.data(), polled.size(), kLook_ms);
    std::uint64_t times = 0;
    if (read(wakes_, &times, sizeof times) > 0) continue;
    const Clock::time_point now = Clock::now();
    for (std::size_t i = 0; i < calls_.size(); ++i) calls_[i]->work(polled[2 + 2 * i], polled[3 + 2 * i], now);
    const bool is_over = now.time_since_epoch().count() >= ends_at_;
    // A machine that moved has another address: it is looked up again after each call that did not get there.
    const auto is_through = [](const auto& call) { return call->has_ended(); };
    if (std::any_of(calls_.begin(), calls_.end(),
                    [](const auto& call) { return call->has_ended() && !call->reached_master(); }))
      lookup_.reset();
    calls_.erase(std::remove_if(calls_.begin(), calls_.end(), is_through), calls_.end());
    if ((polled[0].revents & POLLIN) != 0) take_call();
    if (is_over) calls_.clear();
    if (calls_.empty()) continue;
    if (const std::shared_ptr<const Lookup> found = look_up()) {
      for (const auto& call : calls_) call->connect_to(*found);
    }
  }
}

}  // namespace pose_wall::tools::live
