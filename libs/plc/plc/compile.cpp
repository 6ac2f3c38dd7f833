// SPDX-License-Identifier: Apache-2.0
#include "plc/compile.hpp"

#include <algorithm>
#include <tuple>

#include "plc/devices/device_file.hpp"
#include "plc/instruction_list/list_file.hpp"
#include "plc/library/derived_units.hpp"
#include "plc/library/functions.hpp"
#include "plc/machine/verify.hpp"
#include "plc/plcopen/import.hpp"
#include "plc/semantics/namespaces.hpp"
#include "plc/syntax/parser.hpp"

namespace trunnion::st {
namespace {

constexpr std::uint16_t library_files = 2;
constexpr std::uint32_t layout_origin = 3072;  // of the first variable, in layouts since they are kept

struct Kept {
  SourceTree tree;
  Diagnostics diagnostics;
  RegisterNames registers;
  std::optional<Unit> unit;
};

void add_symbol(const Variable& variable, const std::string& prefix, const std::string& pou,
                std::uint32_t base, Compilation& compilation) {
  if (variable.constant.is_constant) compilation.constants.push_back(prefix + variable.text);
  if (variable.type->kind == Kind::error || variable.constant.is_constant ||
      variable.section == VariableSection::in_out || variable.section == VariableSection::external ||
      variable.section == VariableSection::temporary)
    return;
  const auto& place = variable.place;
  if (place.base == Place::Base::none) return;
  const auto offset = static_cast<std::uint32_t>(place.offset);
  const bool absolute = place.base == Place::Base::absolute;
  compilation.symbols.push_back({prefix + variable.text, variable.type, absolute ? offset : base + offset,
                                 place.bit, absolute && offset < image_cells, pou + variable.text,
                                 prefix.size()});
}

/// Finds the element of a diagram that is at a place.
class Elements {
 public:
  explicit Elements(std::vector<plcopen::ElementPlace> places) : places_(std::move(places)) {
    std::stable_sort(places_.begin(), places_.end(),
                     [](const auto& a, const auto& b) { return key(a.at) < key(b.at); });
  }
  std::string at(Position at) const {
    const auto behind =
        std::upper_bound(places_.begin(), places_.end(), at,
                         [](Position p, const auto& place) { return key(p) < key(place.at); });
    if (behind == places_.begin() || std::prev(behind)->at.file != at.file) return "";
    return std::prev(behind)->text;
  }

