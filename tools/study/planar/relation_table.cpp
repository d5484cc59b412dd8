// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/relation_table.hpp"

#include <fmt/format.h>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/terminal/text_table.hpp"

namespace pose_wall::tools {
namespace {

void add(TextTable* table, const std::string& name, const RelationErrors& errors) {
  const ErrorSpread& move = errors.translation_m;
  const ErrorSpread& turn = errors.rotation_rad;
  if (errors.relations == 0) {
    table->add_row({name, "0"});
    return;
  }
  table->add_row({name, std::to_string(errors.relations), fmt::format("{:.4f} m", move.mean),
                  fmt::format("{:.4f} m", move.sigma), fmt::format("{:.3f} m", move.max), std::to_string(move.max_line),
                  fmt::format("{:.3f}°", turn.mean * kDegPerRad), fmt::format("{:.2f}°", turn.max * kDegPerRad)});
}

}  // namespace

std::string relation_table(const RelationReport& report) {
  TextTable table({tr("error by relations"), tr("number"), tr("mean"), tr("sigma"), tr("worst"), tr("in line"),
                   tr("mean turn"), tr("worst turn")});
  add(&table, say("near (< {:.0f} s)", kNearRelation_s), report.near);
  add(&table, tr("all"), report.all);
  std::string text = table.text();
  if (report.unmatched > 0) {
    text += say("{} relations have no pose within {:.2f} s: in no figure\n", report.unmatched, kRelationMatch_s);
  }
  return text;
}

}  // namespace pose_wall::tools
