// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A peer of pose_walld's ROS 2 edge by Fast DDS, which shares no code with it. It publishes clouds of a road and
// transforms, and reads the results. Standard output has one line of JSON for all it sees. Commands come on standard
// input.
//
// usage: pose_wall_ros2_peer DOMAIN [WORD=VALUE]...
//   points=N hz=H count=N   clouds, once both sides found each other; count=0: until the end
//   reliability=best_effort|reliable, type=..., topic=...   of the clouds
//   results=1               reads what pose_walld publishes; durability=transient_local|volatile asks so of attitudes
//   labelled=1              reads the labelled points
//   planar=1                with results=1: reads scan, map, place and stop
//   twist=TOPIC             the commands drive and turn publish there; stamped=1: as TwistStamped
//   static_latched=0        /tf_static as no broadcaster of ROS sends it
//   range=loopback          talks on 127.0.0.1 alone (default)
//   range=localhost         as rmw_fastrtps does from Iron on, for ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST
// commands: static Y | moving Y (transform base_link -> lidar, by /tf_static or /tf), drive SPEED | aside SPEED
// (commands of a drive, the second one of none), junk (what is no cloud), report, quit

#include <fastcdr/Cdr.h>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>

#include "raw_topic.hpp"

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using pose_wall::test::RawMessage;
using pose_wall::test::RawType;

namespace {

// Twice the largest cloud of the tests, 4 MB: Fast DDS wants to know it of a type.
constexpr std::uint32_t kBytesMost = 8'000'000;

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

std::string hex(const void* bytes, std::size_t size) {
  std::string text;
  char two[3];
  for (std::size_t i = 0; i < size; ++i) {
    std::snprintf(two, sizeof two, "%02x", static_cast<const unsigned char*>(bytes)[i]);
    text += two;
  }
  return text;
}

std::mutex say_lock;
void say(const std::string& line) {
  const std::lock_guard<std::mutex> locked(say_lock);
  std::cout << line << std::endl;
}

class Words {
 public:
  Words(int argc, char** argv) {
    for (int i = 2; i < argc; ++i) {
      const std::string word = argv[i];
      values_[word.substr(0, word.find('='))] = word.substr(word.find('=') + 1);
    }
  }
  std::string text(const std::string& name, const std::string& otherwise) const {
    const auto found = values_.find(name);
    return found == values_.end() ? otherwise : found->second;
  }
  int number(const std::string& name, int otherwise) const { return std::stoi(text(name, std::to_string(otherwise))); }

