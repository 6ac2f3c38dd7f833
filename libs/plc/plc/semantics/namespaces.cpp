// SPDX-License-Identifier: Apache-2.0
#include "plc/semantics/namespaces.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "plc/library/functions.hpp"
#include "plc/semantics/type.hpp"

namespace trunnion::st {
namespace {

/// What a namespace has: a unit, a type, a global variable or an enumerated value; or a namespace itself.
struct Element {
  Position at;
  std::string text;  ///< the whole name as written
  bool is_internal = false;
};

struct NamePart {
  std::string name, text;  ///< in capitals, as written
};
using NameParts = std::vector<NamePart>;

/// What a name means: the whole name of an element, and how many parts name it; 0: it means nothing here, or
/// what is wrong is reported.
struct FoundName {
  std::string name;
  std::size_t used = 0;
};

using NameSet = std::set<std::string, std::less<>>;

NameParts parts_of(const std::string& name, const std::string& text) {
  NameParts parts;
  for (std::size_t at = 0; at <= name.size();) {
    const auto end = std::min(name.find('.', at), name.size());
    parts.push_back({name.substr(at, end - at), text.substr(at, end - at)});
    at = end + 1;
  }
  return parts;
}

std::string whole_name(const std::string& space, const std::string& name) {
  return space.empty() ? name : space + "." + name;
}

/// Without the last part.
std::string space_of(const std::string& name) {
  const auto dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(0, dot);
}

std::string last_part(const std::string& name) { return name.substr(name.rfind('.') + 1); }

bool is_standard_type(const std::string& name) {
  return name == "STRING" || name == "WSTRING" || elementary(name) != nullptr;
}

class NameResolver {
 public:
  NameResolver(SourceTree& tree, const RegisterNames& registers, const std::vector<std::string>& files,
               Diagnostics& diagnostics)
      : tree_(tree), registers_(registers), files_(files), diagnostics_(diagnostics) {}

  void run() {
    declare_namespaces();
    declare_elements();
    for (const auto& [name, space] : namespaces_)
      if (const auto found = elements_.find(name); found != elements_.end())
        diagnostics_.error(space.at, "'" + space.text + "' is no namespace, as it is declared at " +
                                         place(found->second.at));
    for (std::size_t scope = 0; scope < tree_.scopes.size(); ++scope)
      for (auto& one : tree_.scopes[scope].usings) resolve_using(one, scope);
    for (auto& pou : tree_.pous) {
      scope_ = pou.scope;
      resolve(pou.extends);
      for (auto& one : pou.implements) resolve(one);
    }
    resolve_declarations();
    for (auto& pou : tree_.pous) resolve(pou);
  }

 private:
  void declare_namespaces() {
    for (const auto& scope : tree_.scopes) {
      if (scope.name.empty()) continue;
      auto& space = namespaces_.try_emplace(scope.name, Element{scope.at, scope.text, false}).first->second;
      space.is_internal = space.is_internal || scope.is_internal;
      if (is_builtin(last_part(scope.name)))
        diagnostics_.error(scope.at, "'" + last_part(scope.text) +
                                         "' is a name of the standard or of a register and cannot be that of "
                                         "a namespace");
    }
  }

  void declare(std::string& name, std::string& text, Position at, std::size_t scope, bool is_internal) {
    const auto& space = tree_.scopes[scope];
    if (!space.name.empty()) {
      if (is_standard_type(name)) diagnostics_.error(at, "'" + text + "' is a type of the standard");
      name = space.name + "." + name;
      text = space.text + "." + text;
    }
    elements_.try_emplace(name, Element{at, text, is_internal});
  }

  void declare_elements() {
    for (auto& type : tree_.types) declare(type.name, type.text, type.at, type.scope, type.is_internal);
    for (auto& block : tree_.globals)
      for (auto& variable : block.variables)
        declare(variable.name, variable.text, variable.at, block.scope, block.is_internal);
    for (auto& pou : tree_.pous) {
      if (pou.kind == PouKind::test) continue;
      declare(pou.name, pou.text, pou.at, pou.scope, pou.is_internal);
      pous_.try_emplace(pou.name, &pou);
    }
    for (auto& interface : tree_.interfaces)
      declare(interface.name, interface.text, interface.at, interface.scope, interface.is_internal);
    for (auto& configuration : tree_.configurations)
      for (auto& program : configuration.programs)
        elements_.try_emplace(program.name, Element{program.at, program.text, false});
    for (auto& type : tree_.types) declare_values(*type.type, type.scope, type.is_internal);
    for (auto& block : tree_.globals)
      for (auto& type : block.types) declare_values(*type, block.scope, block.is_internal);
    for (auto& pou : tree_.pous) {
      pou.space = tree_.scopes[pou.scope].name;
      for (auto& method : pou.methods) method.space = pou.space;
    }
    for (auto& interface : tree_.interfaces)
      for (auto& method : interface.methods) method.space = tree_.scopes[interface.scope].name;
  }

