// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every verb ends with 130 after Ctrl-C, also where it came before the first result, and then leaves no file
// that looks like a result; verbs that read frames end with the frame at work, and say so. Nothing here hangs on time:
// Ctrl-C has come before the verb begins, or comes while the verb waits for somebody to read its complaints.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "interrupted_child.hpp"
#include "io/terminal/interrupt.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::size_t kSound = 2, kBroken = 2000;  // frames

// What verbs begin with: two frames, their truth, what `run` and `map` made of them, and a file that is no frame.
struct Begun {
  TempFolder folder;
  std::string frames = folder.file("road/frames");
  std::string truth = folder.file("road/truth.csv");
  std::string config = folder.file("road/pose_wall.yaml");
  std::string results = folder.file("results.csv");
  std::string map = folder.file("map");

  Begun() {
    EXPECT_EQ(command({"sim", "--sensor", "vlp16", "-n", "2", "-q", "-o", folder.file("road")}).exit_status, 0);
    EXPECT_EQ(command({"run", "-q", "-c", config, "-o", results, frames}).exit_status, 0);
    EXPECT_EQ(command({"map", "-q", "-c", config, "-o", map, frames}).exit_status, 0);
    folder.write("broken.pcd", "this is no cloud");
  }

  // A command line of so many frames that the complaints fill every pipe.
  std::vector<std::string> long_line(std::vector<std::string> words) const {
    for (const char* name : {"000000.pcd", "000001.pcd"}) words.push_back(frames + "/" + name);
    words.insert(words.end(), kBroken, folder.file("broken.pcd"));
    return words;
  }
};

struct VerbCase {
  std::vector<std::string> words;
  std::string absent;  // a result that it must not leave behind; empty: it writes none
};

std::vector<VerbCase> cases_of(const Begun& begun) {
  const auto file = [&begun](const char* name) { return begun.folder.file(name); };
  const std::string& frames = begun.frames;
  return {
      {{"run", "-q", "-o", file("o.csv"), "--annotate", file("labelled"), frames}, file("labelled/000000.pcd")},
      {{"motion", "-q", "-o", file("m.csv"), frames}, ""},
      {{"scan", "-q", "-c", begun.config, "-o", file("s.csv"), "--picture", file("s.svg"), frames}, file("s.svg")},
      {{"map", "-q", "-c", begun.config, "-o", file("m"), "--poses", file("m.tum"), frames}, file("m/map.yaml")},
      {{"localise", "-q", begun.map, "-c", begun.config, "-o", file("l"), frames}, file("l/localise.csv")},
      {{"plan", "-q", begun.map, "--from", "0,0,0", "--to", "1,0,0"}, ""},
      {{"drive", "-q", "-o", file("d")}, file("d/drive.csv")},
      {{"doctor", "-o", file("doctor.yaml"), frames}, file("doctor.yaml")},
      {{"sim", "-q", "-o", file("sim")}, file("sim/frames/000000.pcd")},
      {{"demo", "-q", "-o", file("demo")}, file("demo/demo.svg")},
      {{"report", "-q", "-o", file("r.html"), frames}, file("r.html")},
      {{"info", frames}, ""},
      {{"evidence", "-q", frames, "-o", file("evidence.zip")}, file("evidence.zip")},
      {{"eval", "-c", begun.config, "--frames", frames, "--range-noise", "0.02", begun.results, begun.truth}, ""},
      {{"campaign", "-q", "--size", "small", "-o", file("card")}, file("card/card.md")},
      {{"replay-box", "-q", file("broken.pcd")}, ""},
      {{"explain", "-q", frames}, ""},
      {{"check-config", begun.config}, ""},
      {{"completion", "bash"}, ""},
      {{"man"}, ""},
  };
}

TEST(InterruptedVerbs, BeforeTheFirstResultEachExitsWith130) {
  const Begun begun;
  const InterruptWatch watch;
  ASSERT_EQ(std::raise(SIGINT), 0);
  std::set<std::string> tried;
  for (const VerbCase& verb : cases_of(begun)) {
    const Ran ran = command(verb.words);
    EXPECT_EQ(ran.exit_status, 130) << verb.words.front() << ": " << ran.errors;
    EXPECT_FALSE(std::filesystem::exists(verb.absent)) << verb.absent;
    tried.insert(verb.words.front());
  }
  for (const VerbGrammar& verb : command_grammar().verbs) EXPECT_EQ(tried.count(verb.name), 1U) << verb.name;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(begun.folder.path())) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

TEST(InterruptedVerbs, BadUsageStaysBadUsage) {
  const InterruptWatch watch;
  ASSERT_EQ(std::raise(SIGINT), 0);
  EXPECT_EQ(command({"run", "--no-such-word"}).exit_status, 2);
  EXPECT_EQ(command({"run", "-s", "yaw_max_deg=much", "x.pcd"}).exit_status, 2);
}

TEST(InterruptedVerbs, AnInterruptIsForgottenByTheNextCommand) {
  const TempFolder folder;
  {
    const InterruptWatch watch;
    ASSERT_EQ(std::raise(SIGINT), 0);
    EXPECT_TRUE(InterruptWatch::is_interrupted());
  }
  EXPECT_EQ(command({"completion", "bash"}).exit_status, 0);
}

TEST(InterruptedVerbs, WithResultsTheyEndAtTheFrameAtWork) {
  const Begun begun;
  const auto file = [&begun](const char* name) { return begun.folder.file(name); };
  struct Reading {
    std::vector<std::string> words;
    std::string told;    // on stderr
    std::string result;  // is there
  };
  const std::string of_scans = fmt::format("interrupted after {} of {} scans", kSound, kSound + kBroken);
  const Reading readings[] = {
      {{"run", "-q", "-o", file("o.csv")}, "interrupted after ", file("o.csv")},
      {{"motion", "-q", "-o", file("m.csv"), "--map", file("m.ply")}, "interrupted after ", file("m.ply")},
      {{"scan", "-q", "-c", begun.config, "-o", file("s.csv")}, "interrupted after 2 scans, each whole", file("s.csv")},
      {{"map", "-q", "-c", begun.config, "-o", file("m"), "--poses", file("m.tum")}, of_scans, file("m.tum")},
      {{"localise", "-q", begun.map, "-c", begun.config, "-o", file("l")}, of_scans, file("l/localise.csv")},
      {{"report", "-q", "-o", file("r.html")}, "interrupted: the report shows ", file("r.html")},
      {{"explain", "-q"}, "interrupted: the digest is of the first ", ""},
  };
  for (const Reading& reading : readings) {
    const Ended ended =
        interrupted_when_told(begun.long_line(reading.words), Stream::kError, "broken.pcd", file("printed"));
    const std::string verb = reading.words.front();
    EXPECT_EQ(ended.exit_status, 130) << verb;
    EXPECT_TRUE(contains(ended.text, reading.told)) << verb << ": " << ended.text.substr(0, 2000);
    EXPECT_TRUE(reading.result.empty() || std::filesystem::exists(reading.result)) << reading.result;
  }
  EXPECT_EQ(std::filesystem::exists(file("m/map.yaml")), true);
  const std::string poses = text_of(file("m.tum"));
  EXPECT_EQ(static_cast<std::size_t>(std::count(poses.begin(), poses.end(), '\n')), kSound);
  EXPECT_TRUE(contains(text_of(file("r.html")), "</html>"));
}

}  // namespace
}  // namespace pose_wall::tools