 private:
  std::map<std::string, std::string> values_;
};

// What discovery tells of others.
class Discoveries final : public fast::DomainParticipantListener {
 public:
  void on_participant_discovery(fast::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& info) override {
    const auto& data = info.info.m_userData;
    say("{\"saw\": \"participant\", \"alive\": " +
        std::string(info.status == rtps::ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT ? "true" : "false") +
        ", \"user_data\": \"" + std::string(data.begin(), data.end()) + "\"}");
  }
  void on_publisher_discovery(fast::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) override {
    const auto& data = info.info.m_qos.m_userData;
    if (info.status != rtps::WriterDiscoveryInfo::DISCOVERED_WRITER) return;
    say("{\"saw\": \"writer\", \"topic\": \"" + info.info.topicName().to_string() + "\", \"type\": \"" +
        info.info.typeName().to_string() + "\", \"user_data\": \"" + std::string(data.begin(), data.end()) + "\"}");
  }
  void on_subscriber_discovery(fast::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) override {
    const auto& data = info.info.m_qos.m_userData;
    if (info.status != rtps::ReaderDiscoveryInfo::DISCOVERED_READER) return;
    say("{\"saw\": \"reader\", \"topic\": \"" + info.info.topicName().to_string() + "\", \"type\": \"" +
        info.info.typeName().to_string() + "\", \"user_data\": \"" + std::string(data.begin(), data.end()) + "\"}");
  }
};

class Node {
 public:
  Node(int domain, const std::string& range) {
    fast::DomainParticipantQos qos;
    const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    if (range == "localhost") {
      auto& builtin = qos.wire_protocol().builtin;
      builtin.metatrafficMulticastLocatorList.clear();
      builtin.metatrafficUnicastLocatorList.push_back(rtps::Locator_t());
      rtps::Locator_t localhost;
      rtps::IPLocator::setIPv4(localhost, "127.0.0.1");
      builtin.initialPeersList.push_back(localhost);
      udp->maxInitialPeersRange = 32;
    } else {
      udp->interfaceWhiteList.push_back("127.0.0.1");
    }
    udp->sendBufferSize = udp->receiveBufferSize = 4'194'304;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    const std::string enclave = "enclave=/;";
    qos.user_data().setValue({enclave.begin(), enclave.end()});
    participant_ = fast::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(domain), qos, &discoveries_, fast::StatusMask::none());
    if (participant_ == nullptr) throw std::runtime_error("no participant");
    publisher_ = participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  }
  ~Node() {
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  fast::DataWriter* writer(const std::string& topic, const std::string& type, bool reliable, bool latched) {
    fast::DataWriterQos qos;
    qos.reliability().kind = reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = latched ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
    qos.history().depth = 5;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.publish_mode().kind = fast::ASYNCHRONOUS_PUBLISH_MODE;
    return publisher_->create_datawriter(make_topic(topic, type), qos);
  }
  fast::DataReader* reader(const std::string& topic, const std::string& type, bool reliable, bool latched,
                           fast::DataReaderListener* listener) {
    fast::DataReaderQos qos;
    qos.reliability().kind = reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = latched ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
    qos.history().depth = 10;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return subscriber_->create_datareader(make_topic(topic, type), qos, listener);
  }

 private:
  // One object for a topic that is both written and read.
  fast::Topic* make_topic(const std::string& name, const std::string& type) {
    fast::Topic*& topic = topics_[name];
    if (topic == nullptr) {
      fast::TypeSupport support(new RawType(type, kBytesMost));
      support.register_type(participant_);
      topic = participant_->create_topic(name, type, fast::TOPIC_QOS_DEFAULT);
    }
    return topic;
  }

  std::map<std::string, fast::Topic*> topics_;
  Discoveries discoveries_;
  fast::DomainParticipant* participant_ = nullptr;
  fast::Publisher* publisher_ = nullptr;
  fast::Subscriber* subscriber_ = nullptr;
};

class Taking final : public fast::DataReaderListener {
 public:
  explicit Taking(std::function<void(const RawMessage&)> take) : take_(std::move(take)) {}
  void on_data_available(fast::DataReader* reader) override {
    RawMessage message;
    fast::SampleInfo info;
    while (reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) take_(message);
    }
  }
  void on_subscription_matched(fast::DataReader*, const fast::SubscriptionMatchedStatus& status) override {
    matched = status.current_count;
  }
  void on_requested_incompatible_qos(fast::DataReader* reader, const fast::RequestedIncompatibleQosStatus&) override {
    say("{\"saw\": \"incompatible\", \"topic\": \"" + reader->get_topicdescription()->get_name() + "\"}");
  }

  std::atomic<int> matched{0};

 private:
  std::function<void(const RawMessage&)> take_;
};

// A message that Fast CDR writes or reads.
class Message {
 public:
  Message()
      : bytes_(kBytesMost), buffer_(bytes_.data(), bytes_.size()), cdr(buffer_, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR) {
    cdr.serialize_encapsulation();
  }
  explicit Message(const RawMessage& of)
      : bytes_(of), buffer_(bytes_.data(), bytes_.size()), cdr(buffer_, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR) {
    cdr.read_encapsulation();
  }
  RawMessage written() { return {bytes_.data(), bytes_.data() + cdr.getSerializedDataLength()}; }
  void header(std::int64_t stamp_ns, const std::string& frame) {
    cdr << static_cast<std::int32_t>(stamp_ns / 1'000'000'000) << static_cast<std::uint32_t>(stamp_ns % 1'000'000'000)
        << frame;
  }
  std::int64_t read_header(std::string* frame) {
    std::int32_t seconds = 0;
    std::uint32_t nanoseconds = 0;
    cdr >> seconds >> nanoseconds >> *frame;
    return std::int64_t{seconds} * 1'000'000'000 + nanoseconds;
  }

