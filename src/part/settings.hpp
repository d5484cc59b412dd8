// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Settings of a part, by the table of its public header: from a row follow its member's default, its range and the
// words of its fault. A part says where the table is, and its rules over several members:
//
//     constexpr SettingRow kRows[] = {
//     #define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_slam_settings, __VA_ARGS__)
//     #include "pose_wall_planar_slam_settings.def"
//     };
//     struct SlamTable : SettingsTable<pose_wall_planar_slam_settings> {
//       static SettingRows rows() { return rows_of(kRows); }
//     };
//     init_settings<SlamTable>(settings)    check_settings<SlamTable>(settings, fault)

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "base/containers/span.hpp"
#include "part/struct_sizes.hpp"

namespace pose_wall {

// What is refused, and why; static storage.
struct SettingFault {
  const char *member = nullptr, *rule = nullptr;
};

// A member: where it lies, whether it is a whole number, its default and its range.
struct SettingRow {
  std::size_t offset;
  bool is_count;
  double standard, least, most;
  SettingFault fault;
};
using SettingRows = Span<const SettingRow>;

template <std::uint32_t kRows>
SettingRows rows_of(const SettingRow (&rows)[kRows]) {
  return SettingRows(rows, kRows);
}

// A whole number that says no or yes: the range is told in other words.
template <typename Type>
constexpr bool is_switch(double least, double most) {
  return std::is_same<Type, std::uint32_t>::value && least == 0.0 && most == 1.0;
}

#define POSE_WALL_SETTING_ROW(Struct, type, name, standard, least, most, unit, help) \
  {offsetof(Struct, name),                                                           \
   std::is_same<type, std::uint32_t>::value,                                         \
   standard,                                                                         \
   least,                                                                            \
   most,                                                                             \
   {#name, ::pose_wall::is_switch<type>(least, most) ? #name " must be 0 or 1"       \
                                                     : #name " must be from " #least " to " #most}},

// What a part's own table derives from, so that its rules see members by their names.
template <typename Struct>
struct SettingsTable : Struct {
  using Settings = Struct;
  SettingsTable() : Struct{} {}
  explicit SettingsTable(const Struct& settings) : Struct(settings) {}
  // Defaults of members that stand in no row.
  void set_others() {}
  // The rule over several members that is broken, once all rows hold.
  SettingFault broken_rule() const { return {}; }
};

inline void put_standard(const SettingRow& row, void* settings) {
  unsigned char* const at = static_cast<unsigned char*>(settings) + row.offset;
  const auto count = static_cast<std::uint32_t>(row.is_count ? row.standard : 0.0);
  std::memcpy(at, row.is_count ? static_cast<const void*>(&count) : &row.standard,
              row.is_count ? sizeof(count) : sizeof(row.standard));
}

inline double value_at(const SettingRow& row, const void* settings) {
  const unsigned char* const at = static_cast<const unsigned char*>(settings) + row.offset;
  double number = 0.0;
  std::uint32_t count = 0;
  if (row.is_count) {
    std::memcpy(&count, at, sizeof(count));
    return static_cast<double>(count);
  }
  std::memcpy(&number, at, sizeof(number));
  return number;
}

template <typename Table>
typename Table::Settings default_settings() {
  Table table;
  typename Table::Settings& settings = table;
  settings.struct_size = sizeof(settings);
  for (const SettingRow& row : Table::rows()) put_standard(row, &settings);
  table.set_others();
  return settings;
}

template <typename Table>
std::int32_t init_settings(typename Table::Settings* settings) {
  if (settings == nullptr) return POSE_WALL_E_NULL;
  *settings = default_settings<Table>();
  return POSE_WALL_OK;
}

// Without a C library, which the archives do not ask for.
inline bool same_text(const char* a, const char* b) {
  while (*a != '\0' && *a == *b) ++a, ++b;
  return *a == *b;
}

// The first row or rule that the settings break; no member: none. A rule about the same member says more than its row.
template <typename Table>
SettingFault fault_of(const typename Table::Settings& settings) {
  const SettingFault rule = Table(settings).broken_rule();
  for (const SettingRow& row : Table::rows()) {
    const double value = value_at(row, &settings);
    if (value >= row.least && value <= row.most) continue;
    return rule.member != nullptr && same_text(rule.member, row.fault.member) ? rule : row.fault;
  }
  return rule;
}

// Fault: the library's own struct; it is written where a value is refused, unless it is NULL.
template <typename Table, typename Fault>
std::int32_t check_settings(const typename Table::Settings* settings, Fault* fault) {
  if (settings == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*settings); size != POSE_WALL_OK) return size;
  const SettingFault found = fault_of<Table>(*settings);
  if (found.member == nullptr) return POSE_WALL_OK;
  if (fault != nullptr) {  // member by member: on ARMv7 GCC keeps a pair in memory that could be written to
    fault->member = found.member;
    fault->rule = found.rule;
  }
  return POSE_WALL_E_VALUE_RANGE;
}

// The caller's settings, checked, or for NULL the defaults.
template <typename Table>
std::int32_t choose_settings(const typename Table::Settings* given, typename Table::Settings* chosen) {
  if (given == nullptr) return init_settings<Table>(chosen);
  const std::int32_t status = check_settings<Table>(given, static_cast<SettingFault*>(nullptr));
  if (status == POSE_WALL_OK) *chosen = *given;
  return status;
}

}  // namespace pose_wall
