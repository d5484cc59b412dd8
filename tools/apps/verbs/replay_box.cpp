// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall replay-box: what the black box holds, computed again; every bit must come out as it was published.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/box/box_replay.hpp"
#include "io/csv/csv_table.hpp"
#include "io/language/language.hpp"
#include "io/terminal/counted.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "pose_wall_box.h"
#include "study/motion/motion_rows.hpp"
#include "study/results/row_output.hpp"

namespace pose_wall::tools {
namespace {

constexpr int kExitDiffers = 3;

struct ReplayOptions {
  std::string file;
  std::string table;  // empty: none
  bool quiet = false;
};

const std::vector<std::string> kTableHead = {"event",       "kind",     "frame_index",   "stamp_ns",
                                             "received_ns", "computed", "along_state",   "along_m",
                                             "along_pl_m",  "run",      "motion_reasons"};

// The motion's cells are empty where an event has none.
std::vector<std::string> cells_of(const BoxEvent& e) {
  std::vector<std::string> cells = {
      fmt::format("{}", e.sequence),    e.kind == POSE_WALL_BOX_FRAME ? "frame" : "silence",
      fmt::format("{}", e.frame_index), fmt::format("{}", e.stamp_ns),
      fmt::format("{}", e.received_ns), e.computed};
  if (!e.motion) {
    cells.resize(kTableHead.size());
    return cells;
  }
  const pose_wall_motion_result& m = *e.motion;
  cells.emplace_back(pose_wall_motion_along_state_name(m.along_state));
  cells.push_back(csv_number(m.along_m));
  cells.push_back(csv_number(m.protection_level[POSE_WALL_MOTION_ALONG]));
  cells.push_back(m.run != 0 ? fmt::format("{:08x}", m.run & 0xFFFFFFFFU) : "");
  cells.push_back(motion_reason_names(m.reasons));
  return cells;
}

void print_motion(const BoxMotion& motion) {
  if (motion.frames == 0) return;
  std::string states;
  for (std::uint32_t s = POSE_WALL_ALONG_MEASURED + 1; s-- > 0;) {
    if (motion.of_state[s] == 0) continue;
    states +=
        fmt::format("{}{} {}", states.empty() ? "" : ", ", motion.of_state[s], pose_wall_motion_along_state_name(s));
  }
  fmt::print("  {} with motion: {}", counted(motion.frames, "frame"), states);
  if (motion.has_travel) fmt::print("; travel from {:.3f} to {:.3f} m", motion.first_m, motion.last_m);
  fmt::print("\n");
}

void print(const ReplayOptions& options, const BoxReplay& r) {
  fmt::print("{}", say("{}: recorded by pose_wall {}; events {} ({} to {}), frames {}, silences {}\n", options.file,
                       r.version, r.records, r.first_sequence, r.last_sequence, r.frames, r.silences));
  fmt::print("{}", say("  {} bit for bit as recorded, {} otherwise\n", r.equal, r.different));
  if (r.thinned > 0) fmt::print("  {} of a thinned cloud\n", counted(r.thinned, "frame"));
  if (r.with_inputs > 0) fmt::print("  {} with inputs of the machine\n", counted(r.with_inputs, "frame"));
  print_motion(r.motion);
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
  std::optional<RowOutput> table;
  if (!options.table.empty()) {
    table.emplace(options.table, std::vector<std::filesystem::path>{options.file}, csv_line(kTableHead), "--table");
  }
  bool is_written = true;
  const auto progress = [&](std::uint64_t done, std::uint64_t of) {
    if (!bar) bar = std::make_unique<ProgressBar>(of, !options.quiet && is_terminal(2), "events");
    bar->advance(fmt::format("event {}", done));
    stop_if_interrupted();
  };
  const BoxReplay result = replay_box(options.file, progress, [&](const BoxEvent& event) {
    if (table) is_written = table->write(csv_line(cells_of(event))) && is_written;
  });
  bar.reset();  // takes its line away
  print(options, result);
  if (!is_written) throw OutputError(say("{} could not be written to the end", table->name()));
  if (result.different > 0) return kExitDiffers;
  return result.is_whole() && result.reproduced() ? kExitDone : kExitUnreadable;
}

}  // namespace

void add_replay_box(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* verb = app.add_subcommand("replay-box", tr("Compute a black box again and compare every bit"));
  verb->add_option("FILE", options->file, tr("A black box of the runtime"))->required();
  verb->add_option("--table", options->table,
                   tr("File for a CSV of the events: the result of each comparison, and the recorded motion"));
  verb->add_flag("-q,--quiet", options->quiet, tr("Nothing on stderr but errors"));
  verb->footer(tr(
      "Examples:\n"
      "  pose_wall replay-box box.pwbox\n"
      "  pose_wall replay-box --table events.csv box.pwbox\n"
      "Exit status: 0 every event gives the recorded bits, and none is damaged or missing; 1 damage, missing events,\n"
      "no black box, or digests only; 3 a result differs (the first difference is named). Gaps in older laps of the "
      "ring\n"
      "and in earlier runs do not count."));
  verb->callback(
      [options, &exit_code] { exit_code = done_or_complaint("replay-box", [&] { return replay(*options); }); });
}

}  // namespace pose_wall::tools
