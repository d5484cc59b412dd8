// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Zips by libzip: written as a whole, and read member by member.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

struct zip;

namespace pose_wall::tools::evidence {

// A file that is on its way into a zip.
struct NewMember {
  std::string name;
  std::filesystem::path file;  // empty: the bytes
  std::string bytes;
  bool deflates = false;
};

// Writes all members in their order; Zip64 where sizes ask for it. `done`: told the share that is done, 0 to 1. On the
// disk when it returns. Throws std::runtime_error that names the zip, and Interrupted after Ctrl-C.
void write_zip(const std::filesystem::path& zip, const std::vector<NewMember>& members,
               const std::function<void(double share)>& done);

struct Member {
  std::string name;  // as its bytes stand there
  std::uint64_t bytes = 0, packed_bytes = 0;
  bool is_plain = false;  // stored or deflated, not encrypted
};

class ZipReader {
 public:
  // Throws std::runtime_error where libzip finds the zip damaged.
  explicit ZipReader(const std::filesystem::path& zip);

  const std::vector<Member>& members() const { return members_; }

  // Hands out the member's bytes, chunk by chunk, and never more than the zip says that it has. False where they are
  // not that many, do not unpack, or differ from the zip's own checksum.
  bool read(std::size_t index, const std::function<void(const char* bytes, std::size_t count)>& take) const;

 private:
  std::unique_ptr<zip, void (*)(zip*)> zip_;
  std::vector<Member> members_;
};

}  // namespace pose_wall::tools::evidence
