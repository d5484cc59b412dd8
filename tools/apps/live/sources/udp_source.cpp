// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A sensor's packets by UDP as a source: received, put together into turns and handed on, in one thread.

#include <fmt/format.h>

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>

#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "apps/live/sources/sensor_metadata.hpp"
#include "apps/live/sources/sensor_watch.hpp"
#include "apps/live/sources/udp_receiver.hpp"
#include "apps/live/thread_name.hpp"
#include "io/packets/one_sender.hpp"
#include "io/packets/sensors.hpp"

namespace pose_wall::tools::live {
namespace {

// Ten turns of the slowest sensor: what comes after it is another run of the sensor, and half a turn from before the
// silence must not be joined to half of one after it.
constexpr std::int64_t kSilent_ns = 1'000'000'000;
constexpr int kLook_ms = 100;
// A cable is plugged in by hand: who waits a second does not mind.
constexpr std::int64_t kAddressEvery_ns = 1'000'000'000;
// Who sent in this time sends still: half of what makes a sensor silent, so that nobody is named who stopped with it.
constexpr std::int64_t kSends_ns = kSilent_ns / 2;
// So many packets without one of use are no accident.
constexpr std::uint64_t kEnoughPackets = 50;
// A sensor describes itself once to ten times a second; a flood there must not keep its data waiting.
constexpr int kDeviceAtOnce = 16;

std::string ipv4_text(std::uint32_t address) {
  Sender from;
  from.address = address;
  return identity_of_sender(from).address;
}

class UdpSource final : public Source {
 public:
  explicit UdpSource(const LoadedConfig& loaded)
      : live_(loaded.live), metadata_(live_.sensor, live_.sensor_metadata), sender_(parse_ipv4(live_.udp_sender)) {}
  ~UdpSource() override { stop(); }

  void start(FrameTaker& taker) override {
    const auto port = static_cast<std::uint16_t>(live_.udp_port);
    receiver_ =
        std::make_unique<UdpReceiver>(parse_ipv4(live_.udp_address).value(), port != 0 ? port : metadata_.usual_port());
    const auto device_port =
        live_.udp_device_port != 0 ? static_cast<std::uint16_t>(live_.udp_device_port) : metadata_.usual_device_port();
    if (device_port != 0 && device_port != receiver_->port()) {
      device_ = std::make_unique<UdpReceiver>(parse_ipv4(live_.udp_address).value(), device_port);
    }
    set_part(fmt::format("source udp {}:{}", live_.udp_address, receiver_->port()));
    log_line(Grade::kGood, part(), "listens; whoever reaches this address can send packets, others are dropped");
    if (receiver_->buffer_bytes() < UdpReceiver::kBufferWished) {
      log_line(Grade::kWarning, part(),
               fmt::format("the kernel grants a receive buffer of {} bytes, {} were wished: packets will be lost while "
                           "the machine is busy. Remedy: sysctl -w net.core.rmem_max={}",
                           receiver_->buffer_bytes(), UdpReceiver::kBufferWished, UdpReceiver::kBufferWished));
    }
    ending_ = false;
    began_ns_ = monotonic_ns();
    look_for_address();
    thread_ = std::thread([this, &taker] { run(taker); });
  }

  void stop() override {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
    metadata_.stop();
  }

  PartHealth health() const override {
    PartHealth health;
    health.part = part();
    const bool silent = is_silent();
    health.grade = silent || frames_ == 0 ? Grade::kBad : Grade::kGood;
    const std::string trouble = metadata_.trouble(), contradicted = contradiction();
    if (!trouble.empty() || !contradicted.empty()) {
      health.grade = Grade::kBad;
      health.summary = !trouble.empty() ? trouble : contradicted;
    } else if (silent && !has_address_) {
      health.summary = fmt::format(
          "no interface of this machine has udp_address {}; waits for it. Is the sensor's cable in, and its interface "
          "set up?",
          live_.udp_address);
    } else if (packets_ == 0) {
      const std::string sending = other_sending();
      health.summary = of_others_ == 0   ? "waits for the sensor: no packet yet"
                       : sending.empty() ? "packets came, but none from udp_sender " + live_.udp_sender
                                         : fmt::format("packets come from {}, but none from udp_sender {}", sending,
                                                       live_.udp_sender);
    } else if (packets_ == useless_ && packets_ > kEnoughPackets) {
      health.summary = fmt::format("packets come, none is of sensor '{}'{}", live_.sensor,
                                   live_.sensor_metadata.empty() && live_.sensor == "auto"
                                       ? "; an Ouster tells nothing of itself: it needs sensor_metadata"
                                       : ": is another one there?");
    } else {
      tell_of_sensor(silent, &health);
    }
    health.add("frames", frames_.load());
    health.add("packets", packets_.load());
    health.add("packets of no use", useless_.load());
    health.add("packets of others", of_others_.load());
    if (const std::string counts = others_counted(); !counts.empty()) health.add("sources", counts);
    health.add("packets lost by the kernel", lost_.load());
    if (device_) health.add("packets of the device port", device_packets_.load());
    health.add("silences", silences_.load());
    watch_.tell(silent, &health);
    return health;
  }

