// SPDX-License-Identifier: Apache-2.0
#include "true_machine.hpp"

#include <sstream>
#include <stdexcept>

#include "machine_directory.hpp"

namespace trunnion::cli {

TrueMachine load_true_machine(const std::string& machine, std::uint16_t channel,
                              const std::vector<std::string>& settings) {
  return identification::load_true_machine(machine_directory(machine), channel, settings);
}

truth::Vec3 coordinates(const std::string& option, const std::string& text) {
  std::istringstream in(text);
  truth::Vec3 v;
  char comma[2], more = 0;
  if (!(in >> v[0] >> comma[0] >> v[1] >> comma[1] >> v[2]) || comma[0] != ',' || comma[1] != ',' ||
      in >> more || !v.allFinite() || !(v.cwiseAbs().maxCoeff() <= 1e6))
    throw std::runtime_error(option + " " + text + ": expected X,Y,Z in mm");
  return v;
}

}  // namespace trunnion::cli
