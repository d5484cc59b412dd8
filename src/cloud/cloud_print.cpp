// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "cloud/cloud_print.hpp"

#include "cloud/cloud_reader.hpp"

namespace pose_wall {
void CloudPrint::clear() {
  for (std::uint64_t& sum : sum_) sum = 0;
}

std::uint32_t CloudPrint::returns() const {
  std::uint32_t sum = 0;
  for (std::uint32_t s = 0; s < kSectors; ++s) sum += returns(s);
  return sum;
}

std::uint32_t CloudPrint::of(std::uint32_t sector) const {
  return static_cast<std::uint32_t>(sum_[sector] >> 32 ^ (sum_[sector] & ~kCounts));
}

std::uint64_t CloudPrint::whole() const {
  std::uint64_t whole = 0xCBF29CE484222325ULL;  // FNV-1a by words
  for (std::uint32_t s = 0; s < kSectors; ++s) whole = (whole ^ sum_[s]) * 0x100000001B3ULL;
  return whole;
}

void print_cloud(const pose_wall_cloud& cloud, CloudPrint* print) {
  const bool swap = needs_swap(cloud), in_a_row = is_xyz32_in_a_row(cloud);
  print->clear();
  for (std::uint32_t row = 0; row < rows_of(cloud); ++row) {
    const unsigned char* point = row_of(cloud, row);
    for (std::uint32_t k = 0; k < cloud.width; k += kFour, point += std::size_t{kFour} * cloud.point_step) {
      const std::uint32_t left = cloud.width - k, count = left < kFour ? left : kFour;
      if (in_a_row && count == kFour) {
        print->add_four(plain_four(point + cloud.x.offset, cloud.point_step));
        continue;
      }
      FourPlaces p{};
      for (std::uint32_t lane = 0; lane < count; ++lane) {
        const unsigned char* const at = point + std::size_t{lane} * cloud.point_step;
        p.x[lane] = to_float(read_field(at, cloud.x, swap));
        p.y[lane] = to_float(read_field(at, cloud.y, swap));
        p.z[lane] = to_float(read_field(at, cloud.z, swap));
      }
      print->add_some(p, count);
    }
  }
}

}  // namespace pose_wall
