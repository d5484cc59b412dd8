// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Puts the frames of a campaign's runs through the motion library.

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "campaign/motion_record.hpp"
#include "campaign/runner.hpp"

namespace pose_wall::tools::campaign {

// A frame of the simulator as `pose_wall sim` writes it and `pose_wall motion` reads it: with the fields t and ring
// where the scan takes time.
Frame motion_frame(const sim::Frame& rendered, bool scan_takes_time);

// One run as the table in its file. `on_frame` is called after each frame.
std::string measure_motion(const Run& run, const EngineChoice& choice, const std::function<void()>& on_frame);

// Writes a record for each run. Throws as work_on does.
void run_all_motion(const std::vector<Run>& runs, const Work& work);

// Hands over all records there are, by class (in the order of the table), sensor and draw; one at a time, for those of
// a large campaign fill a memory. Throws std::runtime_error that names the file.
void for_each_motion_record(const std::filesystem::path& folder, const Manifest& manifest,
                            const std::function<void(const MotionRecord&)>& take);

}  // namespace pose_wall::tools::campaign
