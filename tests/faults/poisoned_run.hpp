// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A good sequence in which the machine moves, kinds of garbage for its frames, and a run of it from any frame on that
// is followed by the contract: what is held must have been told, and nothing gets surer while it is held.

#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "fault_room.hpp"
#include "support/garbage.hpp"
#include "support/moments.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::test {

constexpr std::uint32_t kFrames = 12;
using Garbler = void (*)(Points*, std::mt19937*);

// A road and its truth, made once; with what the engine remembered before each frame, and what it says without a fault.
struct Sequence {
  Sequence() : setup(sim::make_setup("clean", "vlp16", false, 1)), config(config_for(setup, sparse_config())) {
    const sim::Simulator simulator(setup, 1);
    EngineUnderTest engine(config);
    for (std::uint32_t i = 0; i < kFrames + kBackWithin + 2; ++i) {
      const sim::Frame frame = simulator.render(i);
      frames.push_back(points_of(frame));
      stamps_ns.push_back(frame.stamp_ns);
      truths.push_back(simulator.truth(i));
      std::vector<unsigned char> memento(pose_wall_memento_bytes());
      (void)pose_wall_save(engine.get(), nullptr, memento.data(), memento.size());
      mementos.push_back(memento);
      results.push_back(engine.process(cloud_of(frames[i], stamps_ns[i])));
      states.push_back(states_of(results[i]));
    }
  }

  std::string wrong(const pose_wall_result& r, std::uint32_t i) const {
    double truth[POSE_WALL_QUANTITIES];
    std::copy(std::begin(truths[i].value), std::end(truths[i].value), truth);
    return misleading(r, truth);
  }

  sim::SceneSetup setup;
  pose_wall_config config;
  std::vector<Points> frames;
  std::vector<std::int64_t> stamps_ns;
  std::vector<tools::TruthRow> truths;
  std::vector<std::vector<unsigned char>> mementos;
  std::vector<pose_wall_result> results;
  std::vector<std::string> states;
};

inline const Sequence& sequence() {
  static const Sequence made;
  return made;
}

struct Poison {
  const char* name;
  bool shows_a_road;  // a part of it, so that something may be valid
  Garbler garble;
  bool jumps = false;  // another road: the distances must be doubted
};

inline void PrintTo(const Poison& p, std::ostream* out) {
  *out << p.name;
}

inline const Poison kPoisons[] = {
    {"nothing", false, [](Points* p, auto*) { p->clear(); }},
    {"any_bits", false,
     [](Points* p, auto* random) {
       for (auto& q : *p) q = {any_bits(random), any_bits(random), any_bits(random)};
     }},
    {"scattered", false,
     [](Points* p, auto* random) {
       for (auto& q : *p) q = {within(random, 6), within(random, 6), within(random, 2)};
     }},
    {"one_point_many_times", false, [](Points* p, auto*) { std::fill(p->begin(), p->end(), p->front()); }},
    {"millimetres", false,
     [](Points* p, auto*) {
       for (auto& q : *p) q = {q[0] * 1000.0F, q[1] * 1000.0F, q[2] * 1000.0F};
     }},
    {"x_and_z_swapped", true,
     [](Points* p, auto*) {
       for (auto& q : *p) std::swap(q[0], q[2]);
     }},
    {"moved_by_a_step_of_x", true,
     [](Points* p, auto*) {
       for (std::size_t i = 0; i + 1 < p->size(); ++i) (*p)[i][0] = (*p)[i + 1][0];
     }},
    {"half_of_it_any_bits", true,
     [](Points* p, auto* random) {
       for (std::size_t i = 0; i < p->size(); i += 2) (*p)[i] = {any_bits(random), any_bits(random), any_bits(random)};
     }},
    {"cut_off_in_the_middle", true, [](Points* p, auto*) { p->resize(p->size() / 2); }},
    {"noise_of_20_cm", true,
     [](Points* p, auto* random) {
       for (auto& q : *p) q[0] += within(random, 0.3F), q[1] += within(random, 0.3F), q[2] += within(random, 0.3F);
     }},
    // Another road each: what is doubted as a jump.
    {"a_fifth_larger", true,
     [](Points* p, auto*) {
       for (auto& q : *p) q = {q[0] * 1.2F, q[1] * 1.2F, q[2] * 1.2F};
     },
     true},
    {"a_fifth_smaller", true,
     [](Points* p, auto*) {
       for (auto& q : *p) q = {q[0] * 0.8F, q[1] * 0.8F, q[2] * 0.8F};
     },
     true},
};

// The sequence from frame `first` on. The run before is the same for all: the engine is loaded, and the watch is told
// what it said.
class PoisonedRun {
 public:
  explicit PoisonedRun(std::uint32_t first)
      : s_(sequence()), engine_(s_.config), watch_(s_.config), frame_(first), random_(first) {
    const std::vector<unsigned char>& memento = s_.mementos[first];
    EXPECT_EQ(pose_wall_load(engine_.get(), &pose_wall::test::kSameClock, memento.data(), memento.size()),
              POSE_WALL_OK);
    for (std::uint32_t i = 0; i < first; ++i) EXPECT_EQ(watch_.processed(s_.results[i]), "");
  }

  std::uint32_t frame() const { return frame_; }

  void poisoned(const Poison& poison) {
    Points points = s_.frames[frame_];
    poison.garble(&points, &random_);
    const pose_wall_result r = process(points);
    for (std::uint32_t q = POSE_WALL_D_LF; poison.jumps && q < POSE_WALL_QUANTITIES; ++q) {
      const pose_wall_value& v = r.quantity[q];
      // A rival that was seen just before may reach as far as the jump.
      EXPECT_TRUE(v.state == POSE_WALL_DEGRADED &&
                  (v.reasons & (POSE_WALL_R_INNOVATION | POSE_WALL_R_WALL_AMBIGUOUS)) != 0)
          << pose_wall_quantity_name(q) << " of frame " << r.frame_index << ": " << states_of(r);
    }
    if (poison.shows_a_road) return;
    EXPECT_EQ(valid_from_garbage(r), "") << "frame " << r.frame_index;
  }

  // One good frame, the how-manieth after the last poisoned one. Whether all that was valid is valid again.
  bool good(int after) {
    const std::string& wanted = s_.states[frame_];
    const pose_wall_result r = process(s_.frames[frame_]);
    const std::string states = states_of(r);
    if (after == 1) {
      EXPECT_TRUE(matches(states, "L")) << "frame " << r.frame_index << " " << states;
    }
    const bool back = states == wanted;
    EXPECT_TRUE(back || after < kBackWithin) << "frame " << r.frame_index << " " << states << ", not " << wanted;
    return back;
  }

  void good_until_back() {
    for (int after = 1; after <= kBackWithin && !good(after); ++after) {
    }
  }

 private:
  pose_wall_result process(const Points& points) {
    const pose_wall_result r = engine_.process(cloud_of(points, s_.stamps_ns[frame_]));
    EXPECT_EQ(watch_.processed(r), "") << "frame " << frame_ << " " << states_of(r);
    EXPECT_EQ(s_.wrong(r, frame_), "") << "frame " << frame_ << " " << states_of(r);
    ++frame_;
    return r;
  }

  const Sequence& s_;
  EngineUnderTest engine_;
  ContractWatch watch_;
  std::uint32_t frame_;
  std::mt19937 random_;
};

}  // namespace pose_wall::test
