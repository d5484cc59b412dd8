// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/planar_files/pgm_image.hpp"

#include <fmt/format.h>

#include <cctype>

#include "io/language/language.hpp"
#include "pose_wall_planar_grid.h"

namespace pose_wall::tools {
namespace {

constexpr std::uint32_t kMostOfAll = 65535;  // of the format

class HeaderWords {
 public:
  explicit HeaderWords(std::string_view bytes) : bytes_(bytes) {}

  // A number behind white space and comments, with what it is called.
  std::uint32_t number(const char* name, std::uint32_t least, std::uint32_t most) {
    skip_space();
    const std::size_t first = at_;
    std::uint64_t value = 0;
    for (; at_ < bytes_.size() && is_digit(bytes_[at_]); ++at_) {
      value = value * 10 + static_cast<std::uint64_t>(bytes_[at_] - '0');
      if (value > kMostOfAll) break;
    }
    if (at_ == first) throw PgmError(say("the image ends or has no number where its {} is expected", tr(name)));
    if (value < least || value > most) {
      throw PgmError(say("the image's {} must be from {} to {}", tr(name), least, most));
    }
    return static_cast<std::uint32_t>(value);
  }

  // The one white space behind the head; pixels follow.
  std::string_view rest() {
    if (at_ >= bytes_.size() || !is_space(bytes_[at_])) throw PgmError(tr("the image ends before its first pixel"));
    return bytes_.substr(at_ + 1);
  }

 private:
  static bool is_digit(char sign) { return sign >= '0' && sign <= '9'; }
  static bool is_space(char sign) { return std::isspace(static_cast<unsigned char>(sign)) != 0; }

  void skip_space() {
    for (; at_ < bytes_.size(); ++at_) {
      if (bytes_[at_] == '#') {
        while (at_ < bytes_.size() && bytes_[at_] != '\n' && bytes_[at_] != '\r') ++at_;
        if (at_ == bytes_.size()) return;
      } else if (!is_space(bytes_[at_])) {
        return;
      }
    }
  }

  std::string_view bytes_;
  std::size_t at_ = 2;  // behind P5
};

[[maybe_unused]] constexpr const char* kSizeNames[] = {translatable("width"), translatable("height"),
                                                       translatable("white"), translatable("pixel")};

void read_binary(std::string_view bytes, PgmImage* image) {
  const std::size_t pixels = image->pixels.size(), each = image->most > 255 ? 2 : 1;
  if (bytes.size() < pixels * each) {
    throw PgmError(say("the image is cut off: {} of {} bytes of pixels", bytes.size(), pixels * each));
  }
  const auto byte = [&](std::size_t k) { return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k])); };
  for (std::size_t k = 0; k < pixels; ++k) {
    const std::uint32_t pixel = each == 1 ? byte(k) : byte(2 * k) << 8 | byte(2 * k + 1);
    if (pixel > image->most)
      throw PgmError(say("a pixel of {} is whiter than the image's white, {}", pixel, image->most));
    image->pixels[k] = static_cast<std::uint16_t>(pixel);
  }
}

}  // namespace

PgmImage parse_pgm(std::string_view bytes) {
  const bool binary = bytes.substr(0, 2) == "P5", text = bytes.substr(0, 2) == "P2";
  if (!binary && !text) throw PgmError(tr("the image is no PGM: it must begin with P5 or P2"));
  PgmImage image;
  HeaderWords words(bytes);
  image.width = words.number("width", 1, POSE_WALL_PLANAR_GRID_SIDE_MAX);
  image.height = words.number("height", 1, POSE_WALL_PLANAR_GRID_SIDE_MAX);
  image.most = words.number("white", 1, kMostOfAll);
  const std::size_t pixels = std::size_t{image.width} * image.height;
  if (bytes.size() < pixels) {  // a byte a pixel at least: what is not there is not allocated
    throw PgmError(say("the image is cut off: {} of {} bytes of pixels", bytes.size(), pixels));
  }
  image.pixels.resize(pixels);
  if (binary) {
    read_binary(words.rest(), &image);
    return image;
  }
  for (auto& pixel : image.pixels) pixel = static_cast<std::uint16_t>(words.number("pixel", 0, image.most));
  return image;
}

std::string pgm_bytes(const PgmImage& image, std::string_view comment) {
  std::string bytes = fmt::format("P5\n# {}\n{} {}\n255\n", comment, image.width, image.height);
  for (const std::uint16_t pixel : image.pixels) bytes.push_back(static_cast<char>(pixel));
  return bytes;
}

}  // namespace pose_wall::tools