 private:
  void tell_of_sensor(bool is_silent, PartHealth* health) const {
    const std::string others = others_note(), sending = other_sending();
    if (is_silent && !sending.empty() && read_address_ != 0) {
      health->summary =
          fmt::format("the sensor is silent; waits for {}; {} is sending, and is not read: udp_sender chooses",
                      ipv4_text(read_address_), sending);
      return;
    }
    health->summary = is_silent        ? "the sensor is silent"
                      : frames_ == 0   ? "packets come, no turn yet"
                      : others.empty() ? "receives"
                                       : "receives; " + others;
    // Nobody said which of them stands on the machine.
    if (!others.empty() && !sender_ && health->grade == Grade::kGood) health->grade = Grade::kWarning;
  }

  std::string part() const {
    const std::lock_guard<std::mutex> locked(words_lock_);
    return part_;
  }
  void set_part(const std::string& part) {
    const std::lock_guard<std::mutex> locked(words_lock_);
    part_ = part;
  }
  // Of the last second: what was odd before is over.
  std::string contradiction() const {
    const std::lock_guard<std::mutex> locked(words_lock_);
    return monotonic_ns() - contradicted_ns_ < kSilent_ns ? contradiction_ : "";
  }
  void say(const std::string& contradiction) {
    if (contradiction.empty()) return;
    const std::lock_guard<std::mutex> locked(words_lock_);
    contradiction_ = contradiction;
    contradicted_ns_ = monotonic_ns();
  }

  std::string others_note() const {
    const std::lock_guard<std::mutex> locked(words_lock_);
    return others_note_;
  }
  std::string others_counted() const {
    const std::lock_guard<std::mutex> locked(words_lock_);
    return others_counted_;
  }

  void run(FrameTaker& taker) {
    name_this_thread("source-udp");
    while (!ending_) {
      const std::optional<Datagram> datagram = receiver_->next(kLook_ms);
      lost_ = receiver_->lost();
      hear_device();
      if (is_silent() && monotonic_ns() - looked_ns_ > kAddressEvery_ns) look_for_address();
      if (!datagram) continue;
      if ((is_silent() || keeps_out()) && monotonic_ns() - began_ns_ > kSilent_ns) begin_anew();
      if (!is_of_other(*datagram)) hear(*datagram, taker);
    }
  }

  // Only what is of use counts as the sensor: anybody may send anything.
  void hear(const Datagram& datagram, FrameTaker& taker) {
    const std::uint64_t refused = assembler_ ? assembler_->senders().refused() : 0;
    const bool is_data = add(datagram);
    const bool are_others = assembler_ && assembler_->senders().refused() > refused;
    if (are_others) name_others();
    if (are_others && !is_data) {
      are_two_ = true;
      note_other(datagram);
      return;
    }
    ++packets_;
    if (!is_data) {
      ++useless_;
      return;
    }
    last_packet_ns_ = monotonic_ns();
    read_address_ = datagram.from.address;
    // Until one of several is chosen, nobody knows whose packet this is.
    if (assembler_->senders().chosen()) watch_.hear(datagram, [this] { return metadata_.of_ouster(); });
    ++packets_of_use_;
    if (assembler_->senders().chosen() && assembler_->senders().refused() > 0) are_two_ = true;
    while (std::optional<Scan> scan = assembler_->take()) hand_on(*scan, taker);
  }

  // What the sensor says of itself by its other port.
  void hear_device() {
    for (int i = 0; device_ && i < kDeviceAtOnce; ++i) {
      const std::optional<Datagram> datagram = device_->next(0);
      if (!datagram) return;
      if (is_of_other(*datagram)) continue;
      ++device_packets_;
      add(*datagram);
    }
  }

  void look_for_address() {
    looked_ns_ = monotonic_ns();
    has_address_ = receiver_->has_address();
  }

  // Packets that contradict the sensor that was chosen say so in the health, and are of no use.
  bool add(const Datagram& datagram) {
    try {
      if (!assembler_) assembler_ = std::make_unique<OneSender>([this] { return metadata_.assembler(); }, wanted_);
      if (assembler_->add(datagram)) return true;
      say(assembler_->hint());
      return false;
    } catch (const FrameError& fault) {
      say(fault.what());
      return false;
    }
  }

  bool is_of_other(const Datagram& datagram) {
    const bool is_other = sender_ && *sender_ != datagram.from.address;
    if (is_other) note_other(datagram);
    return is_other;
  }