 private:
  RawMessage bytes_;
  FastBuffer buffer_;

 public:
  Cdr cdr;
};

// A road 5 m wide and 3.2 m high from 1.2 m above its floor; x, y, z and intensity. No cloud is one that was before.
std::vector<float> road_points(std::uint32_t count, std::uint32_t turn) {
  std::vector<float> points(4 * std::size_t{count});
  std::uint32_t seed = turn * 2654435761U + 1;
  const std::uint32_t columns = std::max(count / 64, 1U);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double e = (-45.0 + 90.0 * (i / columns % 64) / 63.0) * M_PI / 180.0,
                 a = 2.0 * M_PI * (i % columns) / columns;
    const double x = std::cos(e) * std::cos(a), y = std::cos(e) * std::sin(a), z = std::sin(e);
    seed = seed * 1664525U + 1013904223U;
    const double range = std::min(2.5 / std::max(std::abs(y), 1e-9), z > 0   ? 2.0 / z
                                                                     : z < 0 ? 1.2 / -z
                                                                             : 1e9) +
                         0.005 * (static_cast<double>(seed >> 8U) / 16777216.0 - 0.5);
    if (range > 25.0) continue;  // no return
    points[4 * i] = static_cast<float>(range * x);
    points[4 * i + 1] = static_cast<float>(range * y);
    points[4 * i + 2] = static_cast<float>(range * z);
    points[4 * i + 3] = 9.0F;
  }
  return points;
}

RawMessage road(std::uint32_t count, std::int64_t stamp_ns, std::uint32_t turn) {
  const std::vector<float> points = road_points(count, turn);
  Message message;
  message.header(stamp_ns, "lidar");
  message.cdr << std::uint32_t{1} << count << std::uint32_t{4};
  std::uint32_t offset = 0;
  for (const char* name : {"x", "y", "z", "intensity"}) {
    message.cdr << std::string(name) << offset << std::uint8_t{7} << std::uint32_t{1};
    offset += 4;
  }
  message.cdr << false << std::uint32_t{16} << 16 * count << 16 * count;
  message.cdr.serializeArray(reinterpret_cast<const std::uint8_t*>(points.data()), 4 * points.size());
  message.cdr << false;
  return message.written();
}

// The same as livox_ros_driver2/CustomMsg.
RawMessage road_of_livox(std::uint32_t count, std::int64_t stamp_ns, std::uint32_t turn) {
  const std::vector<float> points = road_points(count, turn);
  Message message;
  message.header(stamp_ns, "lidar");
  message.cdr << static_cast<std::uint64_t>(stamp_ns) << count << std::uint8_t{1};
  for (int i = 0; i < 3; ++i) message.cdr << std::uint8_t{0};
  message.cdr << count;
  for (std::size_t i = 0; i < count; ++i) {
    message.cdr << static_cast<std::uint32_t>(i) << points[4 * i] << points[4 * i + 1] << points[4 * i + 2];
    for (int k = 0; k < 3; ++k) message.cdr << std::uint8_t{0};
  }
  return message.written();
}

RawMessage transform(double y_m) {
  Message message;
  message.cdr << std::uint32_t{1};
  message.header(now_ns(), "base_link");
  message.cdr << std::string("lidar") << 0.0 << y_m << 0.0 << 0.0 << 0.0 << 0.0 << 1.0;
  return message.written();
}

RawMessage twist(double ahead_m_s, double aside_m_s, bool is_stamped) {
  Message message;
  if (is_stamped) message.header(now_ns(), "base_link");
  message.cdr << ahead_m_s << aside_m_s << 0.0 << 0.0 << 0.0 << -0.1;
  return message.written();
}

