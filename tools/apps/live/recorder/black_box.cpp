// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The runtime's black box in a folder of bounded size: a ring file for each time that the runtime is opened.

#include <filesystem>
#include <system_error>

#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "apps/live/recorder/bounded_folder.hpp"
#include "io/box/file_sink.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr double kBytesPerMb = 1e6;
// So that three earlier starts stay: an incident, the restart after it, and what somebody tried then.
constexpr std::uint64_t kFilesKept = 4;
constexpr std::uint64_t kAlignment = 64;  // pose_wall_runtime_options.box_bytes

}  // namespace

BlackBox open_black_box(const LoadedConfig& loaded) {
  if (loaded.live.black_box.empty()) return {};
  BoundedFolder folder(loaded.live.black_box, ".box",
                       static_cast<std::uint64_t>(loaded.live.black_box_mb * kBytesPerMb));
  BlackBox box;
  box.bytes = folder.room_bytes() / kFilesKept / kAlignment * kAlignment;
  const std::string file = folder.next(box.bytes).string();
  // A start that fails leaves no file: once a second for a night, there would be thousands without a byte.
  const std::shared_ptr<FileSink> sink(new FileSink(file), [file](FileSink* written) {
    delete written;
    std::error_code gone;
    if (std::filesystem::file_size(file, gone) == 0 && !gone) std::filesystem::remove(file, gone);
  });
  box.write = FileSink::write;
  box.user = sink.get();
  box.keeper = sink;
  log_line(Grade::kGood, "black box", file + ": written from now on; `pose_wall replay-box` computes it again");
  return box;
}

}  // namespace pose_wall::tools::live
