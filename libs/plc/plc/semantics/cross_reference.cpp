// SPDX-License-Identifier: Apache-2.0
#include "plc/semantics/cross_reference.hpp"

#include <algorithm>
#include <tuple>

#include "plc/library/register_names.hpp"

namespace trunnion::st {
namespace {

auto order_of(Position at) { return std::tuple(at.file, at.line, at.column); }

void add_use(std::vector<Use>& uses, const Reference& reference) {
  for (auto& use : uses)
    if (order_of(use.at) == order_of(reference.at)) {
      use.reads = use.reads || reference.reads;
      use.writes = use.writes || (reference.writes && !reference.calls);
      use.calls = use.calls || reference.calls;
      return;
    }
  uses.push_back({reference.at, reference.reads, reference.writes && !reference.calls, reference.calls,
                  reference.member, ""});
}

void sort(std::vector<Use>& uses) {
  std::sort(uses.begin(), uses.end(),
            [](const Use& a, const Use& b) { return order_of(a.at) < order_of(b.at); });
}

// Area, number, bit.
std::tuple<std::size_t, int, int> register_order(const std::string& text) {
  const char* problem = "";
  const auto at = parse_register(std::string_view(text).substr(1), &problem);
  return at ? std::tuple(static_cast<std::size_t>(at->area), int{at->index}, int{at->bit})
            : std::tuple(std::size_t{0}, 0, 0);
}

/// Routines that the entry calls, itself too.
std::vector<char> reached(const ByteCode& code, std::uint32_t routine) {
  std::vector<char> result(code.routines.size(), 0);
  result[routine] = 1;
  for (auto r = code.routines.size(); r-- > 0;)
    if (result[r] != 0)
      for (auto i = code.routines[r].entry; i < code.routines[r].end; ++i)
        if (const auto& in = code.code[i]; in.op == Op::call || in.op == Op::call_at)
          result[static_cast<std::size_t>(in.a)] = 1;
  return result;
}

std::string shown(const Reference& write) {
  if (write.variable == nullptr) return "the register " + write.register_text;
  return "'" + write.variable->text + "'" +
         (write.register_text.empty() ? "" : " (" + write.register_text + ")");
}

}  // namespace

std::vector<CrossReference> cross_reference(const Unit& unit) {
  std::vector<CrossReference> result;
  std::map<const Variable*, std::size_t> of_variable;
  const auto declare = [&](const Variable& variable, const std::string& prefix) {
    if (variable.type->kind == Kind::error || variable.section == VariableSection::external) return;
    if (variable.text.starts_with('@')) return;  // of an instruction list
    of_variable[&variable] = result.size();
    result.push_back({prefix + variable.text, variable.type->name, "", {}, {}});
  };
  for (const auto& variable : unit.globals) declare(variable, "");
  for (const auto* pou : unit.order)
    if (!unit.is_library(pou->declaration->at) && pou->declaration->kind != PouKind::test)
      for (const auto& variable : pou->variables) declare(variable, title_of(*pou) + ".");
  std::map<std::tuple<std::size_t, int, int>, CrossReference> registers;
  for (const auto& reference : unit.references) {
    std::string name;
    if (reference.variable != nullptr) {
      const auto found = of_variable.find(reference.variable);
      if (found == of_variable.end()) continue;
      auto& entry = result[found->second];
      add_use(entry.uses, reference);
      entry.location = reference.register_text;
      name = entry.name;
    }
    if (reference.register_text.empty()) continue;
    auto& entry = registers[register_order(reference.register_text)];
    entry.name = reference.register_text;
    if (!name.empty() && std::find(entry.names.begin(), entry.names.end(), name) == entry.names.end())
      entry.names.push_back(name);
    add_use(entry.uses, reference);
  }
  for (auto& [order, entry] : registers) {
    for (const auto& one : register_table())
      if (std::tuple(static_cast<std::size_t>(one.address.area), int{one.address.index},
                     int{one.address.bit}) == order)
        entry.names.insert(entry.names.begin(), one.name);
    result.push_back(std::move(entry));
  }
  for (auto& entry : result) sort(entry.uses);
  return result;
}

void warn_of_two_tasks(const Unit& unit, const std::vector<std::string>& files, Diagnostics& diagnostics) {
  struct Task {
    std::string name;
    std::vector<const Reference*> writes;
  };
  std::vector<Task> tasks;
  for (const char* name : {"SIMULATION", "FAST", "MAIN"}) {
    const auto entry = std::find_if(unit.code.entries.begin(), unit.code.entries.end(),
                                    [&](const Entry& e) { return !e.is_test && e.name == name; });
    if (entry == unit.code.entries.end()) continue;
    const auto routines = reached(unit.code, entry->routine);
    auto& task = tasks.emplace_back();
    for (const char* c = name; *c != 0; ++c) task.name += static_cast<char>(*c - 'A' + 'a');
    for (const auto& reference : unit.references)
      if (reference.writes && reference.count > 0 && reference.pou->declaration->kind != PouKind::test &&
          routines[reference.pou->routine] != 0)
        task.writes.push_back(&reference);
  }
  std::set<std::string> warned;
  for (std::size_t second = 1; second < tasks.size(); ++second)
    for (std::size_t first = 0; first < second; ++first)
      for (const auto* write : tasks[second].writes)
        for (const auto* other : tasks[first].writes) {
          const bool apart = other->first >= write->first + write->count ||
                             write->first >= other->first + other->count || (other->mask & write->mask) == 0;
          if (apart || !warned.insert(tasks[first].name + shown(*write)).second) continue;
          const auto& file = other->at.file < files.size() ? files[other->at.file] : std::string("?");
          diagnostics.warning(
              write->at, shown(*write) + " is written by the tasks " + tasks[second].name + " and " +
                             tasks[first].name + " (" + file + ":" + std::to_string(other->at.line) + ":" +
                             std::to_string(other->at.column) + "): the one that runs last decides");
        }
}

}  // namespace trunnion::st
