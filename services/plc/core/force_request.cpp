// SPDX-License-Identifier: Apache-2.0
#include "force_request.hpp"

#include <stdexcept>
#include <vector>

#include "plc/tools/value_text.hpp"

namespace trunnion::plc {
namespace {

Force force_of(const st::Variables& variables, const std::string& path, const std::string& text,
               bool permanent) {
  const auto at = variables.find_elementary(path);
  if (at.type->kind == st::Kind::string)
    throw std::runtime_error("'" + path + "': it is " + at.type->name + "; strings cannot be forced");
  std::uint64_t value = 0;
  try {
    st::set_value(*at.type, text, std::span(&value, 1));
  } catch (const std::runtime_error& e) {
    throw std::runtime_error("'" + path + "': " + e.what());
  }
  if (at.is_register()) value = static_cast<std::uint64_t>(st::register_number_of(at, value));
  return {at.address, at.bit, value, permanent ? 1u : 0u, 0};
}

bool is_forced(const Forces& forces, std::uint32_t cell, int bit) {
  for (std::uint32_t i = 0; i < forces.count; ++i)
    if (forces.values[i].cell == cell && forces.values[i].bit == bit) return true;
  return false;
}

void force(const idl::plc::OnlineRequest& request, const st::Variables& variables, PlcCore& core) {
  if (request.paths.empty() || request.paths.size() != request.values.size())
    throw std::runtime_error("name at least one variable and as many values");
  std::vector<Force> forces;
  std::size_t added = 0;
  for (std::size_t i = 0; i < request.paths.size(); ++i) {
    forces.push_back(force_of(variables, request.paths[i], request.values[i], request.permanent));
    if (!is_forced(core.memory().forces, forces[i].cell, forces[i].bit)) ++added;
  }
  if (core.memory().forces.count + added > most_forces)
    throw std::runtime_error(std::to_string(core.memory().forces.count) + " values are forced; at most " +
                             std::to_string(most_forces) + " can be");
  for (const auto& one : forces) core.force(one);
}

void release(const idl::plc::OnlineRequest& request, const st::Variables& variables, PlcCore& core) {
  if (request.paths.empty()) return core.release_all();
  std::vector<st::Location> places;
  for (const auto& path : request.paths) {
    places.push_back(variables.find_elementary(path));
    if (!is_forced(core.memory().forces, places.back().address, places.back().bit))
      throw std::runtime_error("'" + path + "': it is not forced");
  }
  for (const auto& at : places) core.release(at.address, at.bit);
}

}  // namespace

std::string change_forces(const idl::plc::OnlineRequest& request, const st::Variables& variables,
                          PlcCore& core) {
  try {
    if (request.action == idl::plc::OnlineAction::FORCE)
      force(request, variables, core);
    else
      release(request, variables, core);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

idl::plc::Forces forces_of(const Memory& memory, const st::Variables& variables) {
  idl::plc::Forces result;
  for (std::uint32_t i = 0; i < memory.forces.count; ++i) {
    const auto& force = memory.forces.values[i];
    auto& shown = result.values.emplace_back();
    shown.permanent = force.permanent != 0;
    const auto path = variables.path_at(force.cell, force.bit);
    shown.path = path.substr(0, 240);
    if (path.empty()) continue;
    const auto at = variables.find(path);
    shown.type = at.type->name.substr(0, 64);
    const auto value = at.bit >= 0 ? force.value : st::value_cell(at, force.value);
    shown.value = st::value_text(*at.type, std::span(&value, 1)).substr(0, 64);
  }
  return result;
}

}  // namespace trunnion::plc
