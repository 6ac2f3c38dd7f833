// SPDX-License-Identifier: Apache-2.0
// The variables of Haas mills that have other numbers here.
#pragma once

#include <array>
#include <cstdint>

namespace trunnion::language {

/// `first` to `last` of a Haas control, which begin here at `here`: those of tools at the numbers that are
/// tools on every machine, whatever 040722 makes of #2500.
struct HaasVariables {
  std::uint32_t first;
  std::uint32_t last;
  std::uint32_t here;
  const char* meaning;
};

inline constexpr std::array haas_variables = {
    HaasVariables{2001, 2200, 11001, "tool length"},
    HaasVariables{2201, 2400, 10001, "tool length wear"},
    HaasVariables{2401, 2600, 13001, "tool diameter, or radius with 04c801 = 1"},
    HaasVariables{2601, 2800, 12001, "its wear"},
    HaasVariables{3000, 3004, 3000, "alarm, timers, suppression of single block and feed hold"},
    HaasVariables{3006, 3006, 3006, "stop with a message"},
    HaasVariables{3011, 3012, 3011, "date, time"},
    HaasVariables{3901, 3901, 3901, "parts"},
    HaasVariables{4001, 4003, 4001, "groups 1 to 3: motion, plane, G90 G91"},
    HaasVariables{4005, 4011, 4005,
                  "groups 5 to 11: feed, inch, compensation, length, cycle, level, scaling"},
    HaasVariables{4012, 4012, 4014, "group 12: work offset"},
    HaasVariables{4015, 4016, 4015, "groups 15 and 16: exact stop, rotation"},
    HaasVariables{4104, 4104, 4107, "D"},
    HaasVariables{4106, 4106, 4109, "F"},
    HaasVariables{4108, 4108, 4111, "H"},
    HaasVariables{4114, 4115, 4114, "N, O"},
    HaasVariables{4119, 4120, 4119, "S, T"},
    HaasVariables{5001, 5006, 5001, "end of the block before"},
    HaasVariables{5021, 5026, 5021, "position, machine coordinates"},
    HaasVariables{5041, 5046, 5041, "position, workpiece coordinates"},
    HaasVariables{5061, 5066, 5061, "where the skip signal came"},
    HaasVariables{5081, 5086, 5081, "tool length in force"},
    HaasVariables{5221, 5326, 5221, "G54 to G59, 20 apart"},
    HaasVariables{5401, 5500, 5401, "seconds of a tool at feed: 0, not counted"},
    HaasVariables{7001, 7386, 7001, "G154 P1 to P20, 20 apart"},
    HaasVariables{10100, 10199, 100, "as #100 .. #199"},
    HaasVariables{10500, 10699, 500, "as #500 .. #699"},
    HaasVariables{10800, 10999, 800, "as #800 .. #999"},
    HaasVariables{14001, 14946, 7001, "G154 P1 to P48, 20 apart"},
};

/// The number here of a variable of a Haas control, from 0; below 0 when this control does not have it.
constexpr double haas_system_number(double number) {
  constexpr double first_system = 1000;
  if (number < first_system) return number;
  for (const HaasVariables& range : haas_variables)
    if (number >= range.first && number <= range.last) return number - range.first + range.here;
  return -1;
}

}  // namespace trunnion::language
