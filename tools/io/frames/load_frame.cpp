// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/load_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <ios>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/frames/bare_layout_guess.hpp"
#include "io/frames/file_content.hpp"
#include "io/frames/pcd_reader.hpp"
#include "io/frames/ply_reader.hpp"
#include "io/frames/text_cursor.hpp"
#include "io/frames/text_points.hpp"
#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uintmax_t kFrameBytesMax = 2'000'000'000;  // a hundred times the largest frame of a sensor on the market

enum class Ending { kOther, kPcd, kBare, kPly, kText };

struct KnownEnding {
  std::string_view ending;
  Ending kind;
};

constexpr std::array<KnownEnding, 7> kEndings = {{{".pcd", Ending::kPcd},
                                                  {".bin", Ending::kBare},
                                                  {".ply", Ending::kPly},
                                                  {".xyz", Ending::kText},
                                                  {".asc", Ending::kText},
                                                  {".txt", Ending::kText},
                                                  {".csv", Ending::kText}}};

Ending ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto known = std::find_if(kEndings.begin(), kEndings.end(),
                                  [&ending](const KnownEnding& row) { return row.ending == ending; });
  return known != kEndings.end() ? known->kind : Ending::kOther;
}

std::string_view beginning_of_bytes(const Bytes& bytes) {
  return as_text(bytes).substr(0, 4096);
}

Frame read_bare(Bytes bytes, const BareChoice& choice) {
  if (choice.given) return read_bare_points(std::move(bytes), *choice.given);
  const BareGuess guess = guess_bare_layout(bytes);
  const BareLayout* clear = guess.clear();
  if (choice.of_others && clear != nullptr && !clear->same_bytes(*choice.of_others)) {
    throw FrameError(say("the values look like {}, those of the files before like {}; --layout says which",
                         bare_layout_words(*clear), bare_layout_words(*choice.of_others)));
  }
  if (choice.of_others && bytes.size() % choice.of_others->point_step() == 0) {
    return read_bare_points(std::move(bytes), *choice.of_others);
  }
  if (clear == nullptr) throw FrameError(unclear_layout_text(guess, bytes.size()));
  return read_bare_points(std::move(bytes), *clear);
}

Frame read_text(const Bytes& bytes, const BareChoice& choice) {
  return read_text_points(bytes, choice.given ? &*choice.given : nullptr,
                          choice.text_of_others ? &*choice.text_of_others : nullptr);
}

// The bytes do not say what they are.
Frame read_by_ending(Bytes bytes, const std::filesystem::path& path, const BareChoice& choice) {
  const Ending ending = ending_of(path);
  if (ending == Ending::kBare || (choice.given && !bytes.empty())) return read_bare(std::move(bytes), choice);
  if (bytes.empty()) throw FrameError(tr("the file is empty"));
  if (ending == Ending::kOther) {
    throw FrameError(
        say("unknown ending '{}', and the file begins like nothing that is read; frame files ({}), bags "
            "and captures are; bare numbers without a header with --layout",
            path.extension().string(), frame_endings_text()));
  }
  throw FrameError(
      say("this is no {}, and begins like nothing else that is read; bare numbers without a header are read "
          "from .bin, and with --layout from any file",
          ending == Ending::kPcd   ? "PCD"
          : ending == Ending::kPly ? "PLY"
                                   : tr("text")));
}

// Text that neither a header nor a first line of points begins: the reader of its ending says what is missing.
Frame read_text_by_ending(Bytes bytes, const std::filesystem::path& path, const BareChoice& choice) {
  if (choice.given || begins_like_points(beginning_of_bytes(bytes))) return read_text(bytes, choice);
  const Ending ending = ending_of(path);
  if (ending == Ending::kPcd) return read_pcd(std::move(bytes));
  if (ending == Ending::kPly) return read_ply(std::move(bytes));
  return read_text(bytes, choice);
}

}  // namespace

Bytes read_frame_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw FrameError(tr("not a regular file"));
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw FrameError(system_error_text(error.value()));
  if (size > kFrameBytesMax) {
    throw FrameError(say("{} bytes; a frame file of at most {} bytes is read", size, kFrameBytesMax));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FrameError(say("cannot be opened for reading: {}", system_error_text(errno)));
  Bytes bytes(static_cast<std::size_t>(size));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::uintmax_t>(file.gcount()) != size) {
    throw FrameError(say("only {} of {} bytes could be read", file.gcount(), size));
  }
  return bytes;
}

std::string frame_endings_text() {
  return ".pcd, .bin, .ply, .xyz, .asc, .txt, .csv";
}

bool has_frame_ending(const std::filesystem::path& path) {
  const Ending ending = ending_of(path);
  return ending == Ending::kPcd || ending == Ending::kBare || ending == Ending::kPly;
}

bool has_text_ending(const std::filesystem::path& path) {
  return ending_of(path) == Ending::kText;
}

bool has_bare_ending(const std::filesystem::path& path) {
  return ending_of(path) == Ending::kBare;
}

Frame load_frame(const std::filesystem::path& path, const BareChoice& bare) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    const std::filesystem::path target = std::filesystem::read_symlink(path, error);  // empty where it is no link
    if (target.empty()) throw FrameError(tr("not there: no such file or folder"));
    throw FrameError(say("not there: it is a link to {}, which leads to no file", target.string()));
  }
  Bytes bytes = read_frame_bytes(path);
  const std::string_view beginning = beginning_of_bytes(bytes);
  const FileContent content = content_of(beginning);
  switch (content) {
    case FileContent::kPcd:
      return read_pcd(std::move(bytes));
    case FileContent::kPly:
      return read_ply(std::move(bytes));
    case FileContent::kText:
      return read_text_by_ending(std::move(bytes), path, bare);
    case FileContent::kForeign:
      throw FrameError(foreign_advice(beginning));
    case FileContent::kEmpty:
    case FileContent::kUnknown:
      return read_by_ending(std::move(bytes), path, bare);
    default:
      throw FrameError(say("this is {}, not one frame; name it as an input of its own", content_name(content)));
  }
}

}  // namespace pose_wall::tools
