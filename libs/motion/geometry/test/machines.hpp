// SPDX-License-Identifier: Apache-2.0
// The machines of the tests of this directory.
#pragma once

#include <ostream>
#include <vector>

#include "geometry/chain.hpp"

namespace trunnion::geometry {

inline Chain make(const ChainParameters& p) { return std::get<Chain>(Chain::make(p)); }

inline ChainParameters ac_table() {
  ChainParameters p;
  p.table_1 = RotaryAxis{Vec3(-1, 0, 0), Vec3(0, 0.1028, 0), 0};
  p.table_2 = RotaryAxis{Vec3(0, 0, -1), Vec3(-200.3605, -190.1897, -516.0118), 2};
  return p;
}

inline ChainParameters bc_table() {
  ChainParameters p;
  p.table_1 = RotaryAxis{Vec3(0, -1, 0), Vec3(0.05, 0, 0.1), 1};
  p.table_2 = RotaryAxis{Vec3(0, 0, -1), Vec3(120, -80, -450), 2};
  return p;
}

inline ChainParameters cb_head() {
  ChainParameters p;
  p.head_1 = RotaryAxis{Vec3(0, 0, 1), Vec3(1.5, -2.5, 0), 2};
  p.head_2 = RotaryAxis{Vec3(0, 1, 0), Vec3(0.2, 0, 251.3), 1};
  return p;
}

inline ChainParameters ca_head() {
  ChainParameters p;
  p.head_1 = RotaryAxis{Vec3(0, 0, 1), Vec3(0.4, 0.3, 0), 2};
  p.head_2 = RotaryAxis{Vec3(1, 0, 0), Vec3(0, -0.7, 230), 0};
  return p;
}

inline ChainParameters b_head_c_table() {
  ChainParameters p;
  p.head_2 = RotaryAxis{Vec3(0, 1, 0), Vec3(0.3, 0, 180), 1};
  p.table_2 = RotaryAxis{Vec3(0, 0, -1), Vec3(10, 20, 0), 2};
  return p;
}

inline ChainParameters nutating_b_head_c_table() {
  ChainParameters p;
  p.head_2 = RotaryAxis{Vec3(0, 1, 1), Vec3(0.1, -60, 180), 1};
  p.table_2 = RotaryAxis{Vec3(0, 0, -1), Vec3(10, 20, 0), 2};
  return p;
}

inline ChainParameters a_table() {
  ChainParameters p;
  p.table_2 = RotaryAxis{Vec3(-1, 0, 0), Vec3(0, 5, -300), 0};
  return p;
}

inline ChainParameters skewed_ac_table() {  // the directions a calibration finds on a real machine
  ChainParameters p = ac_table();
  p.table_1->direction = Vec3(-1, 0, 9.3e-5);
  p.table_2->direction = Vec3(2e-4, 1e-5, -1);
  return p;
}

inline ChainParameters skewed_head() {  // nothing is parallel or perpendicular to anything
  ChainParameters p;
  p.head_1 = RotaryAxis{Vec3(0.2, -0.3, 1), Vec3(1, 2, 3), 2};
  p.head_2 = RotaryAxis{Vec3(0.1, 1, 0.4), Vec3(4, -5, 160), 1};
  p.tool_direction = Vec3(0.05, -0.1, 1);
  return p;
}

inline ChainParameters ac_table_with_b_head() {
  ChainParameters p = ac_table();
  p.head_2 = RotaryAxis{Vec3(0, 1, 0), Vec3(0.3, 0, 180), 1};
  return p;
}

inline ChainParameters six_rotary_axes() {
  ChainParameters p = ac_table_with_b_head();
  p.table_0 = RotaryAxis{Vec3(0, -1, 0), Vec3(3, 0, 40), 4};
  p.head_1 = RotaryAxis{Vec3(0, 0, 1), Vec3(0.7, 0.2, 0), 3};
  p.head_0 = RotaryAxis{Vec3(1, 0, 0.1), Vec3(0, 0, 55), 5};
  return p;
}

inline ChainParameters slanted_linear_axes() {  // a slant-bed machine: Y leans, X and Z are exchanged in sign
  ChainParameters p = cb_head();
  p.linear_direction << -1, 0, 0, 0, 0.8, 0, 0, 0.6, -1;
  p.origin = Vec3(3, -4, 5);
  return p;
}

inline ChainParameters linear_axes_on_a_turning_column() {  // C turns X and Y and the head, Z does not move
  ChainParameters p;
  p.head_1 = RotaryAxis{Vec3(0, 0, 1), Vec3(-3, 4, 0), 2};
  p.head_2 = RotaryAxis{Vec3(0, 1, 0), Vec3(0.2, 0, 150), 1};
  p.linear_carriers = {1, 1, 0};
  return p;
}

inline ChainParameters quill_in_a_b_head() {  // Z moves along the tool: no position at B90
  ChainParameters p = b_head_c_table();
  p.linear_carriers = {0, 0, 1};
  return p;
}

struct Machine {
  const char* name;
  ChainParameters parameters;
};

inline void PrintTo(const Machine& machine, std::ostream* out) { *out << machine.name; }

inline const std::vector<Machine>& machines() {
  static const std::vector<Machine> all{
      {"AC table", ac_table()},
      {"BC table", bc_table()},
      {"CB head", cb_head()},
      {"CA head", ca_head()},
      {"B head C table", b_head_c_table()},
      {"nutating B head C table", nutating_b_head_c_table()},
      {"A table", a_table()},
      {"skewed AC table", skewed_ac_table()},
      {"skewed head", skewed_head()},
      {"AC table with B head", ac_table_with_b_head()},
      {"six rotary axes", six_rotary_axes()},
      {"slanted linear axes", slanted_linear_axes()},
      {"linear axes on a turning column", linear_axes_on_a_turning_column()}};
  return all;
}

}  // namespace trunnion::geometry
