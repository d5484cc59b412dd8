// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/box/box_replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "io/box/mapped_file.hpp"
#include "pose_wall.hpp"
#include "pose_wall_box.h"
#include "pose_wall_runtime.h"

namespace pose_wall::tools {
namespace {

// Where these stand: pose_wall_box.h.
constexpr std::uint64_t kAtHeaderRun = 4084, kAtRun = 56, kAtLap = 58, kHeadBytes = 64;

struct Event {
  pose_wall_box_record record;
  std::uint64_t end;
  std::uint16_t lap;
};
using Events = std::vector<Event>;

struct DamagedRecord {
  std::uint16_t run, lap;
};

struct Found {
  std::uint32_t run = 0;  // the header's
  Events events;          // the whole ones of that run, in the order of the file
  std::vector<DamagedRecord> damaged;
};

template <typename T>
T number_at(const MappedFile& file, std::uint64_t offset) {
  T number;
  std::memcpy(&number, static_cast<const unsigned char*>(file.data()) + offset, sizeof number);
  return number;
}

Found read_records(const MappedFile& file, BoxReplay* replay) {
  Found found;
  found.run = number_at<std::uint32_t>(file, kAtHeaderRun);
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
  // Once more as much as the file holds: enough for what a crash leaves behind, and forged heads do not hold it up.
  std::uint64_t to_read_again = file.size();
  pose_wall_box_record record;
  while (pose_wall_box_next(file.data(), file.size(), &offset, &record) == POSE_WALL_OK) {
    const auto run = number_at<std::uint16_t>(file, record.offset + kAtRun);
    const auto lap = number_at<std::uint16_t>(file, record.offset + kAtLap);
    const std::uint64_t bytes = offset - record.offset;
    if (record.damaged == POSE_WALL_BOX_WHOLE) {
      found.events.push_back({record, offset, lap});
    } else if (record.damaged == POSE_WALL_BOX_OTHER_RUN) {
      ++replay->of_other_runs;
    } else {
      found.damaged.push_back({run, lap});
    }
    if (record.damaged != POSE_WALL_BOX_OVERLAPPED) continue;
    if (bytes > to_read_again) {
      replay->not_searched += bytes;
    } else {
      to_read_again -= bytes;
      offset = record.offset + kHeadBytes;
    }
  }
  return found;
}

bool follows(std::uint16_t lap, std::uint16_t next) {
  return next == lap + 1 || (lap == 0xFFFFU && next == 1);
}

// From `begin` on, those that were written one behind the other.
std::size_t end_of_stretch(const Events& events, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < events.size() && events[end].lap == events[begin].lap &&
         events[end].record.sequence > events[end - 1].record.sequence) {
    ++end;
  }
  return end;
}

// What the ring holds without an overwritten lap in between: the newest lap, which stands at the beginning of the file,
// and behind it what remains of the lap before. Whatever follows them is left over from older laps that were longer.
struct Stretches {
  std::size_t newest_end = 0;  // in Found::events
  std::size_t before_end = 0;  // newest_end: nothing of the lap before
};

Stretches stretches_of(const Found& found) {
  Stretches s;
  if (found.events.empty()) return s;
  s.newest_end = s.before_end = end_of_stretch(found.events, 0);
  if (s.newest_end == found.events.size()) return s;
  const Event& first = found.events.front();
  const std::size_t end = end_of_stretch(found.events, s.newest_end);
  const Event& last = found.events[end - 1];
  const bool is_lap_before = follows(last.lap, first.lap) && last.record.sequence < first.record.sequence;
  if (is_lap_before) s.before_end = end;
  return s;
}

std::uint64_t torn_bytes(const Events& events, std::size_t begin, std::size_t end) {
  std::uint64_t bytes = 0;
  for (std::size_t i = begin + 1; i < end; ++i) bytes += events[i].record.offset - events[i - 1].end;
  return bytes;
}

void look_for_gaps(const Found& found, std::uint64_t file_bytes, BoxReplay* replay) {
  const Events& events = found.events;
  const Stretches s = stretches_of(found);
  const std::uint16_t newest_lap = events.empty() ? 0 : events.front().lap;
  for (const DamagedRecord& record : found.damaged) {
    const bool counts =
        events.empty() || (record.run == found.run && (record.lap == newest_lap || follows(record.lap, newest_lap)));
    ++(counts ? replay->damaged : replay->damaged_of_old);
  }
  replay->left_over = events.size() - s.before_end;
  if (events.empty()) return;
  const std::size_t first = s.before_end > s.newest_end ? s.newest_end : 0;
  replay->first_sequence = events[first].record.sequence;
  replay->last_sequence = events[s.newest_end - 1].record.sequence;
  // In this order: they rise, so nothing comes round.
  replay->missing = replay->last_sequence - replay->first_sequence - (s.before_end - 1);
  replay->torn = events.front().record.offset - POSE_WALL_BOX_HEADER_BYTES + torn_bytes(events, 0, s.newest_end) +
                 torn_bytes(events, s.newest_end, s.before_end);
  if (newest_lap != 0) return;  // it came round
  replay->missing += replay->first_sequence;
  // Behind the last record there is nothing, unless it is what was there before.
  const bool is_alone = replay->left_over + replay->of_other_runs + replay->damaged_of_old == 0;
  if (is_alone) replay->torn += file_bytes - events[s.before_end - 1].end;
}

void note_motion(const pose_wall_motion_result& motion, BoxMotion* out) {
  ++out->frames;
  if (motion.along_state < out->of_state.size()) ++out->of_state[motion.along_state];
  if (!std::isfinite(motion.along_m)) return;
  if (!out->has_travel) out->first_m = motion.along_m;
  out->last_m = motion.along_m;
  out->has_travel = true;
}

BoxEvent event_of(const pose_wall_box_record& record, BoxReplay* replay) {
  pose_wall_result recorded;
  std::memcpy(&recorded, record.result, sizeof recorded);
  BoxEvent event{record.sequence, recorded.frame_index, record.stamp_ns, record.received_ns, record.kind, "", {}};
  if (record.motion != nullptr) {
    event.motion.emplace();
    std::memcpy(&*event.motion, record.motion, sizeof *event.motion);
    note_motion(*event.motion, &replay->motion);
  }
  return event;
}

// In one word.
std::string compute(const pose_wall_box_record& record, pose_wall_engine* engine, BoxReplay* replay) {
  pose_wall_result recorded, computed = api::make_result();
  std::memcpy(&recorded, record.result, sizeof recorded);
  const std::int32_t status = pose_wall_box_compute(&record, engine, &computed);
  if (status == POSE_WALL_BOX_E_EMPTY) {
    ++replay->digests_only;
    return "digest";
  }
  if (status != POSE_WALL_OK) {
    ++replay->refused;
    return "refused";
  }
  if (const auto difference = first_difference(recorded, computed)) {
    ++replay->different;
    if (!replay->first) replay->first = {record.sequence, recorded.frame_index, recorded.stamp_ns, *difference};
    return "different";
  }
  ++replay->equal;
  return "same";
}

void count(const Events& events, BoxReplay* replay) {
  replay->records = events.size();
  for (const Event& event : events) {
    replay->frames += event.record.kind == POSE_WALL_BOX_FRAME ? 1 : 0;
    replay->silences += event.record.kind == POSE_WALL_BOX_SILENCE ? 1 : 0;
    replay->thinned += event.record.thinning > 1 ? 1 : 0;
    replay->with_inputs += event.record.inputs != nullptr ? 1 : 0;
  }
}

// A box of another format is told by both formats, and by the library that can read it.
std::string why_not(const MappedFile& file, std::int32_t status) {
  std::uint32_t format = 0;
  char version[24] = {};
  const bool other = status == POSE_WALL_BOX_E_VERSION &&
                     pose_wall_box_written_by(file.data(), file.size(), &format, version) == POSE_WALL_OK;
  if (!other) return pose_wall_runtime_status_text(status);
  return fmt::format(
      "recorded by pose_wall {} in format {}; this is pose_wall {}, which reads its own format {}: use "
      "the one that recorded it",
      version, format, pose_wall_version(), POSE_WALL_BOX_VERSION);
}

}  // namespace

