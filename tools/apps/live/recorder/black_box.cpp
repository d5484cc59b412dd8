// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The runtime's black box in a folder of bounded size: a ring file for each time that the runtime is opened.

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "apps/live/recorder/bounded_folder.hpp"
#include "io/box/file_sink.hpp"

namespace pose_wall::tools::live {
namespace {

// So that three earlier starts stay: an incident, the restart after it, and what somebody tried then.
constexpr std::uint64_t kFilesKept = 4;
constexpr std::uint64_t kAlignment = 64;               // pose_wall_runtime_options.box_bytes
constexpr std::int64_t kLookEvery_ns = 1'000'000'000;  // as the recorder writes

// The file, and how it fares.
class BoxFile {
 public:
  BoxFile(BoundedFolder folder, const std::string& file) : folder_(std::move(folder)), sink_(file) { look(); }

  // A pose_wall_runtime_sink; user: the BoxFile.
  static std::int32_t write(void* user, std::uint64_t offset, const void* bytes, std::uint64_t count) {
    BoxFile& self = *static_cast<BoxFile*>(user);
    errno = 0;
    const std::int32_t status = FileSink::write(&self.sink_, offset, bytes, count);
    self.state_->fault = status == 0 ? 0 : errno != 0 ? errno : EIO;
    if (monotonic_ns() - self.looked_ns_ >= kLookEvery_ns) self.look();
    return status;
  }
  std::shared_ptr<const BlackBox::State> state() const { return state_; }

 private:
  void look() {
    looked_ns_ = monotonic_ns();
    state_->free_bytes = folder_.free_bytes();
  }

  BoundedFolder folder_;
  FileSink sink_;
  std::shared_ptr<BlackBox::State> state_ = std::make_shared<BlackBox::State>();
  std::int64_t looked_ns_ = 0;
};

}  // namespace

BlackBox open_black_box(const LoadedConfig& loaded) {
  if (loaded.live.black_box.empty()) return {};
  BoundedFolder folder(loaded.live.black_box, ".box",
                       static_cast<std::uint64_t>(loaded.live.black_box_mb * kBytesPerMb));
  BlackBox box;
  box.bytes = folder.room_bytes() / kFilesKept / kAlignment * kAlignment;
  const std::string file = folder.next(box.bytes).string();
  // A start that fails leaves no file: once a second for a night, there would be thousands without a byte.
  const std::shared_ptr<BoxFile> sink(new BoxFile(folder, file), [file](BoxFile* written) {
    delete written;
    std::error_code gone;
    if (std::filesystem::file_size(file, gone) == 0 && !gone) std::filesystem::remove(file, gone);
  });
  box.write = BoxFile::write;
  box.state = sink->state();
  box.user = sink.get();
  box.keeper = sink;
  log_line(Grade::kGood, "black box", file + ": written from now on; `pose_wall replay-box` computes it again");
  return box;
}

}  // namespace pose_wall::tools::live