  void note_other(const Datagram& datagram) {
    ++of_others_;
    other_address_ = datagram.from.address;
    other_ns_ = monotonic_ns();
  }
  // Who sends just now and is not read; "": nobody.
  std::string other_sending() const {
    return of_others_ > 0 && monotonic_ns() - other_ns_ < kSends_ns ? ipv4_text(other_address_) : "";
  }

  // Another sensor sends to this port, too.
  void name_others() {
    const SourceGate& senders = assembler_->senders();
    const std::string note = senders.note("", "", "udp_sender"), counted = senders.note("", "packet", "udp_sender");
    const std::lock_guard<std::mutex> locked(words_lock_);
    others_note_ = note;
    others_counted_ = counted;
  }

  bool is_silent() const { return monotonic_ns() - last_packet_ns_ > kSilent_ns; }

  // Whoever is read gives no whole turn, and keeps another one out: anybody may send a packet now and then, or a stub.
  bool keeps_out() const { return are_two_ && monotonic_ns() - whole_turn_ns_ > kSilent_ns; }

  // For a second nothing of use came, or no turn. What comes now may be of another run of the sensor, of another
  // sensor, or of one that was set up anew: then what was learned of it is wrong.
  void begin_anew() {
    const bool has_turned = whole_turn_ns_ > began_ns_;
    began_ns_ = monotonic_ns();
    if (packets_of_use_ > 0) ++silences_;
    packets_of_use_ = 0;
    // Where two sensors sent at once, the other one must not take the place of the one that was read.
    if (has_turned && are_two_ && assembler_ && assembler_->senders().chosen()) {
      wanted_ = assembler_->senders().chosen()->address;
    }
    are_two_ = false;
    assembler_.reset();
    watch_.begin_anew();
    started_ns_.reset();
    metadata_.ask_again();
    is_first_turn_ = true;
    const std::lock_guard<std::mutex> locked(words_lock_);
    others_note_.clear();
    others_counted_.clear();
  }

  // Kept, so that steps stay the sensor's; taken anew where somebody set this machine's clock.
  std::int64_t start_of_clock_ns() {
    const std::int64_t now_ns = watch_.started_ns().value_or(started_ns_.value_or(0));
    if (!started_ns_ || std::abs(now_ns - *started_ns_) > kSilent_ns) started_ns_ = now_ns;
    return *started_ns_;
  }

  // The first turn began before it was listened to.
  void hand_on(const Scan& scan, FrameTaker& taker) {
    if (scan.is_complete) whole_turn_ns_ = monotonic_ns();
    if (std::exchange(is_first_turn_, false) && !scan.is_complete) return;
    LiveFrame frame;
    frame.frame = frame_of(scan);
    frame.stamp_ns = scan.stamp_ns;
    frame.frame.cloud.stamp_ns = scan.stamp_ns;
    // Times of arrival are of the clock that nobody sets, for ages go by it; headers are of the one that people set.
    // A sensor's clock that was never set counts from its start: headers from 1970 fit nothing, and go back at each
    // start.
    if (assembler_->stamps_are_of_arrival()) {
      frame.stamp_ns += wall_ns() - monotonic_ns();
    } else if (scan.stamp_ns < kFirstDate_ns) {
      frame.stamp_ns += start_of_clock_ns();
    }
    ++frames_;
    taker.take(std::move(frame));
  }

  LiveSettings live_;
  SensorMetadata metadata_;
  std::unique_ptr<UdpReceiver> receiver_;
  std::unique_ptr<UdpReceiver> device_;  // of sensors that describe themselves by a port of its own
  std::unique_ptr<OneSender> assembler_;
  SensorWatch watch_;
  std::optional<std::int64_t> started_ns_;  // of the sensor's clock
  bool are_two_ = false;                    // another one was heard between packets of the one that is read
  std::string wanted_;                      // of two that were heard the one that was read; "": any
  std::optional<std::uint32_t> sender_;     // as the settings name it
  bool is_first_turn_ = true;
  std::uint64_t packets_of_use_ = 0;  // since it began anew
  std::int64_t whole_turn_ns_ = 0;    // when the last one came
  std::thread thread_;
  mutable std::mutex words_lock_;
  std::string part_ = "source udp", contradiction_, others_note_, others_counted_;
  std::int64_t contradicted_ns_ = -kSilent_ns, looked_ns_ = 0, began_ns_ = 0;
  std::atomic<bool> ending_{false}, has_address_{true};
  std::atomic<std::uint64_t> frames_{0}, packets_{0}, useless_{0}, of_others_{0}, silences_{0}, device_packets_{0};
  std::atomic<std::uint32_t> lost_{0};
  std::atomic<std::int64_t> last_packet_ns_{0}, other_ns_{0};
  std::atomic<std::uint32_t> read_address_{0}, other_address_{0};
};

}  // namespace

std::unique_ptr<Source> make_udp_source(const LoadedConfig& loaded) {
  return std::make_unique<UdpSource>(loaded);
}

}  // namespace pose_wall::tools::live
