// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall explain: why one frame came out as it did.

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "config_file/load_config.hpp"
#include "explain/explanation.hpp"
#include "explain/explanation_json.hpp"
#include "explain/explanation_text.hpp"
#include "explain/traced_frame.hpp"
#include "frames/input_list.hpp"
#include "picture/frame_picture.hpp"
#include "results/frame_runner.hpp"
#include "terminal/counted.hpp"
#include "terminal/progress_bar.hpp"
#include "verbs/frame_options.hpp"
#include "verbs/output_file.hpp"
#include "verbs/verbs.hpp"

namespace pose_wall::tools {
namespace {

struct ExplainOptions {
  FrameOptions frames;
  std::uint64_t frame = 0;
  std::string picture;
  bool json = false;
};

struct Explained {
  FrameOutcome outcome;  // of the engine that is delivered
  std::optional<TracedFrame> traced;
  std::string picture;
};

// The only place that knows where frames come from.
class FrameList {
 public:
  explicit FrameList(const FrameOptions& options) : inputs_(collect_inputs(options.inputs)) {
    for (const std::string& error : inputs_.errors) fmt::print(stderr, "pose_wall explain: {}\n", error);
  }

  void expect(std::uint64_t frame) const {
    if (frame < inputs_.files.size()) return;
    if (inputs_.files.empty()) throw std::invalid_argument("no frame to explain");
    throw std::invalid_argument(fmt::format("--frame {}: there {} {}, 0 to {}", frame,
                                            inputs_.files.size() == 1 ? "is" : "are",
                                            counted(inputs_.files.size(), "frame"), inputs_.files.size() - 1));
  }
  FrameOutcome run(FrameRunner& runner, std::uint64_t frame, const FrameRunner::Look& look = {}) const {
    return runner.run(inputs_.files[static_cast<std::size_t>(frame)], look);
  }
  const std::vector<std::filesystem::path>& files() const { return inputs_.files; }

 private:
  FrameInputs inputs_;
};

std::string picture_of(const LoadedConfig& loaded, const pose_wall_points& points, const TracedFrame& traced,
                       const std::string& subtitle) {
  return picture::frame_picture(
      {loaded.config.get(), &traced.result, &points, "pose_wall: why this frame came out as it did", subtitle});
}

// The frames before count: they left states and held values behind.
Explained run_to_frame(const ExplainOptions& options, const LoadedConfig& loaded, const FrameList& list) {
  FrameRunner runner(loaded.config, options.frames.rate_hz);
  ProgressBar bar(static_cast<std::size_t>(options.frame) + 1, !options.frames.quiet && is_terminal(2));
  for (std::uint64_t i = 0; i < options.frame; ++i) {
    const FrameOutcome before = list.run(runner, i);
    if (!before.result) bar.print_above(fmt::format("pose_wall explain: {}: {}", before.source, before.error));
    bar.advance(before.source);
  }
  const Memento memento = memento_of(runner.engine());
  Explained out;
  out.outcome = list.run(runner, options.frame, [&](const auto& cloud, const auto& points, const auto&) {
    out.traced = trace_frame(loaded.config, memento, cloud);
    out.picture = picture_of(loaded, points, *out.traced, fmt::format("frame {}", options.frame));
  });
  return out;
}

void print_text(const ExplainOptions& options, const LoadedConfig& loaded, const Explained& explained,
                const explain::Explanation& explanation) {
  const pose_wall_result& result = explained.traced->result;
  const explain::Notes notes(*explained.traced->trace);
  fmt::print("{}: frame {}{}\n\n{}\nPlanes that were considered\n{}\nGates\n{}", explained.outcome.source,
             options.frame,
             options.frame > 0 ? fmt::format(", after the {} before it", counted(options.frame, "frame")) : "",
             explain::sentences_text(explanation), explain::planes_text(*loaded.config.get(), result, notes),
             explain::gates_text(notes, is_terminal(1)));
  if (notes.dropped() > 0) fmt::print("{} were left out for lack of room.\n", counted(notes.dropped(), "note"));
}

int explain_frame(const ExplainOptions& options) {
  const LoadedConfig loaded = options.frames.load();
  const FrameList list(options.frames);
  list.expect(options.frame);
  std::optional<OutputFile> picture;
  if (!options.picture.empty()) picture.emplace(options.picture, list.files());
  const Explained explained = run_to_frame(options, loaded, list);
  if (!explained.outcome.result) {
    fmt::print(stderr, "pose_wall explain: {}: {}\n", explained.outcome.source, explained.outcome.error);
    return kExitUnreadable;
  }
  if (!same_bits(*explained.outcome.result, explained.traced->result)) {
    throw std::logic_error("the engine that takes notes gave another result: do not believe it, and report this");
  }
  const explain::Explanation explanation =
      explain::explain_frame(*loaded.config.get(), explained.traced->result, *explained.traced->trace);
  if (options.json) {
    fmt::print("{}",
               explain::explanation_json(*loaded.config.get(), explained.outcome, *explained.traced, explanation));
  } else {
    print_text(options, loaded, explained, explanation);
  }
  if (picture) picture->write(explained.picture);
  return kExitDone;
}

int explain_or_complaint(const ExplainOptions& options) {
  try {
    return explain_frame(options);
  } catch (const std::runtime_error& error) {
    fmt::print(stderr, "pose_wall explain: {}\n", error.what());
    return kExitUnreadable;
  }
}

}  // namespace

void add_explain(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App* verb = app.add_subcommand("explain", "Say why one frame came out as it did: gates, planes, sentences");
  add_frame_options(verb, &options->frames);
  verb->add_option("-n,--frame", options->frame, "Which frame, counted from 0 as in the CSV of run")->required();
  verb->add_option("-p,--picture", options->picture, "SVG file for a picture of the frame");
  verb->add_flag("-j,--json", options->json, "Everything as one JSON object instead");
  verb->footer(
      "Examples:\n"
      "  pose_wall explain --config road/pose_wall.yaml --frame 12 road/frames\n"
      "  pose_wall explain -c road/pose_wall.yaml -n 12 --picture why.svg --set wall_length_min=1.5 road/frames\n"
      "  pose_wall explain -c road/pose_wall.yaml -n 12 --json road/frames | jq '.gates[] | select(.passed | not)'\n"
      "The frames before it are measured as well: what is held and smoothed hangs on them. Then it is computed twice, "
      "by\n"
      "the engine that is delivered and by one that takes notes; both give the same bits, or there is no explanation.\n"
      "Exit status: 0 done, 1 the frame could not be read or the picture not written, 2 bad usage or config.");
  verb->callback([options, &exit_code] { exit_code = explain_or_complaint(*options); });
}

}  // namespace pose_wall::tools
