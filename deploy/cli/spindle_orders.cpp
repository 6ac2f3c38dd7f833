// SPDX-License-Identifier: Apache-2.0
#include "spindle_orders.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "canonical/spindle_value.hpp"

namespace trunnion::cli {
namespace {

std::size_t spindle_number(const std::string& name, const std::vector<machine::AxisInfo>& machine_spindles) {
  std::string known;
  for (std::size_t i = 0; i < machine_spindles.size(); ++i) {
    if (name == machine_spindles[i].name || name == std::to_string(i + 1)) return i;
    known += (i == 0 ? ": it has " : ", ") + machine_spindles[i].name;
  }
  throw std::runtime_error("the machine has no spindle " + name + known);
}

// In the unit of the PLC, 0.01 deg.
double added_angle(const std::string& word) {
  constexpr double largest = 360;  // deg
  constexpr double parts = 100;
  const char* end = word.data() + word.size();
  double angle = 0;
  const auto [stop, error] = std::from_chars(word.data(), end, angle);
  if (error != std::errc{} || stop != end || !(std::abs(angle) <= largest))
    throw std::runtime_error("'" + word + "' is no angle: -360 to 360 deg");
  return std::round(angle * parts) / parts + 0.0;
}

}  // namespace

CouplingOrder coupling_order(const std::string& word, const std::vector<std::string>& arguments,
                             const std::vector<machine::AxisInfo>& machine_spindles) {
  const bool couples = word == couple_word;
  const std::size_t fewest = couples ? 2 : 1, most = couples ? 3 : 1;
  if (arguments.size() < fewest || arguments.size() > most)
    throw std::runtime_error(couples ? "write: couple SLAVE MASTER [ANGLE]" : "write: uncouple SLAVE");
  CouplingOrder order;
  order.slave = spindle_number(arguments[0], machine_spindles);
  if (!couples) return order;
  order.master = spindle_number(arguments[1], machine_spindles);
  if (*order.master == order.slave)
    throw std::runtime_error("spindle " + machine_spindles[order.slave].name + " cannot follow itself");
  if (arguments.size() == most) order.angle = added_angle(arguments[2]);
  return order;
}

std::vector<std::string> order_lines(const CouplingOrder& order, bool num) {
  constexpr std::size_t num_spindles = 4;  // B1 to B4
  constexpr unsigned iso_master = 4821;    // #4821 of spindle 1
  if (num && (order.slave >= num_spindles || order.master.value_or(0) >= num_spindles))
    throw std::runtime_error("programs of the NUM dialect have words for the spindles 1 to 4 only");
  std::vector<std::string> lines;
  if (order.angle) lines.push_back(fmt::format("{}{:g}", num ? "EC" : "#4880=", *order.angle));
  if (!num)
    lines.push_back(
        fmt::format("#{}={}", iso_master + order.slave, order.master ? *order.master + 1 : std::size_t{0}));
  else if (order.master)
    lines.push_back(fmt::format("E{}={}", canonical::order_master + order.slave,
                                canonical::master_address + *order.master));
  else
    lines.push_back(fmt::format("E{}=-1", canonical::order_master + order.slave));
  return lines;
}

bool is_carried_out(const CouplingOrder& order, const idl::stream::Feedback& feedback) {
  if (order.slave >= feedback.spindles.size()) return false;
  const auto& slave = feedback.spindles[order.slave];
  if (!order.master || slave.master < 0) return !order.master && slave.master < 0;
  return static_cast<std::size_t>(slave.master) == *order.master &&
         slave.condition == idl::stream::SpindleCondition::SPINDLE_SYNCHRONIZED;
}

}  // namespace trunnion::cli