// Counts of the results and how old the attitudes were when they came.
class Results {
 public:
  void attitude(const RawMessage& bytes) {
    const std::int64_t at_ns = now_ns();
    Message message(bytes);
    std::string frame;
    const std::int64_t stamp_ns = message.read_header(&frame);
    double angles[3];
    for (double& angle : angles) message.cdr >> angle;
    const std::lock_guard<std::mutex> locked(lock_);
    if (stamp_ns == last_stamp_ns_) return;  // of silence
    last_stamp_ns_ = stamp_ns;
    ages_ms_.push_back(static_cast<double>(at_ns - stamp_ns) * 1e-6);
    frame_ = frame;
    roll_rad_ = angles[0];
    valid_ += std::isfinite(angles[0]) ? 1 : 0;
  }
  void distances(const RawMessage& bytes) {
    Message message(bytes);
    std::uint32_t dimensions = 0, size = 0, stride = 0, offset = 0, count = 0;
    std::string label;
    message.cdr >> dimensions >> label >> size >> stride >> offset >> count;
    const std::lock_guard<std::mutex> locked(lock_);
    label_ = label;
    left_m_ = std::nanf("");
    if (count == 4) message.cdr >> left_m_;
  }
  void other(const std::string& topic, const RawMessage& bytes) {
    const std::lock_guard<std::mutex> locked(lock_);
    ++others_[topic];
    bytes_[topic] = bytes.size();
  }
  void clear() {
    const std::lock_guard<std::mutex> locked(lock_);
    ages_ms_.clear();
    valid_ = 0;
  }
  void report(int sent, int cloud_matched) {
    const std::lock_guard<std::mutex> locked(lock_);
    std::vector<double> sorted = ages_ms_;
    std::sort(sorted.begin(), sorted.end());
    std::ostringstream line;
    line << "{\"saw\": \"report\", \"sent\": " << sent << ", \"attitudes\": " << sorted.size()
         << ", \"valid\": " << valid_ << ", \"median_ms\": " << (sorted.empty() ? 0.0 : sorted[sorted.size() / 2])
         << ", \"worst_ms\": " << (sorted.empty() ? 0.0 : sorted.back()) << ", \"frame\": \"" << frame_
         << "\", \"label\": \"" << label_ << "\", \"roll_rad\": " << number(roll_rad_)
         << ", \"left_m\": " << number(static_cast<double>(left_m_)) << ", \"matched\": " << cloud_matched;
    for (const auto& [topic, count] : others_) line << ", \"" << topic << "\": " << count;
    say(line.str() + "}");
  }

 private:
  static std::string number(double value) { return std::isfinite(value) ? std::to_string(value) : "null"; }

  std::mutex lock_;
  std::vector<double> ages_ms_;
  std::int64_t last_stamp_ns_ = 0;
  int valid_ = 0;
  std::string frame_, label_;
  double roll_rad_ = std::nan("");
  float left_m_ = std::nanf("");
  std::map<std::string, int> others_;
  std::map<std::string, std::size_t> bytes_;
};

