// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros1/ros1_node.hpp"

#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <topic_tools/shape_shifter.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <typeinfo>
#include <utility>

#include "apps/live/ros1/registrations.hpp"
#include "apps/live/thread_name.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr auto kLookForMaster = std::chrono::milliseconds(500);
constexpr double kSpin_s = 0.05;
constexpr std::uint32_t kQueueOut = 2;
// A clean end takes a dozen calls of a millisecond each; who waits for pose_walld waits a second.
constexpr auto kFarewell = std::chrono::milliseconds(250);
// roscpp tries again where the master went away between two calls; what was not registered then, the next look finds.
constexpr double kRetry_s = 0.1;

// Hands on the bytes of any type as roscpp received them, without a copy.
class BytesTaker final : public ros::SubscriptionCallbackHelper {
 public:
  explicit BytesTaker(Ros1Node::Take take) : take_(std::move(take)) {}

  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& message) override {
    const auto type = message.connection_header->find("type");
    take_(type != message.connection_header->end() ? type->second : "",
          {reinterpret_cast<const std::byte*>(message.buffer), message.length});
    return nullptr;  // nothing is left to call back with
  }
  void call(ros::SubscriptionCallbackHelperCallParams&) override {}
  const std::type_info& getTypeInfo() override { return typeid(BytesTaker); }
  bool isConst() override { return true; }
  bool hasHeader() override { return false; }

 private:
  Ros1Node::Take take_;
};

}  // namespace

// What lives from the first master to the end.
struct Ros1Node::Ros {
  ros::NodeHandle handle;
  std::vector<ros::Subscriber> subscribers;
  std::vector<ros::Publisher> publishers;
};

Ros1Node::Ros1Node(std::string name)
    : name_(std::move(name)), master_(master_of_environment()), queue_(std::make_unique<ros::CallbackQueue>()) {}

Ros1Node::~Ros1Node() {
  stop();
}

void Ros1Node::subscribe(const std::string& topic, std::uint32_t queue, Take take) {
  subscriptions_.push_back({topic, queue, std::move(take)});
}

std::size_t Ros1Node::advertise(const std::string& topic, const RosType& type, bool is_latched) {
  advertised_.push_back({topic, &type, is_latched, ""});
  subscribers_.push_back(0);
  return advertised_.size() - 1;
}

