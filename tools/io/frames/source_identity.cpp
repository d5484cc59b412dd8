// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/source_identity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

#include "io/language/language.hpp"
#include "io/terminal/counted.hpp"

namespace pose_wall::tools {
namespace {

// One thing that is told: the word before it, where there is one, and what it is.
struct IdentityPart {
  std::string_view word;
  std::string value;

  std::string text() const {
    const std::string_view shown = value.empty() ? "''" : std::string_view(value);
    return word.empty() ? std::string(shown) : fmt::format("{} {}", word, shown);
  }
};

bool is_port(const IdentityPart& part) {
  return part.word == "port" || part.word == "from port";
}

// The order is that in which people tell sensors apart.
std::vector<IdentityPart> parts_of(const SourceIdentity& who) {
  std::vector<IdentityPart> parts;
  if (!who.address.empty()) {
    parts.push_back({"", who.port != 0 ? fmt::format("{}:{}", who.address, who.port) : who.address});
  } else if (who.port != 0) {
    parts.push_back({"port", std::to_string(who.port)});
  }
  if (!who.mac.empty()) parts.push_back({"MAC", who.mac});
  if (!who.serial.empty()) parts.push_back({"serial", who.serial});
  if (who.frame_id) parts.push_back({"frame_id", *who.frame_id});
  if (who.lidar_id) parts.push_back({"lidar_id", std::to_string(*who.lidar_id)});
  if (who.from_port != 0 && who.from_port != who.port) parts.push_back({"from port", std::to_string(who.from_port)});
  return parts;
}

auto tied(const SourceIdentity& who) {
  return std::tie(who.address, who.port, who.from_port, who.mac, who.serial, who.frame_id, who.lidar_id);
}

}  // namespace

bool operator==(const SourceIdentity& a, const SourceIdentity& b) {
  return tied(a) == tied(b);
}

std::string SourceIdentity::text() const {
  std::vector<std::string> texts;
  for (const IdentityPart& part : parts_of(*this)) texts.push_back(part.text());
  return texts.empty() ? std::string(tr("a source that tells nothing of itself"))
                       : fmt::format("{}", fmt::join(texts, ", "));
}

bool SourceIdentity::is_named(std::string_view name) const {
  if (name.empty()) return false;
  if (name == address || name == text()) return true;
  const std::vector<IdentityPart> parts = parts_of(*this);
  return std::any_of(parts.begin(), parts.end(), [&](const IdentityPart& part) {
    return name == part.text() || (name == part.value && !is_port(part));
  });
}

std::string frame_id_of(std::string_view in_header) {
  return std::string(in_header.substr(in_header.rfind('/', 0) == 0 ? 1 : 0));
}

void SourceGate::hear(const SourceIdentity& from) {
  const auto known =
      std::find_if(heard_.begin(), heard_.end(), [&](const HeardSource& heard) { return heard.who == from; });
  if (known != heard_.end()) {
    ++known->count;
  } else if (heard_.size() < kSourcesNamed || from == chosen_) {
    heard_.push_back({from, 1});
  } else {
    ++others_;
  }
}

bool SourceGate::may_be(const SourceIdentity& from) const {
  if (chosen_) return from == *chosen_;
  return wanted_.empty() || from.is_named(wanted_);
}

bool SourceGate::decide(const SourceIdentity& from) {
  if (!may_be(from)) return false;
  if (!chosen_) chosen_ = from;
  return true;
}

std::uint64_t SourceGate::refused() const {
  std::uint64_t count = others_;
  for (const HeardSource& heard : heard_) {
    if (!may_be(heard.who)) count += heard.count;
  }
  return count;
}

std::string SourceGate::name_of(const SourceIdentity& who) const {
  for (const IdentityPart& part : parts_of(who)) {
    std::string name = part.text();
    const bool is_his = std::none_of(heard_.begin(), heard_.end(), [&](const HeardSource& heard) {
      return heard.who != who && heard.who.is_named(name);
    });
    if (is_his) return name;
  }
  return who.text();
}

std::string SourceGate::note(std::string_view where, std::string_view one, std::string_view chooser) const {
  if (!chosen_ || (heard_.size() < 2 && others_ == 0)) return "";
  const auto named = [&](std::string name, std::uint64_t count) {
    return one.empty() ? name : fmt::format("{} ({})", name, counted(count, one));
  };
  std::vector<std::string> refused;
  for (const HeardSource& heard : heard_) {
    if (heard.who != *chosen_) refused.push_back(named(name_of(heard.who), heard.count));
  }
  if (others_ > 0) refused.push_back(named(tr("further ones"), others_));
  const std::string sources = others_ > 0 ? fmt::format("{}+", heard_.size()) : std::to_string(heard_.size());
  const std::string space = where.empty() ? "" : fmt::format(" {}", where);
  return refused.size() == 1 ? say("{} sources{}: {} is read; {} is not; {} chooses", sources, space, name_of(*chosen_),
                                   refused.front(), chooser)
                             : say("{} sources{}: {} is read; {} are not; {} chooses", sources, space,
                                   name_of(*chosen_), fmt::join(refused, ", "), chooser);
}

std::string SourceGate::fault(std::string_view where, std::string_view one) const {
  if (wanted_.empty()) return "";
  std::vector<std::string> meant, there;
  for (const HeardSource& heard : heard_) {
    there.push_back(fmt::format("{} ({})", name_of(heard.who), counted(heard.count, one)));
    if (heard.who.is_named(wanted_)) meant.push_back(there.back());
  }
  if (meant.size() == 1) return "";
  const std::string space = where.empty() ? "" : fmt::format(" {}", where);
  if (meant.size() > 1) return say("--source {}: several{} are meant: {}", wanted_, space, fmt::join(meant, ", "));
  return say("--source {}: nobody{} is called this; there: {}", wanted_, space,
             there.empty() ? tr("none") : fmt::format("{}", fmt::join(there, ", ")));
}

}  // namespace pose_wall::tools
