// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The verbs of the command: each adds its options to the app and sets the exit code when it is called.

#pragma once

#include <CLI/CLI.hpp>

namespace pose_wall::tools {

// Exit codes of every verb.
constexpr int kExitDone = 0;
constexpr int kExitUnreadable = 1;     // an input could not be read, or a result not written
constexpr int kExitUsage = 2;          // bad usage or config
constexpr int kExitNotUsable = 3;      // doctor: no measurement; map: a bad fit; plan: no route; localise: no place
constexpr int kExitInterrupted = 130;  // as shells have it: 128 + SIGINT

void add_scan(CLI::App& app, int& exit_code);
void add_map(CLI::App& app, int& exit_code);
void add_localise(CLI::App& app, int& exit_code);
void add_plan(CLI::App& app, int& exit_code);
void add_drive(CLI::App& app, int& exit_code);
void add_doctor(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code);
void add_motion(CLI::App& app, int& exit_code);
void add_sim(CLI::App& app, int& exit_code);
void add_demo(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_info(CLI::App& app, int& exit_code);
void add_eval(CLI::App& app, int& exit_code);
void add_evidence(CLI::App& app, int& exit_code);
void add_campaign(CLI::App& app, int& exit_code);
void add_replay_box(CLI::App& app, int& exit_code);
void add_explain(CLI::App& app, int& exit_code);
void add_check_config(CLI::App& app, int& exit_code);
void add_completion(CLI::App& app, int& exit_code);
void add_man(CLI::App& app, int& exit_code);

}  // namespace pose_wall::tools
