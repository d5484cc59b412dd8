// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/rosbag2_folder.hpp"

#include <fmt/format.h>
#include <yaml.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "io/frames/frame.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr const char* kMetadata = "metadata.yaml";
constexpr const char* kInformation = "rosbag2_bagfile_information";

std::string metadata_of(const std::filesystem::path& folder) {
  std::ifstream file(folder / kMetadata, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct Metadata {
  std::vector<std::string> files;
  std::string compression_mode, compression_format;
};

// Scalars of the document one by one; of the mapping only what follows two keys matters.
class MetadataParser {
 public:
  explicit MetadataParser(const std::string& text) {
    if (yaml_parser_initialize(&parser_) == 0) throw FrameError(tr("metadata.yaml: no memory"));
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  }
  MetadataParser(const MetadataParser&) = delete;
  MetadataParser& operator=(const MetadataParser&) = delete;
  ~MetadataParser() { yaml_parser_delete(&parser_); }

  Metadata parse() {
    Metadata metadata;
    std::string word;
    for (yaml_event_type_t type = next(word); type != YAML_STREAM_END_EVENT; type = next(word)) {
      if (type != YAML_SCALAR_EVENT) continue;
      if (word == "relative_file_paths") {
        if (next(word) != YAML_SEQUENCE_START_EVENT)
          throw FrameError(tr("metadata.yaml: relative_file_paths is no list"));
        while (next(word) == YAML_SCALAR_EVENT) metadata.files.push_back(word);
      } else if (word == "compression_mode") {
        next(metadata.compression_mode);
      } else if (word == "compression_format") {
        next(metadata.compression_format);
      }
    }
    return metadata;
  }

 private:
  yaml_event_type_t next(std::string& word) {
    yaml_event_t event;
    if (yaml_parser_parse(&parser_, &event) == 0) {
      throw FrameError(fmt::format("metadata.yaml:{}: {}", parser_.problem_mark.line + 1,
                                   parser_.problem != nullptr ? parser_.problem : "cannot be read"));
    }
    const yaml_event_type_t type = event.type;
    if (type == YAML_SCALAR_EVENT) {
      word.assign(reinterpret_cast<const char*>(event.data.scalar.value), event.data.scalar.length);
    }
    yaml_event_delete(&event);
    return type;
  }

  yaml_parser_t parser_{};
};

std::string in_small_letters(std::string word) {
  for (char& c : word) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return word;
}

// Messages that zstd compressed one by one are read; whole files, and what other plugins compress, are not.
bool is_unread_compression(const Metadata& metadata) {
  const std::string mode = in_small_letters(metadata.compression_mode);
  return mode == "file" || (mode == "message" && in_small_letters(metadata.compression_format) != "zstd");
}

}  // namespace

bool is_rosbag2_folder(const std::filesystem::path& folder) {
  return metadata_of(folder).find(kInformation) != std::string::npos;
}

std::vector<std::filesystem::path> rosbag2_files(const std::filesystem::path& folder) {
  const Metadata metadata = MetadataParser(metadata_of(folder)).parse();
  if (is_unread_compression(metadata)) {
    throw FrameError(
        say("metadata.yaml: compression_mode {}, compression_format {}: of rosbag2's own compression MESSAGE with zstd "
            "is read; convert it with `ros2 bag convert`, or record with the compression of MCAP",
            metadata.compression_mode, metadata.compression_format));
  }
  if (metadata.files.empty()) throw FrameError(tr("metadata.yaml: relative_file_paths names no file"));
  std::vector<std::filesystem::path> files;
  for (const std::string& name : metadata.files) {
    // Early versions wrote the folder's own name in front.
    const std::filesystem::path file(name);
    std::error_code ignored;
    files.push_back(std::filesystem::exists(folder / file, ignored) ? folder / file : folder / file.filename());
  }
  return files;
}

}  // namespace pose_wall::tools
