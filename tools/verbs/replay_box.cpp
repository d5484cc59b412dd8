// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall replay-box: what the black box holds, computed again; every bit must come out as it was published.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "box/box_replay.hpp"
#include "terminal/counted.hpp"
#include "terminal/progress_bar.hpp"
#include "verbs/complaint.hpp"
#include "verbs/verbs.hpp"

namespace pose_wall::tools {
namespace {

constexpr int kExitDiffers = 3;

struct ReplayOptions {
  std::string file;
  bool quiet = false;
};

void print(const ReplayOptions& options, const BoxReplay& r) {
  fmt::print("{}: recorded by pose_wall {}; {} ({} to {}): {}, {}\n", options.file, r.version,
             counted(r.records, "event"), r.first_sequence, r.last_sequence, counted(r.frames, "frame"),
             counted(r.silences, "silence"));
  fmt::print("  {} bit for bit as recorded, {} otherwise\n", r.equal, r.different);
  if (r.thinned > 0) fmt::print("  {} of a thinned cloud\n", counted(r.thinned, "frame"));
  if (r.with_inputs > 0) fmt::print("  {} with inputs of the machine\n", counted(r.with_inputs, "frame"));
  if (r.digests_only > 0) fmt::print("  {} only as digests: there is nothing to compute\n", r.digests_only);
  if (r.missing > 0) fmt::print("  {} missing: lost to a slow disk, or damaged\n", counted(r.missing, "event"));
  if (r.damaged > 0) fmt::print("  {} damaged or cut off\n", counted(r.damaged, "record"));
  if (r.refused > 0) fmt::print("  {} refused by this build's engine\n", counted(r.refused, "record"));
  if (r.torn > 0) fmt::print("  {} between the records are none\n", counted(r.torn, "byte"));
  if (r.not_searched > 0) {
    fmt::print("  {} of damaged records not searched for others: too many of them overlap\n",
               counted(r.not_searched, "byte"));
  }
  if (r.left_over > 0) fmt::print("  {} left over from older laps of the ring\n", counted(r.left_over, "event"));
  if (r.of_other_runs > 0) {
    fmt::print("  {} of another run: not computed, the header's config may not be theirs\n",
               counted(r.of_other_runs, "record"));
  }
  if (!r.first) return;
  const BoxDifference& d = *r.first;
  fmt::print("first difference: event {}, frame {}, stamp {}: {}\n  recorded {}\n  computed {}\n", d.sequence,
             d.frame_index, d.stamp_ns, d.what.field, d.what.recorded, d.what.computed);
}

int replay(const ReplayOptions& options) {
  std::unique_ptr<ProgressBar> bar;
  const BoxReplay result = replay_box(options.file, [&](std::uint64_t done, std::uint64_t of) {
    if (!bar) bar = std::make_unique<ProgressBar>(of, !options.quiet && is_terminal(2), "events");
    bar->advance(fmt::format("event {}", done));
  });
  bar.reset();  // takes its line away
  print(options, result);
  if (result.different > 0) return kExitDiffers;
  return result.is_whole() && result.reproduced() ? kExitDone : kExitUnreadable;
}

}  // namespace

void add_replay_box(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* verb = app.add_subcommand("replay-box", "Compute a black box again and compare every bit");
  verb->add_option("FILE", options->file, "A black box, as the runtime wrote it")->required();
  verb->add_flag("-q,--quiet", options->quiet, "Nothing on stderr but errors");
  verb->footer(
      "Example:\n  pose_wall replay-box box.pwbox\n"
      "Exit status: 0 every event computes to the recorded bits and nothing is damaged or missing, 1 damaged, events "
      "missing,\nno black box, or digests only, 3 a result differs (the first difference is named). What a ring that "
      "came "
      "round keeps of\nolder laps, or of earlier runs, has no gaps to count.");
  verb->callback(
      [options, &exit_code] { exit_code = done_or_complaint("replay-box", [&] { return replay(*options); }); });
}

}  // namespace pose_wall::tools
