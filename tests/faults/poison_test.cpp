// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: whichever frame of a good sequence is replaced by garbage of whichever kind, alone or with the next one, what
// is told meanwhile keeps to its levels, nothing valid is told of clouds that show no road, and the engine is back as
// promised: the frame after it is measured, and within kBackWithin frames all that was valid is valid. The machine
// moves. Does not prove: anything of clouds that are another road (undetectable_test.cpp).

#include <random>
#include <vector>

#include "fault_room.hpp"
#include "support/garbage.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

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
      pose_wall_save(engine.get(), memento.data(), memento.size());
      mementos.push_back(memento);
      states.push_back(states_of(engine.process(cloud_of(frames[i], stamps_ns[i]))));
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
  std::vector<std::string> states;
};

const Sequence& sequence() {
  static const Sequence made;
  return made;
}

struct Poison {
  const char* name;
  bool shows_a_road;  // a part of it, so that something may be valid
  Garbler garble;
};

void PrintTo(const Poison& p, std::ostream* out) {
  *out << p.name;
}

const Poison kPoisons[] = {
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
};

class PoisonedSequence : public ::testing::TestWithParam<std::tuple<Poison, std::uint32_t>> {};

// The run before the poison is the same for all: it is loaded.
TEST_P(PoisonedSequence, IsNeverMisleadingAndComesBack) {
  const Sequence& s = sequence();
  const auto& [poison, in_a_row] = GetParam();
  for (std::uint32_t k = 1; k + in_a_row <= kFrames; ++k) {
    EngineUnderTest engine(s.config);
    ASSERT_EQ(pose_wall_load(engine.get(), s.mementos[k].data(), s.mementos[k].size()), POSE_WALL_OK);
    std::mt19937 random(k);
    std::uint32_t i = k;
    for (; i < k + in_a_row; ++i) {
      Points points = s.frames[i];
      poison.garble(&points, &random);
      const pose_wall_result r = engine.process(cloud_of(points, s.stamps_ns[i]));
      EXPECT_EQ(broken_contract(r, limits_of(s.config)), "") << "frame " << i;
      EXPECT_EQ(s.wrong(r, i), "") << "frame " << i << " " << states_of(r);
      if (!poison.shows_a_road) {
        EXPECT_EQ(valid_from_garbage(r), "") << "frame " << i;
      }
    }
    int after = 0;
    for (bool back = false; !back && after < kBackWithin; ++after, ++i) {
      const pose_wall_result r = engine.process(cloud_of(s.frames[i], s.stamps_ns[i]));
      EXPECT_EQ(s.wrong(r, i), "") << "frame " << i << " " << states_of(r);
      if (after == 0) {
        EXPECT_TRUE(matches(states_of(r), "L")) << "frame " << i << " " << states_of(r);
      }
      back = states_of(r) == s.states[i];
      EXPECT_TRUE(back || after + 1 < kBackWithin) << "frame " << i << " " << states_of(r) << ", not " << s.states[i];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, PoisonedSequence,
                         ::testing::Combine(::testing::ValuesIn(kPoisons), ::testing::Values(1U, 2U)),
                         [](const auto& test) {
                           return name_of(std::get<0>(test.param).name) +
                                  (std::get<1>(test.param) == 1 ? "_once" : "_twice");
                         });

TEST(PoisonedSequenceItself, IsGoodWithoutPoison) {
  for (const std::string& states : sequence().states) EXPECT_EQ(states, "VVVVVVV");
}

}  // namespace
}  // namespace pose_wall::test
