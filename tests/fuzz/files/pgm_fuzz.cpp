// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as a PGM image. What is read has as many pixels as its sides say, none above white, and is read
// again from what it is written to.

#include <string>
#include <string_view>

#include "fuzz/fuzz_target.hpp"
#include "io/planar_files/pgm_image.hpp"

namespace {

using pose_wall::test::require;
using namespace pose_wall::tools;  // NOLINT(google-build-using-namespace): one target, one file

void take_image(const PgmImage& image) {
  require(image.pixels.size() == std::size_t{image.width} * image.height, "as many pixels as the sides say");
  for (const std::uint16_t pixel : image.pixels) require(pixel <= image.most, "no pixel is whiter than white");
  if (image.most > 255) return;
  const PgmImage again = parse_pgm(pgm_bytes(image, "a comment"));
  require(again.width == image.width && again.height == image.height && again.pixels == image.pixels, "the same image");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    take_image(parse_pgm(std::string_view(reinterpret_cast<const char*>(data), size)));
  } catch (const PgmError& error) {
    require(error.what()[0] != '\0', "a refusal has a reason");
  }
  return 0;
}