 private:
  static std::tuple<std::uint16_t, std::uint32_t, std::uint32_t> key(Position at) {
    return {at.file, at.line, at.column};
  }
  std::vector<plcopen::ElementPlace> places_;
};

/// Statements of each program of a task, and a warning for what the PLC stops.
void count_statements(const Unit& unit, Compilation& compilation, Diagnostics& diagnostics) {
  const auto counts = statement_counts(unit.code, unit.loops);
  for (const auto& entry : unit.code.entries) {
    if (entry.is_test) continue;
    const auto& count = counts[entry.routine];
    TaskStatements task;
    for (const char c : entry.name) task.name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    task.most = count.most;
    if (const auto loop = unit.loops.find(count.loop); !count.most)
      task.unbounded = loop != unit.loops.end() ? loop->second.at : unit.code.place_of(count.loop);
    if (count.most && *count.most > task_budget)
      diagnostics.warning(unit.code.place_of(unit.code.routines[entry.routine].entry),
                          "the program " + task.name + " can execute " + std::to_string(*count.most) +
                              " statements in one run; the PLC stops it after " +
                              std::to_string(task_budget));
    compilation.tasks.push_back(std::move(task));
  }
}

FunctionInterface interface_of(const Pou& pou) {
  FunctionInterface result;
  result.name = pou.declaration->text;
  result.routine = pou.routine;
  result.base = pou.base;
  for (const auto& variable : pou.variables) {
    const auto address = pou.base + static_cast<std::uint32_t>(std::max(variable.place.offset, 0));
    if (&variable == pou.result) {
      result.result = variable.type;
      result.result_address = address;
    } else if (variable.section == VariableSection::input || variable.section == VariableSection::output ||
               variable.section == VariableSection::in_out) {
      result.parameters.push_back({variable.text, variable.type, address,
                                   variable.section == VariableSection::output,
                                   variable.section == VariableSection::in_out});
    }
  }
  return result;
}

}  // namespace

std::vector<std::string> Compilation::lines() const {
  std::vector<std::string> result;
  for (const auto& diagnostic : diagnostics) result.push_back(to_line(diagnostic, files));
  return result;
}

std::uint64_t Compilation::layout() const {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  const auto add = [&](const std::string& text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    hash = (hash ^ 255u) * 1099511628211u;
  };
  for (const auto& symbol : symbols) {
    if (symbol.is_register) continue;
    add(symbol.path), add(symbol.type->name),
        add(std::to_string(symbol.address - image_cells + layout_origin)),
        add(std::to_string(symbol.type->cells));
  }
  for (const auto& name : implementers) add(name);
  // A pointer names its entry.
  for (const auto& entry : code ? code->pointed : std::vector<Pointed>{})
    for (const auto number : {entry.element, entry.count, entry.cells, entry.bytes, entry.form,
                              static_cast<std::uint32_t>(entry.view)})
      add(std::to_string(number));
  add(code ? std::to_string(code->initial.size() - image_cells + layout_origin) : "");
  return hash;
}

bool is_compiled(const std::string& name) {
  return (name.ends_with(".st") && !name.ends_with("_test.st")) || is_codesys_export(name) ||
         plcopen::is_plcopen(name) || name == "fast.il" || name == "main.il";
}

bool is_codesys_export(const std::string& name) { return name.ends_with(".exp") || name.ends_with(".EXP"); }

Compilation compile(const std::vector<Source>& sources, const RegisterNames& registers,
                    bool entries_for_functions) {
  Compilation result;
  auto kept = std::make_shared<Kept>();
  kept->registers = registers;
  result.files.push_back("standard_blocks.st");
  parse(standard_blocks_text, 0, kept->tree, kept->diagnostics);
  for (const auto& text : derived_units()) parse(text, 0, kept->tree, kept->diagnostics);
  result.files.push_back("simulated_devices.st");
  parse(simulated_devices_text, 1, kept->tree, kept->diagnostics);
  std::vector<plcopen::ElementPlace> places;
  for (const auto& source : sources) {
    result.files.push_back(source.name);
    const auto file = static_cast<std::uint16_t>(result.files.size() - 1);
    if (plcopen::is_plcopen(source.name))
      plcopen::import_document(source.text, file, kept->tree, kept->diagnostics, places);
    else if (is_instruction_list(source.name))
      import_list(source.name, source.text, file, kept->tree, kept->diagnostics);
    else
      parse(source.text, file, kept->tree, kept->diagnostics);
  }
  if (kept->diagnostics.errors() == 0)
    resolve_names(kept->tree, kept->registers, result.files, kept->diagnostics);
  auto& unit = kept->unit.emplace(kept->tree, kept->diagnostics, kept->registers, library_files);
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (is_codesys_export(sources[i].name))
      unit.codesys_files.insert(static_cast<std::uint16_t>(library_files + i));
  // What could not be read is missing, so names are not checked then.
  if (kept->diagnostics.errors() == 0) unit.run();
  if (kept->diagnostics.errors() == 0) {
    warn_of_two_tasks(unit, result.files, kept->diagnostics);
    count_statements(unit, result, kept->diagnostics);
    result.references = cross_reference(unit);
  }
  result.diagnostics = kept->diagnostics.sorted();
  const Elements elements(std::move(places));
  for (auto& diagnostic : result.diagnostics)
    if (const auto text = elements.at(diagnostic.at); !text.empty()) diagnostic.text += " (" + text + ")";
  for (auto& reference : result.references)
    for (auto& use : reference.uses) use.element = elements.at(use.at);
  result.types = kept;
  if (kept->diagnostics.errors() > 0) return result;
  for (const auto& variable : unit.globals) add_symbol(variable, "", "", 0, result);
  for (const auto& instance : unit.instances)
    for (const auto& variable : instance.pou->variables)
      add_symbol(variable, instance.variable.text + ".", instance.pou->declaration->text + ".",
                 static_cast<std::uint32_t>(instance.variable.place.offset), result);
  for (const auto* pou : unit.order) {
    const auto kind = pou->declaration->kind;
    if (kind != PouKind::function || unit.is_library(pou->declaration->at)) continue;
    result.functions.push_back(interface_of(*pou));
    if (entries_for_functions)
      unit.code.entries.push_back({pou->declaration->name, pou->routine, pou->base, false});
  }
  for (const auto* block : unit.implementers()) result.implementers.push_back(block->declaration->text);
  unit.code.files = result.files;
  result.code = std::make_shared<ByteCode>(std::move(unit.code));
  return result;
}

}  // namespace trunnion::st
