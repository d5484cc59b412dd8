// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/recorder/bounded_folder.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace pose_wall::tools::live {
namespace {

// Of a number in a name, with zeros before it, so that names sort as numbers do up to a million files.
constexpr std::size_t kDigits = 6;

// Of a name that we gave.
std::optional<std::uint64_t> number_of(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const auto digits = static_cast<std::size_t>(end - name.data());
  if (error != std::errc() || digits < kDigits || digits >= name.size() || *end != '_') return std::nullopt;
  return number;
}

std::uint64_t size_of(const std::filesystem::path& file) {
  std::error_code gone;
  const std::uintmax_t bytes = std::filesystem::file_size(file, gone);
  return gone ? 0 : bytes;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  return fmt::format("{:%Y%m%dT%H%M%SZ}", parts);
}

}  // namespace

BoundedFolder::BoundedFolder(std::filesystem::path folder, std::string ending, std::uint64_t room_bytes)
    : folder_(std::move(folder)), ending_(std::move(ending)), room_bytes_(room_bytes) {}

std::vector<std::filesystem::path> BoundedFolder::files() const {
  std::vector<std::filesystem::path> found;
  std::error_code gone;
  for (std::filesystem::directory_iterator entry(folder_, gone), end; !gone && entry != end; entry.increment(gone)) {
    if (entry->path().extension() == ending_ && number_of(entry->path())) found.push_back(entry->path());
  }
  std::sort(found.begin(), found.end(), [](const std::filesystem::path& a, const std::filesystem::path& b) {
    return *number_of(a) < *number_of(b);
  });
  return found;
}

std::uint64_t BoundedFolder::bytes() const {
  std::uint64_t sum = 0;
  for (const std::filesystem::path& file : files()) sum += size_of(file);
  return sum;
}

std::uint64_t BoundedFolder::free_bytes() const {
  std::error_code fault;
  const std::filesystem::space_info space = std::filesystem::space(folder_, fault);
  return fault ? 0 : space.available;
}

bool BoundedFolder::make_room(std::uint64_t bytes, const std::filesystem::path& kept) const {
  std::uint64_t taken = this->bytes();
  for (const std::filesystem::path& oldest : files()) {
    if (taken + bytes <= room_bytes_) return true;
    if (oldest == kept) continue;
    const std::uint64_t freed = size_of(oldest);
    std::error_code refused;
    if (std::filesystem::remove(oldest, refused)) taken -= std::min(taken, freed);
  }
  return taken + bytes <= room_bytes_;
}

std::filesystem::path BoundedFolder::next(std::uint64_t bytes) {
  if (bytes > room_bytes_) {
    throw std::runtime_error(
        fmt::format("{}: one file needs {} bytes, the room for all is {}", folder_.string(), bytes, room_bytes_));
  }
  std::error_code fault;
  std::filesystem::create_directories(folder_, fault);
  if (fault) throw std::system_error(fault, folder_.string());
  const std::vector<std::filesystem::path> known = files();
  const std::uint64_t number = known.empty() ? 1 : *number_of(known.back()) + 1;
  make_room(bytes);
  return folder_ / fmt::format("{:0{}}_{}{}", number, kDigits, utc_now(), ending_);
}

}  // namespace pose_wall::tools::live
