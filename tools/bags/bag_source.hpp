// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The clouds of one topic of a bag, one frame per message. A bag may be split into several files.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bags/bag_reader.hpp"
#include "bags/open_bag.hpp"
#include "frames/frame_source.hpp"

namespace pose_wall::tools {

// What the files of a bag hold; goes through them once.
class Bag {
 public:
  // Throws FrameError or std::runtime_error for a file that cannot be opened, with its name.
  explicit Bag(const std::vector<std::filesystem::path>& files);

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

  SourceAbout about(const std::string& topic) const;

 private:
  std::vector<SourceTopic> frame_topics() const;
  std::vector<SourceTopic> preferred_topics() const;  // where none is named
  void add(const std::filesystem::path& path);

  std::vector<File> files_;
  std::vector<SourceTopic> topics_;
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

  std::unique_ptr<Bag> bag_;
  std::string topic_;
  std::size_t frames_ = 0;
  std::size_t file_ = 0;
  std::uint64_t next_message_ = 0;
};

}  // namespace pose_wall::tools