BoxReplay replay_box(const std::string& path, const ReplayProgress& progress, const EventNotice& notice) {
  const MappedFile file(path);
  pose_wall_box_info info;
  std::int32_t status =
      file.size() > 0 ? pose_wall_box_open(file.data(), file.size(), &info) : std::int32_t{POSE_WALL_BOX_E_FORMAT};
  if (status != POSE_WALL_OK) throw std::runtime_error(path + ": " + why_not(file, status));
  std::uint64_t bytes = 0;
  status = pose_wall_memory_needed(&info.config, &bytes);
  if (status != POSE_WALL_OK) throw std::runtime_error(path + ": its config: " + pose_wall_status_text(status));
  struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
    unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
  };
  std::vector<Line> block(bytes / sizeof(Line) + 1);
  pose_wall_engine* engine = nullptr;
  status = pose_wall_open(&info.config, block.data(), block.size() * sizeof(Line), &engine);
  if (status != POSE_WALL_OK) throw std::runtime_error(path + ": " + pose_wall_status_text(status));

  BoxReplay replay;
  replay.version = info.version;
  Found found = read_records(file, &replay);
  look_for_gaps(found, file.size(), &replay);
  count(found.events, &replay);
  std::stable_sort(found.events.begin(), found.events.end(),
                   [](const Event& a, const Event& b) { return a.record.sequence < b.record.sequence; });
  for (std::size_t i = 0; i < found.events.size(); ++i) {
    BoxEvent event = event_of(found.events[i].record, &replay);
    event.computed = compute(found.events[i].record, engine, &replay);
    if (notice) notice(event);
    if (progress) progress(i + 1, found.events.size());
  }
  return replay;
}

}  // namespace pose_wall::tools
