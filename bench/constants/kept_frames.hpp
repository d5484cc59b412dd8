// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// In the copy that sweep.py makes, a frame is simulated once and read from a file afterwards: the frames of all values
// are the same, and to simulate them takes two thirds of a campaign's time. No part of what is delivered.

#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "io/csv/truth_csv.hpp"
#include "lab/campaign/plan.hpp"
#include "lab/sim/simulator.hpp"

namespace pose_wall::tools::campaign {

template <typename T>
void keep(std::ofstream& out, std::size_t count, const T* values) {
  out.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(sizeof(T) * count));
}

template <typename T>
void take(std::ifstream& in, std::size_t count, T* values) {
  in.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(sizeof(T) * count));
}

// Stands for the run's simulator. What the engine gets of a frame and its truths are kept; of labels and columns the
// number alone. POSE_WALL_FRAMES names the folder.
class KeptRun {
 public:
  explicit KeptRun(const Run& run) : run_(run), setup_(setup_of(run)) {}

  const sim::Setup& setup() const { return setup_; }
  const TruthRow& truth(std::uint32_t) const { return truth_; }  // of the frame rendered last
  const TruthRow& surveyed_truth(std::uint32_t) const { return surveyed_; }

  sim::Frame render(std::uint32_t frame) {
    const std::string scans = setup_.sequence.scan_s > 0.0 ? "turning" : "instant";
    const std::string file = std::string(std::getenv("POSE_WALL_FRAMES")) + "/" + run_.scene + "-" + run_.sensor + "-" +
                             std::to_string(run_.seed) + "-" + scans + "-" + std::to_string(frame);
    sim::Frame kept;
    if (read(file, &kept)) return kept;
    if (!simulator_) simulator_.emplace(setup_, run_.seed);
    kept = simulator_->render(frame);
    truth_ = simulator_->truth(frame);
    surveyed_ = simulator_->surveyed_truth(frame);
    write(file + ".part", kept);
    std::filesystem::rename(file + ".part", file);  // whole or not at all
    return kept;
  }

 private:
  bool read(const std::string& file, sim::Frame* kept) {
    std::ifstream in(file, std::ios::binary);
    std::uint64_t count = 0;
    take(in, 1, &count);
    take(in, 1, &kept->stamp_ns);
    take(in, truth_.value.size(), truth_.value.data());
    take(in, surveyed_.value.size(), surveyed_.value.data());
    if (!in) return false;
    kept->labels.resize(count);
    kept->xyz_intensity.resize(4 * count);
    kept->time_ns.resize(count);
    kept->ring.resize(count);
    take(in, 4 * count, kept->xyz_intensity.data());
    take(in, count, kept->time_ns.data());
    take(in, count, kept->ring.data());
    return static_cast<bool>(in);
  }

  void write(const std::string& file, const sim::Frame& rendered) const {
    std::ofstream out(file, std::ios::binary);
    const std::uint64_t count = rendered.count();
    keep(out, 1, &count);
    keep(out, 1, &rendered.stamp_ns);
    keep(out, truth_.value.size(), truth_.value.data());
    keep(out, surveyed_.value.size(), surveyed_.value.data());
    keep(out, 4 * count, rendered.xyz_intensity.data());
    keep(out, count, rendered.time_ns.data());
    keep(out, count, rendered.ring.data());
  }

  Run run_;
  sim::Setup setup_;
  TruthRow truth_, surveyed_;
  std::optional<sim::Simulator> simulator_;  // where a frame is not kept yet
};

}  // namespace pose_wall::tools::campaign