  void declare_values(TypeSpec& spec, std::size_t scope, bool is_internal) {
    const auto& space = tree_.scopes[scope];
    if (spec.kind == TypeSpec::Kind::enumeration) spec.space = space.name;
    for (const auto& value : spec.enumerators)
      elements_.try_emplace(whole_name(space.name, value.name),
                            Element{value.at, whole_name(space.text, value.text), is_internal});
    if (spec.element) declare_values(*spec.element, scope, is_internal);
    for (auto& type : spec.own_types) declare_values(*type, scope, is_internal);
  }

  bool is_builtin(const std::string& name) const {
    return is_standard_type(name) || is_standard_function(name) || registers_.contains(name);
  }

  std::string place(Position at) const {
    return (at.file < files_.size() ? files_[at.file] : std::string("?")) + ":" + std::to_string(at.line) +
           ":" + std::to_string(at.column);
  }

  void refuse_internal(const std::string& text, const std::string& space, Position at) {
    diagnostics_.error(at, "'" + text + "' is INTERNAL and visible in the namespace '" + space + "' only");
  }

  /// An INTERNAL namespace is visible in the one around it; without one around it, in itself.
  bool check_namespace(const std::string& name, const std::string& here, Position at) {
    const auto& space = namespaces_.at(name);
    const auto outer = space_of(name);
    if (!space.is_internal || is_within(here, outer.empty() ? name : outer)) return true;
    refuse_internal(space.text, outer.empty() ? space.text : space_of(space.text), at);
    return false;
  }

  /// From the namespace of the directive to the outside.
  void resolve_using(NamedPlace& one, std::size_t scope) {
    const auto& here = tree_.scopes[scope].name;
    for (auto space = here;; space = space_of(space)) {
      const auto name = whole_name(space, one.name);
      if (namespaces_.contains(name)) {
        bool visible = true;
        for (auto part = name; visible && !part.empty(); part = space_of(part))
          visible = check_namespace(part, here, one.at);
        one.name = visible ? name : "";
        return;
      }
      if (space.empty()) break;
    }
    diagnostics_.error(one.at, "there is no namespace '" + one.text + "'");
    one.name.clear();
  }

  /// The one place that knows what a name means in a scope: from the inside to the outside what the namespace
  /// has, then what its USING brings.
  FoundName find(const NameParts& parts, std::size_t scope, Position at) {
    const auto& here = tree_.scopes[scope].name;
    const Element* hidden = nullptr;
    for (auto next = scope;; next = tree_.scopes[next].outer) {
      const auto& space = tree_.scopes[next].name;
      const auto name = whole_name(space, parts[0].name);
      if (elements_.contains(name) || (space.empty() && is_builtin(name))) return {name, 1};
      if (namespaces_.contains(name)) return find_in(name, parts, here, at);
      std::vector<std::string> candidates;
      for (const auto& one : tree_.scopes[next].usings) {
        const auto used = whole_name(one.name, parts[0].name);
        const auto found = one.name.empty() ? elements_.end() : elements_.find(used);
        if (found == elements_.end()) continue;
        if (found->second.is_internal && !is_within(here, one.name))
          hidden = &found->second;
        else if (std::find(candidates.begin(), candidates.end(), used) == candidates.end())
          candidates.push_back(used);
      }
      if (candidates.size() > 1) {
        const auto &first = elements_.at(candidates[0]), &second = elements_.at(candidates[1]);
        diagnostics_.error(at, "'" + parts[0].text + "' is ambiguous: '" + first.text + "' (" +
                                   place(first.at) + ") and '" + second.text + "' (" + place(second.at) +
                                   "); write the namespace before it");
        return {};
      }
      if (candidates.size() == 1) return {candidates[0], 1};
      if (next == 0) break;
    }
    if (hidden != nullptr) refuse_internal(hidden->text, space_of(hidden->text), at);
    return {};
  }

