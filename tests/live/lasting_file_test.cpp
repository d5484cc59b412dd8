// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a file that must survive a power cut is on the disk before it takes the place of the earlier one, and then
// its name is. Where the disk fails, the earlier file stays and the fault names it.

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "io/frames/whole_file.hpp"
#include "live/synced_files.hpp"
#include "support/said_by.hpp"
#include "tools/test_files.hpp"

namespace pose_wall::test {
namespace {

struct Syncs {
  std::mutex lock;
  std::filesystem::path watched;
  bool fail = false;
  std::vector<Synced> seen;
};

Syncs& all_syncs() {
  static Syncs syncs;
  return syncs;
}

std::string held_by(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

void watch_syncs(const std::filesystem::path& watched, bool fail) {
  Syncs& syncs = all_syncs();
  const std::lock_guard<std::mutex> locked(syncs.lock);
  syncs.watched = watched;
  syncs.fail = fail;
  syncs.seen.clear();
}

std::vector<Synced> synced_files() {
  Syncs& syncs = all_syncs();
  const std::lock_guard<std::mutex> locked(syncs.lock);
  return syncs.seen;
}

}  // namespace pose_wall::test

// In place of the C library's.
extern "C" int fsync(int file) {
  pose_wall::test::Syncs& syncs = pose_wall::test::all_syncs();
  const std::lock_guard<std::mutex> locked(syncs.lock);
  std::error_code ignored;
  const auto path = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file), ignored);
  syncs.seen.push_back({path, pose_wall::test::held_by(syncs.watched)});
  if (syncs.fail) {
    errno = EIO;
    return -1;
  }
  return static_cast<int>(syscall(SYS_fsync, file));
}

namespace pose_wall::tools {
namespace {

using namespace pose_wall::test;

class LastingFile : public ::testing::Test {
 protected:
  void TearDown() override { watch_syncs(""); }
  test::TempFolder folder_;
  const std::filesystem::path file_ = std::filesystem::canonical(folder_.write("kept", "old"));
};

TEST_F(LastingFile, IsOnTheDiskBeforeItsNameIsAndThenItsNameIs) {
  watch_syncs(file_);
  write_lasting_file(file_, "new");
  const std::vector<Synced> synced = synced_files();
  ASSERT_EQ(synced.size(), 2U);
  EXPECT_EQ(synced[0].path, part_of(file_));
  EXPECT_EQ(synced[0].beside, "old") << "it takes the place only then";
  EXPECT_EQ(synced[1].path, file_.parent_path());
  EXPECT_EQ(synced[1].beside, "new");
  EXPECT_FALSE(std::filesystem::exists(part_of(file_)));
}

TEST_F(LastingFile, OfABrokenDiskLeavesTheEarlierOne) {
  watch_syncs(file_, true);
  EXPECT_EQ(test::said_by<std::runtime_error>([&] { write_lasting_file(file_, "new"); }),
            file_.string() + ": cannot be written: Input/output error");
  EXPECT_EQ(test::text_of(file_), "old");
  EXPECT_FALSE(std::filesystem::exists(part_of(file_)));
}

// Thousands of pictures and clouds need not wait for the disk one by one.
TEST_F(LastingFile, OtherFilesDoNotWaitForTheDisk) {
  watch_syncs(file_);
  write_whole_file(file_, "new");
  EXPECT_TRUE(synced_files().empty());
}

}  // namespace
}  // namespace pose_wall::tools
