// SPDX-License-Identifier: Apache-2.0
// Variables and registers by their path, and which variables new programs keep.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plc/compile.hpp"

namespace trunnion::st {

/// A variable, a part of one or a register in the memory of the programs.
struct Location {
  std::string path;  ///< main.changer.limit, main.a[2], %G300, feed_override_0
  const Type* type = nullptr;
  std::uint32_t address = 0;  ///< below image_cells: a register
  int bit = -1;               ///< of a register
  bool retained = false;
  std::string unit;  ///< of display, of a register with a function

  bool is_register() const { return address < image_cells; }
};

/// The cell of an elementary value as its type has it; registers are kept with the sign of their area.
std::uint64_t value_cell(const Location& at, std::uint64_t cell);
/// The number that a register gets so that its variable has the value.
std::int64_t register_number_of(const Location& at, std::uint64_t value);

struct SymbolInPath {
  const Symbol* symbol = nullptr;
  std::size_t end = 0;  ///< in the path, behind its name
};
/// The variable that a path in capitals begins with: program.variable, or variable when only one program has
/// it. Throws std::runtime_error when several have it.
SymbolInPath symbol_in(const std::vector<Symbol>& symbols, const std::string& upper);

class Variables {
 public:
  /// Only registers.
  Variables() = default;
  /// Of programs without errors.
  explicit Variables(const Compilation& compilation);

  /// program.variable, variable when only one program has it, with .field and [index]; %X0.3, %G300 and the
  /// names of registers. Throws std::runtime_error "'path': why" in one line.
  Location find(const std::string& path) const;
  /// find(), which must be an elementary variable, a bit or a register.
  Location find_elementary(const std::string& path) const;
  /// find(), a structure, array or function block as its elements, in the order of memory.
  std::vector<Location> elements(const std::string& path) const;
  /// The elements of all variables, in the order of memory; registers only when a variable is at one.
  std::vector<Location> all() const;
  /// Path of the element in that cell, of a register its address; empty when no variable has it.
  std::string path_at(std::uint32_t cell, int bit) const;

 private:
  friend class Changeover;
  Location with_retention(Location at) const;
  void expand(const Location& at, std::vector<Location>& elements) const;

  std::vector<Symbol> symbols_;
  std::vector<std::string> constants_;
  std::vector<Cells> retained_;
  std::vector<RegisterAddress> retained_registers_;
  std::shared_ptr<const void> types_;
};

/// What the variables of new programs begin with: values of the old ones where path and type are the same.
class Changeover {
 public:
  struct Move {
    std::uint32_t from = 0, to = 0, count = 0;  ///< cells of the memory
    std::string path;
  };
  Changeover() = default;
  /// With `only_retained` no other variables keep their values.
  Changeover(const Variables& running, const Variables& next, bool only_retained = false);

  const std::vector<Move>& moves() const { return moves_; }
  /// One line for each variable that is not kept or is new.
  const std::vector<std::string>& losses() const { return losses_; }
  /// The cell of the next programs that has the value of this cell; nothing when it is not kept.
  std::optional<std::uint32_t> moved(std::uint32_t cell) const;

 private:
  std::vector<Move> moves_;  ///< ascending by `from`
  std::vector<std::string> losses_;
};

}  // namespace trunnion::st