  /// parts[0] is the namespace.
  FoundName find_in(const std::string& first, const NameParts& parts, const std::string& here, Position at) {
    auto space = first;
    for (std::size_t i = 1; check_namespace(space, here, at); ++i) {
      const auto& text = namespaces_.at(space).text;
      if (i == parts.size()) {
        auto message = "'" + text + "' is a namespace: name what you mean of it, ";
        diagnostics_.error(at, message.append(text).append(".name"));
        return {};
      }
      const auto name = space + "." + parts[i].name;
      if (const auto found = elements_.find(name); found != elements_.end()) {
        if (!found->second.is_internal || is_within(here, space)) return {name, i + 1};
        refuse_internal(found->second.text, text, at);
        return {};
      }
      if (!namespaces_.contains(name)) {
        diagnostics_.error(at, "the namespace '" + text + "' has no '" + parts[i].text + "'");
        return {};
      }
      space = name;
    }
    return {};
  }

  /// Of a type or unit.
  void resolve(std::string& name, const std::string& text, Position at) {
    if (text.empty() || is_standard_type(name)) return;
    const auto parts = parts_of(name, text);
    const auto found = find(parts, scope_, at);
    if (found.used == parts.size())
      name = found.name;
    else if (found.used > 0)
      diagnostics_.error(at, "there is no type or unit '" + text + "'");
  }

  void resolve(NamedPlace& one) { resolve(one.name, one.text, one.at); }

  void resolve(TypeSpec& spec) {
    const bool is_named = spec.kind == TypeSpec::Kind::named || spec.kind == TypeSpec::Kind::enumeration;
    if (is_named) resolve(spec.name, spec.text, spec.at);
    resolve(spec.low), resolve(spec.high), resolve(spec.length);
    for (auto& dimension : spec.dimensions) resolve(dimension.low), resolve(dimension.high);
    for (auto& value : spec.enumerators) resolve(value.value);
    if (spec.element) resolve(*spec.element);
    for (auto& type : spec.own_types) resolve(*type);
    for (auto& initial : spec.own_initials) resolve(initial);
  }

  void resolve(const ExpressionPtr& e) {
    if (e) resolve(*e);
  }

  /// The way along the first parts has no limit, as in a + b + c ...
  void resolve(Expression& top) {
    std::vector<Expression*> way;
    for (auto* e = &top; e != nullptr;) {
      way.push_back(e);
      for (auto& argument : e->arguments) resolve(argument.value);
      for (auto& argument : e->control) resolve(argument.value);
      for (auto& count : e->repeat) resolve(count);
      for (std::size_t i = 1; i < e->parts.size(); ++i) resolve(e->parts[i]);
      auto* first = e->parts.empty() ? nullptr : e->parts[0].get();
      if (e->kind == Expression::Kind::typed) {
        resolve(e->name, e->text, e->at);
        if (first != nullptr && first->kind == Expression::Kind::name) return;  // a value of its type
      }
      e = first;
    }
    if (way.back()->kind == Expression::Kind::name && way.back()->scope == NameScope::any) resolve_name(way);
  }

  /// The last one is a name, those before it what is done with it. A name with namespaces becomes one name.
  void resolve_name(const std::vector<Expression*>& way) {
    auto& root = *way.back();
    const auto size = way.size();
    const bool is_called = size > 1 && way[size - 2]->kind == Expression::Kind::call;
    if (variables_.contains(root.name) || (is_called && methods_.contains(root.name))) return;
    NameParts parts{NamePart{root.name, root.text}};
    for (auto i = size - 1; i-- > 0 && way[i]->kind == Expression::Kind::member;)
      parts.push_back({way[i]->name, way[i]->text});
    auto found = find(parts, scope_, root.at);
    if (found.used == 0) {
      if (is_called) resolve_conversion(root);
    } else if (found.used == 1) {
      root.name = std::move(found.name);
    } else {
      auto& whole = *way[size - found.used];
      const auto at = root.at;
      auto text = parts[0].text;
      for (std::size_t i = 1; i < found.used; ++i) text.append(".").append(parts[i].text);
      whole.kind = Expression::Kind::name;
      whole.at = at;
      whole.name = std::move(found.name);
      whole.text = std::move(text);
      whole.parts.clear();
    }
  }

  /// Colour_TO_INT with a type of a namespace.
  void resolve_conversion(Expression& callee) {
    const auto whole_type = [&](const std::string& type) -> std::string {
      if (is_standard_type(type)) return type;
      return find(NameParts{NamePart{type, type}}, scope_, callee.at).name;
    };
    const auto conversion =
        conversion_name(callee.name, [&](const std::string& type) { return !whole_type(type).empty(); });
    if (!conversion) return;
    const auto& [kind, from, to] = *conversion;
    callee.name.replace(callee.name.size() - to.size(), to.size(), whole_type(to));
    if (!from.empty()) callee.name.replace(0, from.size(), whole_type(from));
  }