class Peer {
 public:
  Peer(int domain, const Words& words)
      : words_(words),
        is_stamped_(words.number("stamped", 0) != 0),
        attitude_([this](const RawMessage& bytes) { results_.attitude(bytes); }),
        distances_([this](const RawMessage& bytes) { results_.distances(bytes); }),
        graph_([](const RawMessage& bytes) {
          say("{\"saw\": \"graph\", \"hex\": \"" + hex(bytes.data(), bytes.size()) + "\"}");
        }),
        node_(domain, words.text("range", "loopback")) {
    for (const char* topic : {"state", "diagnostics", "tf", "points"}) {
      others_.emplace_back(
          std::make_unique<Taking>([this, topic](const RawMessage& bytes) { results_.other(topic, bytes); }));
    }
    node_.reader("ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", true, true, &graph_);
    static_ =
        node_.writer("rt/tf_static", "tf2_msgs::msg::dds_::TFMessage_", true, words.number("static_latched", 1) != 0);
    moving_ = node_.writer("rt/tf", "tf2_msgs::msg::dds_::TFMessage_", true, false);
    if (const std::string topic = words.text("twist", ""); !topic.empty()) {
      twists_ = node_.writer(
          topic, is_stamped_ ? "geometry_msgs::msg::dds_::TwistStamped_" : "geometry_msgs::msg::dds_::Twist_", true,
          false);
    }
    if (words.number("results", 0) != 0) read_results();
    if (words.number("points", 0) > 0) {
      clouds_ = node_.writer(words.text("topic", "rt/lidar/points"),
                             words.text("type", "sensor_msgs::msg::dds_::PointCloud2_"),
                             words.text("reliability", "best_effort") == "reliable", words.text("latched", "0") == "1");
      publishing_ = std::thread([this] { publish(); });
    }
  }
  ~Peer() {
    ending_ = true;
    if (publishing_.joinable()) publishing_.join();
  }

  void obey() {
    for (std::string line; std::getline(std::cin, line);) {
      std::istringstream words(line);
      std::string command;
      double y_m = 0.0;
      words >> command >> y_m;
      if (command == "quit") return;
      if (command == "report") results_.report(sent_, matched());
      RawMessage message = transform(y_m);
      if (command == "static") static_->write(&message);
      if (command == "moving") moving_->write(&message);
      if (command == "junk") send_junk();
      message = twist(command == "drive" ? y_m : 0.0, command == "aside" ? y_m : 0.0, is_stamped_);
      if (command == "drive" || command == "aside") twists_->write(&message);
    }
  }

 private:
  void read_results() {
    node_.reader("rt/pose_wall/attitude", "geometry_msgs::msg::dds_::Vector3Stamped_", true,
                 words_.text("durability", "volatile") == "transient_local", &attitude_);
    node_.reader("rt/pose_wall/distances", "std_msgs::msg::dds_::Float32MultiArray_", false, false, &distances_);
    node_.reader("rt/pose_wall/state", "pose_wall_msgs::msg::dds_::State_", true, false, others_[0].get());
    node_.reader("rt/diagnostics", "diagnostic_msgs::msg::dds_::DiagnosticArray_", true, false, others_[1].get());
    node_.reader("rt/tf", "tf2_msgs::msg::dds_::TFMessage_", true, false, others_[2].get());
    if (words_.number("planar", 0) != 0) read_planar();
    if (words_.number("labelled", 0) != 0) {
      node_.reader("rt/pose_wall/points", "sensor_msgs::msg::dds_::PointCloud2_", true, false, others_[3].get());
    }
  }

  // As Nav2 subscribes: the map latched, the scan as a sensor's.
  void read_planar() {
    const std::pair<const char*, const char*> topics[] = {
        {"scan", "sensor_msgs::msg::dds_::LaserScan_"},
        {"pose", "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_"},
        {"pose_wall/stop", "std_msgs::msg::dds_::Bool_"},
        {"pose_wall/stop_state", "pose_wall_msgs::msg::dds_::Stop_"}};
    for (const auto& [topic, type] : topics) {
      const std::string name = topic;
      others_.emplace_back(
          std::make_unique<Taking>([this, name](const RawMessage& bytes) { results_.other(name, bytes); }));
      node_.reader("rt/" + name, type, name != "scan", false, others_.back().get());
    }
    others_.emplace_back(std::make_unique<Taking>([](const RawMessage& bytes) { say_map(bytes); }));
    node_.reader("rt/map", "nav_msgs::msg::dds_::OccupancyGrid_", true, true, others_.back().get());
  }

