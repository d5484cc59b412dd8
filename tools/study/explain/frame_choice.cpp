// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/frame_choice.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <vector>

#include "io/frames/frame_stamps.hpp"
#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"
#include "io/terminal/did_you_mean.hpp"
#include "study/explain/prose.hpp"

namespace pose_wall::tools::explain {
namespace {

constexpr const char* kWorst = "worst";
constexpr std::int64_t kNsPerS = 1'000'000'000;
// A stamp farther outside the recording belongs to another one.
constexpr std::int64_t kOutside_ns = kNsPerS;

bool is_digits(const std::string& word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

struct Stamp {
  std::int64_t ns;
  bool since_first;
};

// By whole nanoseconds: a double of 1.7e9 s has steps of 240 ns.
std::optional<Stamp> read_stamp(std::string word) {
  constexpr std::size_t kSecondDigitsMax = 10;  // seconds since 1970 have ten digits until the year 2286
  constexpr std::size_t kFractionDigits = 9;    // of nanoseconds in a second
  constexpr std::size_t kNsDigitsMax = 19;      // of the greatest 64-bit number
  const bool since_first = !word.empty() && word[0] == '+';
  if (since_first) word.erase(0, 1);
  const std::size_t point = std::min(word.find('.'), word.size());
  const std::string whole = word.substr(0, point);
  std::string fraction = word.substr(std::min(point + 1, word.size()));
  if (!is_digits(whole) || !(fraction.empty() || is_digits(fraction))) return std::nullopt;
  const std::optional<std::int64_t> number = parse_number<std::int64_t>(whole);
  if (!number) return std::nullopt;
  const bool is_ns = point == word.size() && whole.size() > kSecondDigitsMax && whole.size() <= kNsDigitsMax;
  if (is_ns) return Stamp{*number, since_first};
  if (*number >= static_cast<std::int64_t>(std::pow(10.0, kSecondDigitsMax))) return std::nullopt;
  fraction.resize(kFractionDigits, '0');
  return Stamp{*number * kNsPerS + parse_number<std::int64_t>(fraction).value_or(0), since_first};
}

std::string seconds_text(std::int64_t ns) {
  return fmt::format("{}.{:03} s", ns / kNsPerS, std::abs(ns % kNsPerS) / 1'000'000);
}

// The whole name, or its end behind a '/'.
bool ends_in(const std::string& name, const std::string& wanted) {
  if (name.size() < wanted.size() || name.compare(name.size() - wanted.size(), wanted.size(), wanted) != 0)
    return false;
  return name.size() == wanted.size() || name[name.size() - wanted.size() - 1] == '/';
}

std::string last_part(const std::string& name) {
  return std::filesystem::path(name).filename().string();
}

class NameSearch {
 public:
  explicit NameSearch(std::string wanted) : wanted_(std::move(wanted)) {}

  void add(const std::string& name) {
    if (count_ == 0) first_ = name;
    last_ = name;
    if (ends_in(name, wanted_)) {
      if (matches_++ == 0) found_ = count_;
      if (matches_ <= 2) matched_.push_back(name);
    }
    const std::size_t distance = edit_distance(last_part(name), last_part(wanted_));
    if (distance < nearest_distance_) nearest_ = last_part(name);
    nearest_distance_ = std::min(nearest_distance_, distance);
    ++count_;
  }

  FoundFrame found() const {
    if (matches_ == 1) return {found_, say("{} is frame {}.", matched_[0], found_), false};
    if (matches_ > 1) {
      throw std::invalid_argument(say("--frame {}: {} frames have this name; more of the path tells them apart: {}",
                                      wanted_, matches_, listed(matched_)));
    }
    throw std::invalid_argument(
        say("--frame {}: no frame has this name{}; allowed: a number from 0 to {}, the name of a frame ({} to {}), "
            "worst",
            wanted_, did_you_mean(last_part(wanted_), {nearest_}), count_ - 1, last_part(first_), last_part(last_)));
  }

 private:
  std::string wanted_, first_, last_, nearest_;
  std::vector<std::string> matched_;
  std::uint64_t count_ = 0, found_ = 0, matches_ = 0;
  std::size_t nearest_distance_ = std::numeric_limits<std::size_t>::max();
};

class StampSearch {
 public:
  StampSearch(std::string word, double rate_hz) : word_(std::move(word)), wish_(*read_stamp(word_)), stamps_(rate_hz) {}

  void add(const SourcedFrame& frame) {
    const std::int64_t stamp_ns = stamps_.next(frame.stamp_ns);
    if (count_ == 0) {
      lowest_ns_ = highest_ns_ = stamp_ns;
      wanted_ns_ = wish_.since_first ? stamp_ns + wish_.ns : wish_.ns;
    }
    // Of a recording without stamps the CSV holds short ones: as it stands there, a number means nanoseconds.
    if (is_digits(word_) && parse_number<std::int64_t>(word_) == stamp_ns) wanted_ns_ = stamp_ns;
    lowest_ns_ = std::min(lowest_ns_, stamp_ns);
    highest_ns_ = std::max(highest_ns_, stamp_ns);
    const double off_s = seconds_between(wanted_ns_, stamp_ns);
    if (count_ == 0 || std::fabs(off_s) < std::fabs(off_s_)) {
      found_ = count_;
      off_s_ = off_s;
      stamp_ns_ = stamp_ns;
      name_ = frame.name;
    }
    ++count_;
  }

  FoundFrame found() const {
    if (wanted_ns_ < lowest_ns_ - kOutside_ns || wanted_ns_ > highest_ns_ + kOutside_ns) {
      throw std::invalid_argument(
          say("--stamp {}: the stamps of this recording run from {} to {}; +SECONDS counts from "
              "the first frame",
              word_, seconds_text(lowest_ns_), seconds_text(highest_ns_)));
    }
    return {found_, say("The nearest stamp is {}, {:+.3f} s off: frame {} ({}).", seconds_text(stamp_ns_), off_s_,
                        found_, name_)};
  }

 private:
  std::string word_, name_;
  Stamp wish_;
  FrameStamps stamps_;
  std::uint64_t count_ = 0, found_ = 0;
  std::int64_t wanted_ns_ = 0, lowest_ns_ = 0, highest_ns_ = 0, stamp_ns_ = 0;
  double off_s_ = 0.0;
};

FoundFrame numbered(const std::string& word, std::size_t frames) {
  const std::optional<std::uint64_t> number = parse_number<std::uint64_t>(word);
  if (number && *number < frames) return {*number, "", false};
  throw std::invalid_argument(frames == 1 ? say("--frame {}: there is 1 frame, number 0", word)
                                          : say("--frame {}: there are {} frames, 0 to {}", word, frames, frames - 1));
}

}  // namespace

ChoiceKind kind_of(const FrameChoice& choice) {
  if (!choice.stamp.empty()) return ChoiceKind::kStamp;
  if (choice.frame.empty()) return ChoiceKind::kRecording;
  if (choice.frame == kWorst) return ChoiceKind::kWorst;
  return is_digits(choice.frame) ? ChoiceKind::kNumber : ChoiceKind::kName;
}

std::string stamp_fault(const std::string& word) {
  if (read_stamp(word)) return "";
  return say(
      "'{}' is no stamp; allowed: seconds (1690000000.25), nanoseconds as in the CSV, or +SECONDS "
      "since the first frame",
      word);
}

std::optional<FoundFrame> find_frame(const FrameChoice& choice, FrameSequence& frames, double rate_hz,
                                     const std::function<bool(const std::string&)>& step) {
  if (frames.frames() == 0) throw std::runtime_error(tr("no frame to explain"));
  const ChoiceKind kind = kind_of(choice);
  if (kind == ChoiceKind::kNumber) return numbered(choice.frame, frames.frames());
  NameSearch names(choice.frame);
  if (kind == ChoiceKind::kName && frames.files().size() == frames.frames()) {  // each a file
    for (const std::filesystem::path& file : frames.files()) names.add(file.string());
    return names.found();
  }
  std::optional<StampSearch> stamps;
  if (kind == ChoiceKind::kStamp) stamps.emplace(choice.stamp, rate_hz);
  while (const std::optional<SourcedFrame> frame = frames.next()) {
    if (stamps) {
      stamps->add(*frame);
    } else {
      names.add(frame->name);
    }
    if (!step(frame->name)) return std::nullopt;
  }
  FoundFrame found = stamps ? stamps->found() : names.found();
  found.read_frames = true;
  return found;
}

}  // namespace pose_wall::tools::explain