  void resolve(Statements& statements) {
    using enum Statement::Kind;
    for (auto& one : statements) {
      auto& s = *one;
      if (s.kind != define && s.kind != jump && s.kind != label) resolve(s.target);
      resolve(s.value), resolve(s.to), resolve(s.by);
      for (auto& branch : s.branches) {
        resolve(branch.condition);
        for (auto& value : branch.labels) resolve(value.first), resolve(value.last);
        resolve(branch.body);
      }
      resolve(s.body);
    }
  }

  void resolve_declarations() {
    variables_.clear(), methods_.clear();
    for (auto& type : tree_.types) {
      scope_ = type.scope;
      resolve(*type.type), resolve(type.initial);
    }
    for (auto& block : tree_.globals) {
      scope_ = block.scope;
      resolve_block(block);
    }
    for (auto& interface : tree_.interfaces) {
      scope_ = interface.scope;
      for (auto& one : interface.extends) resolve(one);
      for (auto& method : interface.methods) {
        variables_.clear();
        add_variables(method);
        resolve_unit(method);
      }
    }
    for (auto& configuration : tree_.configurations) {
      scope_ = configuration.scope;
      variables_.clear();
      for (const auto& program : configuration.programs) variables_.insert(program.name);
      for (auto& task : configuration.tasks) resolve(task.interval), resolve(task.priority);
      for (auto& program : configuration.programs) {
        resolve(program.type, program.type_text, program.type_at);
        resolve(program.call);
      }
    }
  }

  void resolve_block(VariableBlock& block) {
    for (auto& type : block.types) resolve(*type);
    for (auto& initial : block.initials) resolve(initial);
  }

  void add_variables(const PouDeclaration& pou) {
    for (const auto& block : pou.blocks) {
      for (const auto& variable : block.variables) variables_.insert(variable.name);
      for (const auto& type : block.types) add_values(*type);
    }
    if (pou.kind == PouKind::method && pou.result) variables_.insert(pou.name);
  }

  /// Of VAR s : (idle, moving);
  void add_values(const TypeSpec& spec) {
    for (const auto& value : spec.enumerators) variables_.insert(value.name);
    if (spec.element) add_values(*spec.element);
    for (const auto& type : spec.own_types) add_values(*type);
  }

  /// With the variables and methods of the blocks that it extends.
  void resolve(PouDeclaration& pou) {
    scope_ = pou.scope;
    variables_.clear(), methods_.clear();
    add_variables(pou);
    if (pou.kind == PouKind::function && pou.result && !pou.space.empty() &&
        variables_.contains(last_part(pou.name)))
      diagnostics_.error(pou.at, "'" + last_part(pou.text) +
                                     "' is the result of the function: give the variable another name");
    const auto* block = &pou;
    // A block that extends itself is an error, which is found later.
    for (std::size_t levels = 0; block != nullptr && levels <= pous_.size(); ++levels) {
      if (levels > 0) add_variables(*block);
      for (const auto& method : block->methods) methods_.insert(method.name);
      const auto parent = pous_.find(block->extends.name);
      block = parent == pous_.end() ? nullptr : parent->second;
    }
    resolve_unit(pou);
    for (auto& method : pou.methods) {
      const auto of_block = variables_;
      add_variables(method);
      resolve_unit(method);
      variables_ = of_block;
    }
  }

  void resolve_unit(PouDeclaration& pou) {
    if (pou.result) resolve(*pou.result);
    for (auto& block : pou.blocks) {
      resolve_block(block);
      if (block.section != VariableSection::external) continue;
      for (auto& variable : block.variables)
        variable.global = find(NameParts{NamePart{variable.name, variable.text}}, scope_, variable.at).name;
    }
    resolve(pou.body);
  }

  SourceTree& tree_;
  const RegisterNames& registers_;
  const std::vector<std::string>& files_;
  Diagnostics& diagnostics_;
  std::map<std::string, Element, std::less<>> namespaces_, elements_;
  std::map<std::string, const PouDeclaration*, std::less<>> pous_;
  // Of the declaration that is resolved:
  std::size_t scope_ = 0;
  NameSet variables_, methods_;  ///< they come before what find() knows
};

}  // namespace

bool is_within(std::string_view space, std::string_view outer) {
  return outer.empty() || space == outer || (space.starts_with(outer) && space[outer.size()] == '.');
}

void resolve_names(SourceTree& tree, const RegisterNames& registers, const std::vector<std::string>& files,
                   Diagnostics& diagnostics) {
  const bool is_used = std::any_of(tree.scopes.begin(), tree.scopes.end(), [](const NamingScope& scope) {
    return !scope.name.empty() || !scope.usings.empty();
  });
  if (is_used) NameResolver(tree, registers, files, diagnostics).run();
}

}  // namespace trunnion::st
