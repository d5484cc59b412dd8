// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "live/ros1/ros1_node.hpp"

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <topic_tools/shape_shifter.h>

#include <chrono>
#include <cstdlib>
#include <optional>
#include <utility>

#include "live/log.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr const char* kUsualMaster = "http://localhost:11311";
constexpr auto kLookForMaster = std::chrono::milliseconds(500);
constexpr double kSpin_s = 0.05;
constexpr std::uint32_t kQueueOut = 2;

// The process number of the master: another one after it was started anew.
std::optional<std::int64_t> master_pid() {
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getPid", request, response, payload, false)) return std::nullopt;
  return static_cast<int>(payload);
}

}  // namespace

// What lives between one master and the next.
struct Ros1Node::Ros {
  ros::NodeHandle handle;
  ros::CallbackQueue queue;
  std::vector<ros::Subscriber> subscribers;
  std::vector<ros::Publisher> publishers;
  std::int64_t master_pid = 0;
};

Ros1Node::Ros1Node(std::string name) : name_(std::move(name)) {}

Ros1Node::~Ros1Node() {
  stop();
}

void Ros1Node::subscribe(const std::string& topic, std::uint32_t queue, Take take) {
  subscriptions_.push_back({topic, queue, std::move(take)});
}

std::size_t Ros1Node::advertise(const std::string& topic, const RosType& type) {
  advertised_.push_back({topic, &type});
  subscribers_.push_back(0);
  return advertised_.size() - 1;
}

std::string Ros1Node::master_uri() const {
  const char* uri = std::getenv("ROS_MASTER_URI");
  return uri != nullptr && *uri != '\0' ? uri : kUsualMaster;
}

void Ros1Node::start() {
  if (thread_.joinable()) return;
  // Without it roscpp ends the process.
  setenv("ROS_MASTER_URI", master_uri().c_str(), 1);
  ending_ = false;
  if (!ros::isInitialized()) {
    ros::init(ros::M_string{}, name_, ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  }
  thread_ = std::thread([this] { run(); });
}

void Ros1Node::stop() {
  {
    const std::lock_guard<std::mutex> locked(lock_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Ros1Node::run() {
  using Clock = std::chrono::steady_clock;
  Clock::time_point looked{};
  while (true) {
    {
      std::unique_lock<std::mutex> locked(lock_);
      if (!ros_) changed_.wait_for(locked, kLookForMaster, [this] { return ending_; });
      if (ending_) break;
    }
    if (Clock::now() - looked >= kLookForMaster) {
      looked = Clock::now();
      const std::optional<std::int64_t> pid = master_pid();
      has_master_ = pid.has_value();
      if (pid && (!ros_ || ros_->master_pid != *pid)) attend(*pid);
      count_peers();
    }
    if (ros_) ros_->queue.callAvailable(ros::WallDuration(kSpin_s));
  }
  std::unique_ptr<Ros> last;
  {
    const std::lock_guard<std::mutex> locked(lock_);
    last = std::move(ros_);
  }
  // While it unregisters nobody waits for the lock.
  last.reset();
}

// A new master knows nothing of us: everything is registered anew.
void Ros1Node::attend(std::int64_t pid) {
  {
    std::unique_ptr<Ros> before;
    const std::lock_guard<std::mutex> locked(lock_);
    before = std::move(ros_);
  }
  auto ros = std::make_unique<Ros>();
  ros->master_pid = pid;
  ros->handle.setCallbackQueue(&ros->queue);
  for (const Subscription& subscription : subscriptions_) {
    const Take take = subscription.take;
    const boost::function<void(const topic_tools::ShapeShifter::ConstPtr&)> call =
        [take](const topic_tools::ShapeShifter::ConstPtr& message) {
          std::vector<std::uint8_t> bytes(message->size());
          ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
          message->write(stream);
          take(message->getDataType(), {reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()});
        };
    ros->subscribers.push_back(ros->handle.subscribe<topic_tools::ShapeShifter>(
        subscription.topic, subscription.queue, call, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  }
  for (const Advertised& topic : advertised_) {
    ros::AdvertiseOptions options(topic.topic, kQueueOut, topic.type->md5, topic.type->name, topic.type->definition);
    ros->publishers.push_back(ros->handle.advertise(options));
  }
  ++masters_seen_;
  const std::lock_guard<std::mutex> locked(lock_);
  ros_ = std::move(ros);
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
  if (!ros_) return;
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
