// SPDX-License-Identifier: Apache-2.0
// Which places of the sources use a variable or a register, by its path while the programs run.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plc/compile.hpp"

namespace trunnion::st {

struct SourceUse {
  std::string file;
  Use use;
};

class Uses {
 public:
  Uses() = default;
  explicit Uses(const Compilation& compilation);

  /// In the order of the sources. Paths are those of Variables::find() and names of the cross reference
  /// (POU.variable). A variable of a function block has the places in the block, which all its instances
  /// share, and those that name it from outside (main.changer.limit). A register has those of its bits too, a
  /// bit those of its register, a variable with AT those of its register. An index counts for nothing.
  /// Throws std::runtime_error "'path': why" in one line.
  std::vector<SourceUse> of(const std::string& path) const;

 private:
  std::vector<CrossReference> references_;
  std::vector<Symbol> symbols_;
  std::vector<std::string> files_;
  std::shared_ptr<const void> types_;  ///< owns what symbols point to
};

}  // namespace trunnion::st
