// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall explain: why one frame came out as it did.

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "config_file/load_config.hpp"
#include "explain/amounts.hpp"
#include "explain/explanation.hpp"
#include "explain/explanation_json.hpp"
#include "explain/explanation_text.hpp"
#include "explain/gate_list.hpp"
#include "explain/traced_frame.hpp"
#include "inputs/frame_sequence.hpp"
#include "picture/frame_picture.hpp"
#include "results/frame_runner.hpp"
#include "terminal/colours.hpp"
#include "terminal/counted.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress_bar.hpp"
#include "verbs/complaint.hpp"
#include "verbs/frame_options.hpp"
#include "verbs/one_of.hpp"
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
  explain::Explanation explanation;
  std::string picture;
};

void expect_frame(std::uint64_t frame, std::size_t frames) {
  if (frame < frames) return;
  if (frames == 0) throw std::runtime_error("no frame to explain");
  throw std::invalid_argument(fmt::format("--frame {}: there {} {}, 0 to {}", frame, frames == 1 ? "is" : "are",
                                          counted(frames, "frame"), frames - 1));
}

std::string picture_of(const LoadedConfig& loaded, const pose_wall_points& points, const Explained& explained,
                       std::uint64_t frame) {
  std::string subtitle = fmt::format("frame {}", frame);
  for (const explain::Paragraph& p : explained.explanation.paragraphs) {
    subtitle += fmt::format(", {} {}", p.subject == POSE_WALL_TRACE_FRAME ? "itself" : explain::subject_name(p.subject),
                            explain::verdict_name(p.verdict));
  }
  return picture::frame_picture({loaded.config.get(), &explained.traced->result, &points,
                                 "pose_wall: why this frame came out as it did", subtitle});
}

void explain_points(const LoadedConfig& loaded, const Memento& before, const pose_wall_cloud& cloud,
                    const pose_wall_points& points, std::uint64_t frame, Explained* out) {
  out->traced = trace_frame(loaded.config, before, cloud);
  out->explanation = explain::explain_frame(*loaded.config.get(), out->traced->result, *out->traced->trace);
  out->picture = picture_of(loaded, points, *out, frame);
}

// The frames before count: they left states and held values behind. Nothing: interrupted.
std::optional<Explained> run_to_frame(const ExplainOptions& options, const LoadedConfig& loaded,
                                      FrameSequence& inputs) {
  FrameRunner runner(loaded.config, options.frames.rate_hz, loaded.motion);
  const InterruptWatch watch;
  ProgressBar bar(static_cast<std::size_t>(options.frame) + 1, !options.frames.quiet && is_terminal(2));
  for (std::uint64_t i = 0; !InterruptWatch::is_interrupted(); ++i) {
    std::optional<SourcedFrame> frame = inputs.next();
    if (!frame) throw std::runtime_error(fmt::format("the input ended before frame {}", options.frame));
    if (i == options.frame) {
      const Memento before = memento_of(runner.engine());
      Explained out;
      out.outcome = runner.run(std::move(*frame), [&](const auto& cloud, const auto& points, const auto&) {
        explain_points(loaded, before, cloud, points, options.frame, &out);
      });
      return out;
    }
    const FrameOutcome outcome = runner.run(std::move(*frame));
    if (!outcome.result) bar.print_above(fmt::format("pose_wall explain: {}: {}", outcome.source, outcome.error));
    bar.advance(outcome.source);
  }
  return std::nullopt;
}

void print_text(const ExplainOptions& options, const LoadedConfig& loaded, const Explained& explained) {
  const pose_wall_result& result = explained.traced->result;
  const explain::Notes notes(*explained.traced->trace);
  fmt::print("{}: frame {}{}\n\n{}\nPlanes that were considered\n{}\nGates\n{}", explained.outcome.source,
             options.frame,
             options.frame > 0 ? fmt::format(", after the {} before it", counted(options.frame, "frame")) : "",
             explain::sentences_text(explained.explanation), explain::planes_text(*loaded.config.get(), result, notes),
             explain::gates_text(notes, wants_colours(1)));
  if (notes.dropped() > 0) fmt::print("{} left out for lack of room.\n", counted(notes.dropped(), "note"));
}

// It is SVG whatever the file is called.
void expect_svg(const std::string& picture) {
  if (picture.empty() || std::filesystem::path(picture).extension() == ".svg") return;
  throw std::invalid_argument(
      fmt::format("--picture {}: the picture is written as SVG; a file ending in .svg is allowed", picture));
}

int explain_frame(const ExplainOptions& options) {
  const LoadedConfig loaded = options.frames.load();
  FrameSequence inputs = options.frames.open();
  for (const std::string& error : inputs.errors()) fmt::print(stderr, "pose_wall explain: {}\n", error);
  expect_frame(options.frame, inputs.frames());
  std::optional<OutputFile> picture;
  if (!options.picture.empty()) picture.emplace(options.picture, options.frames.files_read(inputs), "--picture");
  expect_svg(options.picture);
  const std::optional<Explained> explained = run_to_frame(options, loaded, inputs);
  if (!explained) return kExitInterrupted;
  if (!explained->outcome.result) {
    fmt::print(stderr, "pose_wall explain: {}: {}\n", explained->outcome.source, explained->outcome.error);
    return kExitUnreadable;
  }
  if (!same_bits(*explained->outcome.result, explained->traced->result)) {
    throw std::runtime_error(
        "the engine that takes notes gave another result: report this, its notes are worth nothing");
  }
  if (options.json) {
    fmt::print("{}", explain::explanation_json(*loaded.config.get(), explained->outcome, *explained->traced,
                                               explained->explanation));
  } else {
    print_text(options, loaded, *explained);
  }
  if (picture) picture->write(explained->picture);
  return kExitDone;
}

}  // namespace

void add_explain(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App* verb = app.add_subcommand("explain", "Say why one frame came out as it did: gates, planes, sentences");
  add_frame_options(verb, &options->frames);
  verb->add_option("-n,--frame", options->frame, "Which frame, counted from 0 as in the CSV of run")
      ->required()
      ->check(whole_number());
  verb->add_option("-p,--picture", options->picture, "SVG file for a picture of the frame");
  verb->add_flag("-j,--json", options->json, "Everything as one JSON object instead");
  // As --help it needs no frame.
  const auto print_gates = [] {
    fmt::print("{}", explain::gate_list_text());
    throw CLI::Success();
  };
  verb->add_flag_callback("--gates", print_gates, "Print the list of all gates with their limits, and no frame")
      ->trigger_on_parse();
  verb->footer(
      "Examples:\n"
      "  pose_wall explain --config road/pose_wall.yaml --frame 12 road/frames\n"
      "  pose_wall explain -c road/pose_wall.yaml -n 12 --picture why.svg --set wall_length_min=1.5 road/frames\n"
      "  pose_wall explain -c road/pose_wall.yaml -n 12 --json road/frames | jq '.gates[] | select(.passed | not)'\n"
      "  pose_wall explain --gates | less\n"
      "The frames before it are measured as well: what is held and smoothed hangs on them. Then it is computed twice, "
      "by\n"
      "the engine that is delivered and by one that takes notes; both give the same bits, or there is no explanation.\n"
      "Exit status: 0 done, 1 the frame could not be read or the picture not written, 2 bad usage or config,\n"
      "130 interrupted by Ctrl-C.");
  verb->callback(
      [options, &exit_code] { exit_code = done_or_complaint("explain", [&] { return explain_frame(*options); }); });
}

}  // namespace pose_wall::tools
