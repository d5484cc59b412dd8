// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/packet_source.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "packets/ouster.hpp"
#include "packets/udp_capture.hpp"
#include "packets/velodyne.hpp"

namespace pose_wall::tools {
namespace {

using namespace std::string_view_literals;

constexpr std::array<std::string_view, 5> kMagics = {"\xD4\xC3\xB2\xA1"sv, "\xA1\xB2\xC3\xD4"sv, "\x4D\x3C\xB2\xA1"sv,
                                                     "\xA1\xB2\x3C\x4D"sv, "\x0A\x0D\x0D\x0A"sv};

// Scans of a capture one by one, the incomplete ones at its ends left out.
class ScanWalk {
 public:
  ScanWalk(const std::string& path, std::unique_ptr<ScanAssembler> assembler)
      : capture_(open_udp_capture(path)), assembler_(std::move(assembler)) {}

  // Throws FrameError once when the capture is cut; then goes on with what was gathered.
  std::optional<Scan> next() {
    while (true) {
      if (!ahead_) ahead_ = whole_capture_next();
      if (!ahead_) return std::nullopt;
      Scan scan = std::move(*ahead_);
      ahead_ = whole_capture_next();
      const bool at_an_end = given_ == 0 || !ahead_;
      const bool is_only = given_ == 0 && !ahead_;
      if (scan.is_complete || !at_an_end || is_only) {
        ++given_;
        return scan;
      }
    }
  }

  const ScanAssembler& assembler() const { return *assembler_; }
  std::optional<std::string> take_fault() { return std::exchange(fault_, std::nullopt); }

 private:
  std::optional<Scan> whole_capture_next() {
    while (true) {
      if (std::optional<Scan> scan = assembler_->take()) return scan;
      if (ended_) return std::nullopt;
      std::optional<Datagram> datagram;
      try {
        datagram = capture_->next();
      } catch (const FrameError& fault) {
        fault_ = fault.what();
      }
      if (datagram) {
        assembler_->add(*datagram);
      } else {
        assembler_->finish();
        ended_ = true;
      }
    }
  }

  std::unique_ptr<UdpCapture> capture_;
  std::unique_ptr<ScanAssembler> assembler_;
  std::optional<Scan> ahead_;
  std::optional<std::string> fault_;
  std::size_t given_ = 0;
  bool ended_ = false;
};

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FrameError(fmt::format("{}: cannot be opened for reading: {}", path.string(), std::strerror(errno)));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::unique_ptr<ScanAssembler> assembler_for(const std::filesystem::path& file, const std::string& metadata) {
  std::filesystem::path beside = file;
  beside.replace_extension(".json");
  std::error_code ignored;
  if (metadata.empty() && !std::filesystem::exists(beside, ignored)) return std::make_unique<VelodyneAssembler>();
  const std::filesystem::path described = metadata.empty() ? beside : std::filesystem::path(metadata);
  try {
    return std::make_unique<OusterAssembler>(parse_ouster_metadata(text_of_file(described)));
  } catch (const FrameError& fault) {
    throw FrameError(fmt::format("metadata {}: {}", described.string(), fault.what()));
  }
}

class PacketSource : public FrameSource {
 public:
  PacketSource(const std::filesystem::path& file, const std::string& metadata)
      : path_(file.string()), walk_(std::make_unique<ScanWalk>(path_, assembler_for(file, metadata))) {
    ScanWalk survey(path_, assembler_for(file, metadata));
    while (survey.next()) ++frames_;
    const bool is_cut = survey.take_fault().has_value();
    if (frames_ == 0 && !is_cut) {
      const std::filesystem::path beside = std::filesystem::path(file).replace_extension(".json");
      const bool has_metadata = !metadata.empty() || std::filesystem::exists(beside);
      throw FrameError(fmt::format(
          "the capture holds no data packets of a Velodyne VLP-16 (1206 bytes), nor of an Ouster{}",
          has_metadata
              ? " as its metadata says"
              : ": its metadata would be " + beside.string() + ", which is not there, or what --metadata names"));
    }
    if (is_cut) ++frames_;
  }

  std::optional<SourcedFrame> next() override {
    SourcedFrame sourced;
    sourced.name = fmt::format("{}#{}", path_, next_);
    if (const std::optional<Scan> scan = walk_->next()) {
      ++next_;
      sourced.stamp_ns = scan->stamp_ns;
      sourced.frame = frame_of(*scan);
      return sourced;
    }
    const std::optional<std::string> fault = walk_->take_fault();
    if (!fault) return std::nullopt;
    sourced.name = path_;
    sourced.error = *fault;
    return sourced;
  }

  std::size_t frames() const override { return frames_; }
  SourceAbout about() const override { return {walk_->assembler().kind(), {}, ""}; }

 private:
  std::string path_;
  std::unique_ptr<ScanWalk> walk_;
  std::size_t frames_ = 0;
  std::size_t next_ = 0;
};

}  // namespace

bool is_packet_capture(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 4> beginning{};
  stream.read(beginning.data(), beginning.size());
  const std::string_view found(beginning.data(), static_cast<std::size_t>(stream.gcount()));
  for (const std::string_view magic : kMagics) {
    if (found == magic) return true;
  }
  return file.extension() == ".pcap" || file.extension() == ".pcapng";
}

std::unique_ptr<FrameSource> open_packet_capture(const std::filesystem::path& file, const std::string& metadata) {
  return std::make_unique<PacketSource>(file, metadata);
}

}  // namespace pose_wall::tools
