// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The words INPUT... of a command line as one row of frames.

#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/frames/file_source.hpp"
#include "io/frames/frame_source.hpp"
#include "io/packets/sensors.hpp"

namespace pose_wall::tools {

// What the command line says about how inputs are to be read.
struct InputOptions {
  std::string topic;           // of bags; empty: the only one with clouds
  bool fullest_topic = false;  // where `topic` is empty and several topics have clouds: take the one with most messages
  SensorOptions packets;       // of captures and bags of packets
  std::string source;          // the one sender that is read, of bags and captures; empty: the first
  std::string layout;          // of files without a header: one letter per value, "xyzi"; empty: by their values
  std::string unit;            // of coordinates, one of length_unit_names(); empty: m
  bool of_others = false;      // topic and packets may be meant for inputs that are opened elsewhere
};

class FrameSequence {
 public:
  // Opens every input. One that cannot be opened stands in errors(), the others are read. Throws std::invalid_argument
  // when the options do not fit what the inputs hold.
  explicit FrameSequence(const std::vector<std::string>& arguments, const InputOptions& options = {});

  // The next frame of the first input that has one left, with the time it took to load; nothing at the end.
  std::optional<SourcedFrame> next();

  std::size_t frames() const;

  // Of the first input; there is one unless errors() says why not.
  SourceAbout about() const { return sources_.empty() ? SourceAbout{} : sources_.front()->about(); }
  const std::vector<std::string>& errors() const { return errors_; }          // each names the input
  const std::vector<std::string>& notes() const { return notes_; }            // choices made, each names the input
  const std::vector<std::filesystem::path>& files() const { return files_; }  // all that are read

 private:
  void add(const std::string& argument, const InputOptions& options);
  void add_bag(const std::string& argument, const std::vector<std::filesystem::path>& files,
               const InputOptions& options);
  void add_files(const std::string& argument);
  void add_note(const std::string& argument);
  void choose_layouts();
  void expect_use(const InputOptions& options) const;

  std::vector<std::unique_ptr<FrameSource>> sources_;
  std::vector<std::filesystem::path> files_;
  std::vector<std::string> errors_, notes_;
  std::vector<FileSource*> file_sources_;  // of sources_
  FileSource* open_files_ = nullptr;       // the last of sources_, where it takes files that are named one by one
  std::optional<BareLayout> points_;
  double metres_per_unit_ = 1.0;
  std::size_t current_ = 0;
  bool bag_seen_ = false;
  bool packets_seen_ = false;
};

}  // namespace pose_wall::tools
