// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "io/language/language.hpp"
#include "io/numbers/quantile.hpp"
#include "study/explain/amounts.hpp"
#include "study/explain/gate_list.hpp"
#include "study/explain/notes.hpp"
#include "study/explain/prose.hpp"
#include "study/truth/alert_limits.hpp"

namespace pose_wall::tools::explain {
namespace {

// Bounds of memory: 1.8 hours at 10 Hz have exact medians, and a page shows a small part of the stretches.
constexpr std::size_t kLevelsKept = 65536;
constexpr std::size_t kStretchesKept = 2000;
// Tracing a frame takes as long as measuring it.
constexpr std::size_t kTracedMax = 40;
constexpr std::size_t kStoriesToSee = 4;

// A level above it means that there is no bound, in rad or m.
bool is_level(double level) {
  constexpr double kMost = 1e6;
  return std::isfinite(level) && level < kMost;
}

void keep_longest(std::vector<Stretch>* stretches, std::size_t most) {
  if (stretches->size() <= most) return;
  std::stable_sort(stretches->begin(), stretches->end(),
                   [](const Stretch& a, const Stretch& b) { return a.frames() > b.frames(); });
  stretches->resize(most);
  std::sort(stretches->begin(), stretches->end(), [](const Stretch& a, const Stretch& b) { return a.first < b.first; });
}

void see(std::vector<FrameToSee>* all, std::uint64_t frame, const std::string& why) {
  const auto known = std::find_if(all->begin(), all->end(), [&](const FrameToSee& f) { return f.frame == frame; });
  if (known != all->end()) {
    known->why.push_back(why);
  } else {
    all->push_back({frame, {why}});
  }
}

}  // namespace

void ThinnedRow::add(double value) {
  if (seen_++ % stride_ != 0) return;
  kept_.push_back(value);
  if (kept_.size() < kLevelsKept) return;
  for (std::size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
  kept_.resize((kept_.size() + 1) / 2);
  stride_ *= 2;
}

double ThinnedRow::median() const {
  return quantile(kept_, 0.5);
}

std::size_t QuantitySummary::with_cause() const {
  return std::accumulate(largest.begin(), largest.end(), std::size_t{0});
}

std::uint32_t QuantitySummary::cause() const {
  const auto most = std::max_element(largest.begin(), largest.end());
  return *most == 0 ? std::uint32_t{POSE_WALL_PARTS} : static_cast<std::uint32_t>(most - largest.begin());
}

bool Badness::is_worse_than(const Badness& other) const {
  return states != other.states ? states < other.states : ratio > other.ratio;
}

RecordingSummary::RecordingSummary(const pose_wall_config& config) : alert_limit_{} {
  const AlertLimits limits = alert_limits_of(config);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) alert_limit_[q] = limit_of(q, limits);
}

Badness RecordingSummary::badness_of(const pose_wall_result& result) const {
  Badness out;
  out.frame = frames_;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& v = result.quantity[q];
    out.states += v.state;
    if (v.state == POSE_WALL_INVALID || !is_level(v.protection_level)) continue;
    const double ratio = v.protection_level / alert_limit_[q];
    if (!(ratio > out.ratio)) continue;
    out.ratio = ratio;
    out.widest = q;
  }
  return out;
}

bool RecordingSummary::is_new(const pose_wall_result& result) const {
  if (traced_ >= kTracedMax) return false;
  const Story story = story_of(result);
  const bool has_new_reason = (all_reasons(result) & ~traced_reasons_) != 0;
  return has_new_reason || stories_.find({story.kind, story.subjects}) == stories_.end();
}

bool RecordingSummary::is_worst(const pose_wall_result& result) const {
  return !worst_ || badness_of(result).is_worse_than(*worst_);
}

void RecordingSummary::add_notes(const pose_wall_result& result, const pose_wall_trace& trace) {
  ++traced_;
  traced_reasons_ |= all_reasons(result);
  for (const Note& note : Notes(trace).all()) {
    if (note.passed()) continue;
    for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
      std::vector<std::uint32_t>& gates = reasons_[bit].gates;
      const auto place = std::lower_bound(gates.begin(), gates.end(), note.gate.gate);
      const bool is_known = place != gates.end() && *place == note.gate.gate;
      if ((note.info.reasons >> bit & 1U) != 0 && !is_known) gates.insert(place, note.gate.gate);
    }
  }
}

void RecordingSummary::add_story(const Story& story) {
  StorySummary& known = stories_[{story.kind, story.subjects}];
  if (known.frames++ == 0) {
    known.story = story;
    known.first = frames_;
  }
  known.story.merge(story);
  Stretch* const last = stretches_.empty() ? nullptr : &stretches_.back();
  if (last != nullptr && last->last + 1 == frames_ && last->story.shares_reasons(story)) {
    last->last = frames_;
    last->story.merge(story);
    return;
  }
  if (stretches_.size() >= 2 * kStretchesKept) keep_longest(&stretches_, kStretchesKept);
  stretches_.push_back({frames_, frames_, story});
  ++stretch_count_;
}

void RecordingSummary::add(const FrameOutcome& outcome) {
  if (!outcome.result) {
    ++unreadable_;
    add_story(Story{});
    ++frames_;
    return;
  }
  const pose_wall_result& result = *outcome.result;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& v = result.quantity[q];
    ++quantities_[q].states[std::min<std::uint32_t>(v.state, POSE_WALL_VALID)];
    if (v.state == POSE_WALL_INVALID) continue;
    quantities_[q].levels.add(v.protection_level);
    if (v.cause < POSE_WALL_PARTS) ++quantities_[q].largest[v.cause];
  }
  const std::uint32_t reasons = all_reasons(result);
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) reasons_[bit].frames += reasons >> bit & 1U;
  const Badness bad = badness_of(result);
  if (!worst_ || bad.is_worse_than(*worst_)) worst_ = bad;
  if (!widest_ || bad.ratio > widest_->ratio) widest_ = bad;
  add_story(story_of(result));
  ++frames_;
}

std::vector<StorySummary> RecordingSummary::stories() const {
  std::vector<StorySummary> all;
  for (const auto& [key, known] : stories_) all.push_back(known);
  std::stable_sort(all.begin(), all.end(), [](const StorySummary& a, const StorySummary& b) {
    return a.frames != b.frames ? a.frames > b.frames : a.first < b.first;
  });
  return all;
}

std::vector<Stretch> RecordingSummary::longest_stretches(std::size_t most) const {
  std::vector<Stretch> longest = stretches_;
  keep_longest(&longest, most);
  return longest;
}

std::vector<FrameToSee> frames_to_see(const RecordingSummary& summary) {
  std::vector<FrameToSee> all;
  if (!summary.worst()) return all;
  see(&all, summary.worst()->frame, tr("the worst, by the lowest states and then the largest level over its limit"));
  const Badness& widest = *summary.widest();
  if (widest.widest < POSE_WALL_QUANTITIES) {
    see(&all, widest.frame,
        say("the largest level over its limit: {} at {:.1f} times the alert limit",
            pose_wall_quantity_name(widest.widest), widest.ratio));
  }
  std::size_t told = 0;
  for (const StorySummary& s : summary.stories()) {
    if (s.story.kind == StoryKind::kValid || s.story.kind == StoryKind::kUnreadable) continue;
    if (told++ == kStoriesToSee) break;
    see(&all, s.first,
        s.frames == 1 ? say("the only frame with: {}", story_words(s.story))
                      : say("the first of {}: {}", frames_text(s.frames), story_words(s.story)));
  }
  return all;
}

}  // namespace pose_wall::tools::explain
