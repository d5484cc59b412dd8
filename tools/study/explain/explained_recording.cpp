// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/explained_recording.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "io/language/language.hpp"
#include "io/picture/frame_picture.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "study/explain/amounts.hpp"
#include "study/explain/prose.hpp"
#include "study/results/frame_runner.hpp"

namespace pose_wall::tools::explain {
namespace {

std::string picture_of(const RecordingRun& run, const pose_wall_points& points, const Explained& explained,
                       std::uint64_t frame) {
  std::vector<std::string> parts = {say("frame {}", frame)};
  for (const Paragraph& p : explained.explanation.paragraphs) {
    const bool of_frame = p.subject == POSE_WALL_TRACE_FRAME;
    parts.push_back(say("{} {}", of_frame ? tr("itself") : subject_words(p.subject), acceptance_words(p.acceptance)));
  }
  return picture::frame_picture({run.loaded.config.get(), &explained.traced->result, &points,
                                 tr("pose_wall: why this frame came out as it did"), in_a_row(parts)});
}

Explained explained_of(const RecordingRun& run, TracedFrame traced, const RivalsSeen& rivals,
                       const pose_wall_points& points, std::uint64_t frame) {
  Explained out;
  out.traced = std::move(traced);
  out.explanation = explain_frame(*run.loaded.config.get(), out.traced->result, *out.traced->trace, rivals);
  if (run.wants_picture) out.picture = picture_of(run, points, out, frame);
  return out;
}

void expect_same_bits(const Explained& explained) {
  if (!explained.outcome.result || same_bits(*explained.outcome.result, explained.traced->result)) return;
  throw std::runtime_error(
      tr("the engine that takes notes gave another result; please report this, for its notes are worthless"));
}

void tell_unreadable(ProgressBar& bar, const FrameOutcome& outcome) {
  if (!outcome.result) bar.print_above(fmt::format("pose_wall explain: {}: {}", outcome.source, outcome.error));
}

}  // namespace

std::optional<Explained> explain_one(const RecordingRun& run, FrameSequence& inputs, std::uint64_t frame) {
  FrameRunner runner(run.loaded.config, run.rate_hz, run.loaded.motion);
  ProgressBar bar(static_cast<std::size_t>(frame) + 1, run.shows_progress);
  RivalsSeen rivals;
  for (std::uint64_t i = 0; !InterruptWatch::is_interrupted(); ++i) {
    std::optional<SourcedFrame> sourced = inputs.next();
    if (!sourced) throw std::runtime_error(say("the input ended before frame {}", frame));
    if (i == frame) {
      const Memento before = memento_of(runner.engine());
      Explained out;
      FrameOutcome outcome = runner.run(std::move(*sourced), [&](const auto& cloud, const auto& points, const auto&) {
        out = explained_of(run, trace_frame(run.loaded.config, before, cloud), rivals, points, frame);
      });
      out.outcome = std::move(outcome);
      expect_same_bits(out);
      return out;
    }
    const FrameOutcome outcome = runner.run(std::move(*sourced));
    if (outcome.result) rivals.add(*outcome.result, i);
    tell_unreadable(bar, outcome);
    bar.advance(outcome.source);
  }
  return std::nullopt;
}

ExplainedRecording explain_all(const RecordingRun& run, FrameSequence& inputs) {
  ExplainedRecording all{RecordingSummary(*run.loaded.config.get()), std::nullopt, false};
  FrameRunner runner(run.loaded.config, run.rate_hz, run.loaded.motion);
  ProgressBar bar(inputs.frames(), run.shows_progress);
  RivalsSeen rivals;
  for (std::uint64_t i = 0; !(all.interrupted = InterruptWatch::is_interrupted()); ++i) {
    std::optional<SourcedFrame> sourced = inputs.next();
    if (!sourced) break;
    const Memento before = memento_of(runner.engine());
    std::optional<Explained> worst;
    FrameOutcome outcome =
        runner.run(std::move(*sourced), [&](const auto& cloud, const auto& points, const pose_wall_result& result) {
          const bool is_worst = all.summary.is_worst(result);
          if (!is_worst && !all.summary.is_new(result)) return;
          TracedFrame traced = trace_frame(run.loaded.config, before, cloud);
          all.summary.add_notes(result, *traced.trace);
          if (is_worst) worst = explained_of(run, std::move(traced), rivals, points, i);
        });
    if (outcome.result) rivals.add(*outcome.result, i);
    tell_unreadable(bar, outcome);
    bar.advance(outcome.source);
    all.summary.add(outcome);
    if (!worst || !outcome.result) continue;
    worst->outcome = std::move(outcome);
    expect_same_bits(*worst);
    all.worst = std::move(worst);
  }
  return all;
}

}  // namespace pose_wall::tools::explain