void Ros1Node::start() {
  if (master_thread_.joinable()) return;
  ending_ = false;
  line_ = std::make_unique<MasterLine>(master_.place);
  if (!ros::isInitialized()) {
    ros::init(ros::M_string{{"__master", line_->uri()}}, name_,
              ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
    ros::master::setRetryTimeout(ros::WallDuration(kRetry_s));
  }
  master_thread_ = std::thread([this] { attend_master(); });
  message_thread_ = std::thread([this] { take_messages(); });
}

void Ros1Node::stop() {
  {
    const std::lock_guard<std::mutex> locked(lock_);
    ending_ = true;
  }
  changed_.notify_all();
  if (message_thread_.joinable()) message_thread_.join();
  if (!master_thread_.joinable()) return;
  line_->end_within(kFarewell);
  master_thread_.join();
  line_.reset();
}

void Ros1Node::take_messages() {
  name_this_thread("ros1-messages");
  while (true) {
    {
      const std::lock_guard<std::mutex> locked(lock_);
      if (ending_) return;
    }
    queue_->callAvailable(ros::WallDuration(kSpin_s));
  }
}

void Ros1Node::attend_master() {
  name_this_thread("ros1-master");
  while (true) {
    has_master_ = !ended_by_ros_ && ros::master::check();
    if (has_master_ && !ros_) {
      open();
    } else if (has_master_) {
      register_what_is_missing();
    }
    ended_by_ros_ = ros_ && !ros::ok();
    count_peers();
    std::unique_lock<std::mutex> locked(lock_);
    if (changed_.wait_for(locked, kLookForMaster, [this] { return ending_; })) break;
  }
  std::unique_ptr<Ros> last;
  {
    const std::lock_guard<std::mutex> locked(lock_);
    last = std::move(ros_);
  }
  // While it unregisters nobody waits for the lock.
  last.reset();
}

void Ros1Node::open() {
  auto ros = std::make_unique<Ros>();
  // Nobody here caches parameters: what is not needed is not answered.
  ros::XMLRPCManager::instance()->unbind("paramUpdate");
  for (const Subscription& subscription : subscriptions_) {
    ros::SubscribeOptions options(subscription.topic, subscription.queue, "*", "*");
    options.helper = boost::make_shared<BytesTaker>(subscription.take);
    options.callback_queue = queue_.get();
    options.transport_hints = ros::TransportHints().tcpNoDelay();
    ros->subscribers.push_back(ros->handle.subscribe(options));
  }
  for (const Advertised& topic : advertised_) {
    ros::AdvertiseOptions options(topic.topic, kQueueOut, topic.type->md5, topic.type->name, topic.type->definition);
    options.latch = topic.is_latched;
    ros->publishers.push_back(ros->handle.advertise(options));
  }
  ++masters_seen_;
  const std::lock_guard<std::mutex> locked(lock_);
  ros_ = std::move(ros);
  for (std::size_t i = 0; i < advertised_.size(); ++i) {
    if (!advertised_[i].before_master.empty()) send(i, advertised_[i].before_master);
    advertised_[i].before_master.clear();
  }
}

// A new master knows nothing of us. Nor does one that has just met a newer node of our name, and is about to end us:
// who registered again at once would end the newer one. So it is looked twice.
void Ros1Node::register_what_is_missing() {
  const std::optional<Registered> known = registered_topics();
  if (!known) return;
  std::vector<std::string> not_subscribed;
  std::vector<std::size_t> not_published;
  for (const ros::Subscriber& subscriber : ros_->subscribers) {
    if (known->subscribed.count(subscriber.getTopic()) == 0) not_subscribed.push_back(subscriber.getTopic());
  }
  for (std::size_t i = 0; i < advertised_.size(); ++i) {
    if (known->published.count(ros_->publishers[i].getTopic()) == 0) not_published.push_back(i);
  }
  const bool is_missing = !not_subscribed.empty() || !not_published.empty();
  const bool was_missing = std::exchange(was_missing_, is_missing);
  if (!is_missing || !was_missing || is_replaced() || !ros::ok()) return;
  if (known->published.empty() && known->subscribed.empty()) ++masters_seen_;
  for (const std::string& topic : not_subscribed) register_subscriber(topic);
  for (const std::size_t i : not_published) {
    register_publisher(ros_->publishers[i].getTopic(), advertised_[i].type->name);
  }
}

void Ros1Node::count_peers() {
  const std::lock_guard<std::mutex> locked(lock_);
  std::uint32_t publishers = 0;
  if (ros_) {
    for (const ros::Subscriber& subscriber : ros_->subscribers) publishers += subscriber.getNumPublishers();
    for (std::size_t i = 0; i < subscribers_.size(); ++i) subscribers_[i] = ros_->publishers[i].getNumSubscribers();
  }
  publishers_ = publishers;
}

std::uint32_t Ros1Node::subscribers(std::size_t number) const {
  const std::lock_guard<std::mutex> locked(lock_);
  return subscribers_[number];
}

void Ros1Node::publish(std::size_t number, const std::string& message) {
  const std::lock_guard<std::mutex> locked(lock_);
  if (ros_) return send(number, message);
  // From then on roscpp keeps it.
  if (advertised_[number].is_latched) advertised_[number].before_master = message;
}

void Ros1Node::send(std::size_t number, const std::string& message) {
  const RosType& type = *advertised_[number].type;
  topic_tools::ShapeShifter shifter;
  shifter.morph(type.md5, type.name, type.definition, "");
  // It reads the bytes only.
  ros::serialization::IStream stream(reinterpret_cast<std::uint8_t*>(const_cast<char*>(message.data())),
                                     static_cast<std::uint32_t>(message.size()));
  shifter.read(stream);
  ros_->publishers[number].publish(shifter);
}

}  // namespace pose_wall::tools::live