  static void say_map(const RawMessage& bytes) {
    Message message(bytes);
    std::string frame;
    message.read_header(&frame);
    std::int32_t seconds = 0;
    std::uint32_t nanoseconds = 0, width = 0, height = 0;
    float resolution_m = 0.0F;
    double origin[7];
    std::vector<std::uint8_t> cells;
    message.cdr >> seconds >> nanoseconds >> resolution_m >> width >> height;
    for (double& number : origin) message.cdr >> number;
    message.cdr >> cells;
    const auto things =
        std::count_if(cells.begin(), cells.end(), [](std::uint8_t cell) { return cell >= 65 && cell <= 100; });
    std::ostringstream line;
    line << "{\"saw\": \"map\", \"frame\": \"" << frame << "\", \"width\": " << width << ", \"height\": " << height
         << ", \"cells\": " << cells.size() << ", \"things\": " << things << ", \"resolution_m\": " << resolution_m
         << ", \"w\": " << origin[6] << "}";
    say(line.str());
  }

  int matched() {
    fast::PublicationMatchedStatus status;
    return clouds_ != nullptr && clouds_->get_publication_matched_status(status) == ReturnCode_t::RETCODE_OK
               ? status.current_count
               : 0;
  }

  // Heads without bodies, lengths beyond the end, fields beyond the point, and bytes by chance.
  void send_junk() {
    const RawMessage whole = road(64, now_ns(), 1);
    for (std::size_t length = 4; length < whole.size(); length += 7) {
      RawMessage part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
      clouds_->write(&part);
    }
    std::uint32_t seed = 1;
    for (std::size_t at = 0; at + 4 < 140; ++at) {
      RawMessage changed = whole;
      for (std::size_t i = 0; i < 4; ++i) {
        seed = seed * 1664525U + 1013904223U;
        changed[at + i] = static_cast<char>(at % 2 == 0 ? 0xFFU : seed >> 24U);
      }
      clouds_->write(&changed);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  void publish() {
    const int count = words_.number("count", 0), hz = words_.number("hz", 10);
    const auto points = static_cast<std::uint32_t>(words_.number("points", 0));
    const bool both_ways = words_.number("results", 0) != 0;
    const bool waits = words_.number("wait", 1) != 0;
    while (waits && !ending_ && (matched() == 0 || (both_ways && attitude_.matched == 0))) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    // The other side may know of it a little later.
    if (waits) std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    say("{\"saw\": \"match\"}");
    results_.clear();
    auto due = std::chrono::steady_clock::now();
    std::uint32_t turn = 0;
    const auto make = words_.text("type", "").find("CustomMsg") != std::string::npos ? road_of_livox : road;
    RawMessage cloud = make(points, 0, turn);
    while (!ending_ && (count == 0 || sent_ < count)) {
      due += std::chrono::microseconds(1'000'000 / hz);
      std::this_thread::sleep_until(due);
      const std::int64_t stamp_ns = now_ns();
      const auto seconds = static_cast<std::int32_t>(stamp_ns / 1'000'000'000);
      const auto nanoseconds = static_cast<std::uint32_t>(stamp_ns % 1'000'000'000);
      std::memcpy(cloud.data() + 4, &seconds, 4);
      std::memcpy(cloud.data() + 8, &nanoseconds, 4);
      clouds_->write(&cloud);
      ++sent_;
      cloud = make(points, 0, ++turn);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(800));
    results_.report(sent_, matched());
    say("{\"saw\": \"end\"}");
  }

  const Words& words_;
  const bool is_stamped_;
  Results results_;
  Taking attitude_, distances_, graph_;
  std::vector<std::unique_ptr<Taking>> others_;
  Node node_;  // ends before who listens to it
  fast::DataWriter *static_ = nullptr, *moving_ = nullptr, *clouds_ = nullptr, *twists_ = nullptr;
  std::thread publishing_;
  std::atomic<bool> ending_{false};
  std::atomic<int> sent_{0};
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: pose_wall_ros2_peer DOMAIN [WORD=VALUE]...\n";
    return 2;
  }
  try {
    const Words words(argc, argv);
    Peer peer(std::stoi(argv[1]), words);
    peer.obey();
    return 0;
  } catch (const std::exception& fault) {
    std::cerr << "pose_wall_ros2_peer: " << fault.what() << '\n';
    return 1;
  }
}
