// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros2/ros2_node.hpp"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dirent.h>
#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstring>
#include <set>
#include <stdexcept>
#include <utility>

#include "apps/live/log.hpp"
#include "apps/live/ros2/raw_type.hpp"

namespace pose_wall::tools::live {
namespace {

// rmw_dds_common: one topic for all of ROS's graph, without the prefix of topics of nodes.
constexpr const char* kGraphTopic = "ros_discovery_info";
constexpr RosQos kGraphQos{true, true, 1};

DdsEntity made(DdsEntity entity, const std::string& what) {
  if (entity > 0) return entity;
  throw std::runtime_error(fmt::format("ROS 2: DDS cannot make {}: {}", what, dds_strretcode(entity)));
}

Gid gid_of(DdsEntity entity) {
  dds_guid_t guid{};
  Gid gid{};
  if (dds_get_guid(entity, &guid) == DDS_RETCODE_OK) std::copy(std::begin(guid.v), std::end(guid.v), gid.begin());
  return gid;
}

using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;

Qos new_qos(const std::string& user_data) {
  Qos qos(dds_create_qos(), dds_delete_qos);
  if (!user_data.empty()) dds_qset_userdata(qos.get(), user_data.data(), user_data.size());
  return qos;
}

Qos endpoint_settings(const RosQos& of, const std::string& user_data) {
  Qos qos = new_qos(user_data);
  dds_qset_reliability(qos.get(), of.is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(Ros2Node::kWriteWait_ms));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, of.depth);
  dds_qset_durability(qos.get(), of.is_latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  if (of.is_latched) {
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, of.depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  dds_qset_writer_data_lifecycle(qos.get(), false);  // no autodispose, as rmw_cyclonedds
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

// Whoever sends garbage makes Cyclone complain of each packet; the journal shall not be filled by it.
class CycloneLog {
 public:
  void line(Grade grade, const std::string& text) {
    const std::lock_guard<std::mutex> locked(lock_);
    const Clock::time_point now = Clock::now();
    if (now - began_ >= kPeriod) {
      if (left_out_ > 0) log_line(Grade::kWarning, "ros2", fmt::format("Cyclone DDS: {} lines left out", left_out_));
      began_ = now;
      written_ = left_out_ = 0;
    }
    if (written_ >= kLinesMost) {
      ++left_out_;
      return;
    }
    ++written_;
    log_line(grade, "ros2", "Cyclone DDS: " + text);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto kPeriod = std::chrono::seconds(60);
  static constexpr std::uint64_t kLinesMost = 10;

  std::mutex lock_;
  Clock::time_point began_{};
  std::uint64_t written_ = 0, left_out_ = 0;
};

// What Cyclone has to say goes the way of all that the daemon says.
void log_of_cyclone(void* /*nothing*/, const dds_log_data_t* data) {
  static CycloneLog log;
  const std::size_t head = std::min(data->hdrsize, data->size);
  std::string text(data->message + head, data->size - head);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.pop_back();
  const bool is_bad = (data->priority & (DDS_LC_FATAL | DDS_LC_ERROR)) != 0;
  const bool is_warning = (data->priority & DDS_LC_WARNING) != 0;
  log.line(is_bad ? Grade::kBad : is_warning ? Grade::kWarning : Grade::kGood, text);
}

std::set<int> datagram_sockets() {
  std::set<int> sockets;
  DIR* folder = opendir("/proc/self/fd");
  if (folder == nullptr) return sockets;
  while (const dirent* entry = readdir(folder)) {
    const char* end = entry->d_name + std::strlen(entry->d_name);
    int file = -1, type = 0;
    socklen_t size = sizeof type;
    if (std::from_chars(entry->d_name, end, file).ec != std::errc()) continue;
    if (getsockopt(file, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_DGRAM) sockets.insert(file);
  }
  closedir(folder);
  return sockets;
}

// The largest buffer of the sockets that were not there before: those that Cyclone receives with, for the one that it
// sends with is left as it is. The kernel tells twice what a program may fill (socket(7)).
std::uint64_t receive_buffer_of_new(const std::set<int>& before) {
  std::uint64_t largest = 0;
  for (const int file : datagram_sockets()) {
    int bytes = 0;
    socklen_t size = sizeof bytes;
    if (before.count(file) > 0 || getsockopt(file, SOL_SOCKET, SO_RCVBUF, &bytes, &size) != 0) continue;
    largest = std::max(largest, static_cast<std::uint64_t>(bytes) / 2);
  }
  return largest;
}

}  // namespace

std::string dds_topic(const std::string& topic) {
  const std::string absolute = !topic.empty() && topic.front() == '/' ? topic : "/" + topic;
  char last = '\0';
  for (const char c : absolute) {
    const bool is_digit = c >= '0' && c <= '9';
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    if (!(is_letter || (c == '/' && last != '/') || (is_digit && last != '/'))) {
      throw std::runtime_error(fmt::format(
          "'{}' is no topic of ROS 2: words of letters, digits and _ between single slashes are, none beginning with a "
          "digit",
          topic));
    }
    last = c;
  }
  if (last == '/') throw std::runtime_error(fmt::format("'{}' is no topic of ROS 2: it ends in a slash", topic));
  return "rt" + absolute;
}

Ros2Node::Endpoint::Endpoint(Ros2Node& node, std::string topic, const RosType& type, const RosQos& qos, bool is_writer)
    : node_(node), topic_(std::move(topic)), type_(type), is_writer_(is_writer) {
  const std::string name = topic_ == kGraphTopic ? topic_ : dds_topic(topic_);
  ddsi_sertype* sertype = new_raw_type(type.dds_name());
  topic_entity_ = made(dds_create_topic_sertype(node.participant_, name.c_str(), &sertype, nullptr, nullptr, nullptr),
                       "the topic " + topic_);
  sertype_ = sertype;
  const Qos settings = endpoint_settings(qos, endpoint_user_data(node.environment_.distro, type.hash));
  entity_ = is_writer ? dds_create_writer(node.participant_, topic_entity_, settings.get(), nullptr)
                      : dds_create_reader(node.participant_, topic_entity_, settings.get(), nullptr);
  if (entity_ <= 0) {
    const DdsEntity fault = entity_;
    dds_delete(topic_entity_);
    made(fault, (is_writer ? "a writer of " : "a reader of ") + topic_);
  }
  gid_ = gid_of(entity_);
  if (is_writer) return;
  condition_ = dds_create_readcondition(entity_, DDS_ANY_STATE);
  waitset_ = dds_create_waitset(node.participant_);
  dds_waitset_attach(waitset_, condition_, 0);
}

Ros2Node::Endpoint::~Endpoint() {
  if (topic_ != kGraphTopic) node_.remove_from_graph(*this);
  if (!is_writer_) dds_delete(waitset_);
  dds_delete(entity_);
  dds_delete(topic_entity_);
}

EndpointQos Ros2Node::Endpoint::qos() const {
  const Qos qos = new_qos("");
  return dds_get_qos(entity_, qos.get()) == DDS_RETCODE_OK ? endpoint_qos(qos.get()) : EndpointQos{};
}

std::uint32_t Ros2Node::Endpoint::matched() const {
  if (is_writer_) {
    dds_publication_matched_status_t status{};
    return dds_get_publication_matched_status(entity_, &status) == DDS_RETCODE_OK ? status.current_count : 0;
  }
  dds_subscription_matched_status_t status{};
  return dds_get_subscription_matched_status(entity_, &status) == DDS_RETCODE_OK ? status.current_count : 0;
}

bool Ros2Node::Endpoint::write(const std::string& message) const {
  ddsi_serdata* sample = new_raw_sample(sertype_, message);
  return sample != nullptr && dds_writecdr(entity_, sample) == DDS_RETCODE_OK;
}

void Ros2Node::Endpoint::wait(std::int64_t at_most_ms) const {
  dds_attach_t triggered = 0;
  const dds_return_t count = dds_waitset_wait(waitset_, &triggered, 1, DDS_MSECS(at_most_ms));
  // What cannot be waited for is still not looked at without a pause.
  if (count < 0) dds_sleepfor(DDS_MSECS(at_most_ms));
}

std::uint64_t Ros2Node::Endpoint::lost() const {
  dds_sample_lost_status_t status{};
  return dds_get_sample_lost_status(entity_, &status) == DDS_RETCODE_OK ? status.total_count : 0;
}

void Ros2Node::Endpoint::take(const std::function<void(ByteView)>& with) const {
  constexpr std::uint32_t kAtOnce = 8;
  std::array<ddsi_serdata*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  while (true) {
    const dds_return_t count = dds_takecdr(entity_, samples.data(), kAtOnce, infos.data(), DDS_ANY_STATE);
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::max(count, 0)); ++i) {
      const ByteView bytes = raw_bytes(samples[i]);
      if (infos[i].valid_data && bytes.size > 0) with(bytes);
      ddsi_serdata_unref(samples[i]);
    }
    if (count < static_cast<dds_return_t>(kAtOnce)) return;
  }
}

Ros2Node::Ros2Node(std::string name, RosEnvironment environment, const CycloneLimits& limits)
    : environment_(std::move(environment)), limits_(limits) {
  node_.node_namespace = "/";
  node_.name = std::move(name);
}

Ros2Node::~Ros2Node() {
  graph_writer_.reset();
  if (domain_ > 0) dds_delete(domain_);
}

void Ros2Node::start() {
  const std::lock_guard<std::mutex> locked(start_lock_);
  if (participant_ > 0) return;
  interface_ = choose_interface(environment_, network_interfaces());
  const std::set<int> sockets_before = datagram_sockets();
  join();
  receive_buffer_bytes_ = receive_buffer_of_new(sockets_before);
  log_line(Grade::kGood, "ros2", environment_text(environment_, interface_));
}

std::string Ros2Node::trouble() const {
  const bool is_cut_off = interface_ && interface_->is_loopback && environment_.range == DiscoveryRange::kSubnet;
  return is_cut_off
             ? "no network but loopback was up at the start: nodes of other machines are not found until the daemon "
               "is started anew"
             : "";
}

void Ros2Node::join() {
  dds_set_log_sink(log_of_cyclone, nullptr);
  domain_ = made(dds_create_domain(environment_.domain_id, cyclone_settings(environment_, interface_, limits_).c_str()),
                 fmt::format("domain {}", environment_.domain_id));
  const Qos qos = new_qos(participant_user_data());
  participant_ = made(dds_create_participant(environment_.domain_id, qos.get(), nullptr),
                      fmt::format("a participant of domain {}", environment_.domain_id));
  gid_ = gid_of(participant_);
  graph_writer_ = std::make_unique<Endpoint>(*this, kGraphTopic, kParticipantEntitiesType, kGraphQos, true);
  const std::lock_guard<std::mutex> locked(graph_lock_);
  tell_graph();
}

void Ros2Node::tell_graph() {
  if (graph_writer_) graph_writer_->write(graph_message(environment_.distro, gid_, {node_}));
}

void Ros2Node::add_to_graph(const Endpoint& endpoint) {
  const std::lock_guard<std::mutex> locked(graph_lock_);
  (endpoint.is_writer_ ? node_.writers : node_.readers).push_back(endpoint.gid_);
  tell_graph();
}

void Ros2Node::remove_from_graph(const Endpoint& endpoint) {
  const std::lock_guard<std::mutex> locked(graph_lock_);
  std::vector<Gid>& gids = endpoint.is_writer_ ? node_.writers : node_.readers;
  gids.erase(std::remove(gids.begin(), gids.end(), endpoint.gid_), gids.end());
  tell_graph();
}

std::unique_ptr<Ros2Node::Endpoint> Ros2Node::make_reader(const std::string& topic, const RosType& type,
                                                          const RosQos& qos) {
  auto endpoint = std::make_unique<Endpoint>(*this, topic, type, qos, false);
  add_to_graph(*endpoint);
  return endpoint;
}

std::unique_ptr<Ros2Node::Endpoint> Ros2Node::make_writer(const std::string& topic, const RosType& type,
                                                          const RosQos& qos) {
  auto endpoint = std::make_unique<Endpoint>(*this, topic, type, qos, true);
  add_to_graph(*endpoint);
  return endpoint;
}

}  // namespace pose_wall::tools::live
