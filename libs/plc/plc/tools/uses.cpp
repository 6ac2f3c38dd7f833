// SPDX-License-Identifier: Apache-2.0
#include "plc/tools/uses.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "plc/library/register_names.hpp"
#include "plc/syntax/token.hpp"
#include "plc/tools/variables.hpp"

namespace trunnion::st {
namespace {

auto order(const Use& use) { return std::tuple(use.at.file, use.at.line, use.at.column); }

std::optional<RegisterAddress> register_of(std::string_view text) {
  if (!text.starts_with('%')) return std::nullopt;
  const char* problem = "";
  return parse_register(text.substr(1), &problem);
}

bool overlap(const RegisterAddress& a, const RegisterAddress& b) {
  return a.area == b.area && a.index == b.index && (a.bit == b.bit || !a.is_bit() || !b.is_bit());
}

/// Whether the one names a part of the other, or both the same: A and A.B.
bool is_part(const std::string& a, const std::string& b) {
  const auto& shorter = a.size() < b.size() ? a : b;
  const auto& longer = a.size() < b.size() ? b : a;
  return shorter.empty() ||
         (longer.starts_with(shorter) && (longer.size() == shorter.size() || longer[shorter.size()] == '.'));
}

/// .A[3].B as the names A and B.
std::vector<std::string> members_of(const std::string& path) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < path.size();) {
    const auto end = std::min(path.find_first_of(".[", at + 1), path.size());
    if (path[at] == '.') names.push_back(path.substr(at + 1, end - at - 1));
    at = end;
  }
  return names;
}

std::string joined(const std::vector<std::string>& names, std::size_t from) {
  std::string text;
  for (auto i = from; i < names.size(); ++i) text.append(text.empty() ? "" : ".").append(names[i]);
  return text;
}

class Places {
 public:
  Places(const std::vector<CrossReference>& references, const std::vector<std::string>& files)
      : references_(references), files_(files) {}

  bool found() const { return found_; }
  /// Uses of a variable of the cross reference, of which `member` is meant.
  void add_variable(const std::string& name, const std::string& member) {
    for (const auto& reference : references_)
      if (!reference.name.starts_with('%') && upper_case(reference.name) == upper_case(name)) {
        found_ = true;
        for (const auto& use : reference.uses)
          if (is_part(use.member, member)) add(use);
        if (const auto at = register_of(reference.location)) add_register(*at);
      }
  }
  void add_register(const RegisterAddress& at) {
    found_ = true;
    for (const auto& reference : references_)
      if (const auto other = register_of(reference.name); other && overlap(*other, at))
        for (const auto& use : reference.uses) add(use);
  }
  std::vector<SourceUse> sorted() {
    std::stable_sort(uses_.begin(), uses_.end(),
                     [](const Use& a, const Use& b) { return order(a) < order(b); });
    std::vector<SourceUse> result;
    for (auto& use : uses_)
      result.push_back({use.at.file < files_.size() ? files_[use.at.file] : "?", std::move(use)});
    return result;
  }

 private:
  void add(const Use& use) {
    if (std::none_of(uses_.begin(), uses_.end(),
                     [&](const Use& other) { return order(other) == order(use); }))
      uses_.push_back(use);
  }

  const std::vector<CrossReference>& references_;
  const std::vector<std::string>& files_;
  std::vector<Use> uses_;
  bool found_ = false;
};

}  // namespace

Uses::Uses(const Compilation& compilation)
    : references_(compilation.references),
      symbols_(compilation.symbols),
      files_(compilation.files),
      types_(compilation.types) {}

std::vector<SourceUse> Uses::of(const std::string& path) const {
  const auto upper = upper_case(path);
  Places places(references_, files_);
  if (const auto at = register_of(upper)) {
    places.add_register(*at);
    return places.sorted();
  }
  const auto [symbol, end] = symbol_in(symbols_, upper);
  if (symbol != nullptr) {
    const auto members = members_of(upper.substr(end));
    places.add_variable(symbol->declared, joined(members, 0));
    const auto* type = symbol->type;
    for (std::size_t i = 0; i < members.size(); ++i) {
      while (type->kind == Kind::array) type = type->element;
      if (type->kind == Kind::structure) {
        const auto* field = type->field(members[i]);
        if (field == nullptr) break;
        type = field->type;
      } else if (type->kind == Kind::block) {
        const auto& pou = *type->block->pou;
        const auto variable = pou.names.find(members[i]);
        if (variable == pou.names.end()) break;
        places.add_variable(pou.declaration->text + "." + members[i], joined(members, i + 1));
        type = variable->second->type;
      } else {
        break;
      }
    }
    return places.sorted();
  }
  // A unit may have namespaces before its name.
  auto behind = upper.find('.');
  do {
    if (behind != std::string::npos) behind = upper.find_first_of(".[", behind + 1);
    places.add_variable(upper.substr(0, behind), "");
  } while (!places.found() && behind != std::string::npos);
  if (!places.found()) {
    const auto named = interface_registers().find(upper);
    if (named == interface_registers().end())
      throw std::runtime_error("'" + path + "': there is no such variable or register");
    places.add_register(named->second);
  }
  return places.sorted();
}

}  // namespace trunnion::st
