// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The clouds that one sensor sent on one topic of a bag, one frame per message. A bag may be split into several files.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/bags/bag_reader.hpp"
#include "io/bags/open_bag.hpp"
#include "io/bags/scan_overlap.hpp"
#include "io/frames/frame_source.hpp"
#include "io/frames/source_identity.hpp"

namespace pose_wall::tools {

// What the files of a bag hold; goes through them once.
class Bag {
 public:
  // `source` names the one that is read where a topic has several; empty: the first. Throws FrameError or
  // std::runtime_error for a file that cannot be opened, with its name.
  explicit Bag(const std::vector<std::filesystem::path>& files, std::string source = "");

  struct File {
    std::filesystem::path path;
    std::unique_ptr<BagReader> reader;
  };

  // Several connections of one name are one topic.
  const std::vector<SourceTopic>& topics() const { return topics_; }
  std::size_t faults() const { return faults_; }
  std::vector<File>& files() { return files_; }
  BagKind kind() const { return kind_; }

  // The topic to read: `wanted`, or the only one with clouds when that is empty, or with packets when there are no
  // clouds. Throws std::invalid_argument when the command line has to say more, FrameError when the bag holds neither.
  std::string choose_topic(const std::string& wanted) const;

  // Of those the one with the most messages; throws FrameError when the bag holds neither.
  std::string fullest_topic() const;

  // Frames have to be put together of what this topic holds.
  bool has_packets(const std::string& name) const;

  // Those who sent the clouds of this topic, the one that is read among them.
  const SourceGate& sources(const std::string& topic) const;

  // Which of them is read, where there are several; else empty. Throws std::invalid_argument when `source` means none
  // of them, and FrameError when its clouds are of several sensors that nothing tells apart.
  std::string choose_source(const std::string& topic) const;

  SourceAbout about(const std::string& topic) const;

 private:
  std::vector<SourceTopic> frame_topics() const;
  std::vector<SourceTopic> preferred_topics() const;  // where none is named
  void add(const std::filesystem::path& path);
  void hear(const BagTopic& topic, const BagMessage& message);

  std::vector<File> files_;
  std::vector<SourceTopic> topics_;
  std::string source_;
  std::map<std::string, SourceGate> sources_;    // of topics with clouds
  std::map<std::string, ScanOverlap> overlaps_;  // of the source that is read
  std::size_t faults_ = 0;
  BagKind kind_ = BagKind::kRos1;
};

class BagSource : public FrameSource {
 public:
  // `topic` is one of clouds that the bag holds.
  BagSource(std::unique_ptr<Bag> bag, std::string topic);

  std::optional<SourcedFrame> next() override;
  std::size_t frames() const override { return frames_; }
  SourceAbout about() const override { return bag_->about(topic_); }

 private:
  SourcedFrame frame_of(const Bag::File& file, const BagMessage& message);
  bool is_of_another(const BagTopic& topic, const BagMessage& message) const;

  std::unique_ptr<Bag> bag_;
  std::string topic_;
  std::size_t frames_ = 0;
  std::size_t file_ = 0;
  std::uint64_t next_message_ = 0;
};

}  // namespace pose_wall::tools
