// SPDX-License-Identifier: Apache-2.0
// The syntax tree of Structured Text.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plc/syntax/diagnostics.hpp"

namespace trunnion::st {

struct Expression;
using ExpressionPtr = std::unique_ptr<Expression>;

struct Argument {
  std::string name;  ///< of the parameter, in capitals; empty: by position
  Position at;
  bool output = false;    ///< name => variable
  bool inverted = false;  ///< NOT name => variable
  ExpressionPtr value;
};

/// THIS.name is a variable or method of the instance, SUPER.name one of the function block that is extended.
enum class NameScope { any, instance, base };

struct Expression {
  enum class Kind {
    integer,      ///< text: digits, base
    real,         ///< text
    boolean,      ///< text: "1" or "0"
    string,       ///< text; base 16: WSTRING
    time,         ///< name: prefix, text
    name,         ///< text, name
    direct,       ///< name: address without percent sign
    member,       ///< parts[0].name
    part,         ///< parts[0].%name
    index,        ///< parts[0][parts[1..]]
    dereference,  ///< parts[0]^
    unary,        ///< name: - or NOT
    binary,       ///< name: operator
    call,         ///< parts[0](arguments)
    typed,        ///< name#parts[0]
    list,         ///< [a, b, 2(c)]: parts; repetitions in `repeat`
    structure,    ///< (a := 1, b := 2): arguments
  };
  Kind kind = Kind::integer;
  Position at;
  std::string text;  ///< as written
  std::string name;  ///< in capitals
  NameScope scope = NameScope::any;
  int base = 10;
  std::vector<ExpressionPtr> parts;
  std::vector<ExpressionPtr> repeat;  ///< of lists: count of each part or nothing
  std::vector<Argument> arguments;
  std::vector<Argument> control;  ///< of a call: EN := value, ENO => variable
  std::string detected;           ///< of a block that detects the edges of an input: the input, in capitals
};

struct Statement;
using Statements = std::vector<std::unique_ptr<Statement>>;

struct CaseLabel {
  ExpressionPtr first, last;  ///< `last` only of a range
};

struct Statement {
  enum class Kind {
    assign,
    call,
    if_,
    case_,
    for_,
    while_,
    repeat,
    exit,
    continue_,
    return_,
    // of diagrams only:
    define,  ///< `target` names an intermediate value, `value`; with `to` only when that is TRUE, else 0
    jump,    ///< to the label `target`
    label,
  };
  struct Branch {
    ExpressionPtr condition;        ///< of IF, ELSIF; none: ELSE
    std::vector<CaseLabel> labels;  ///< of CASE
    Statements body;
  };
  Kind kind = Kind::assign;
  Position at;
  bool attempts = false;        ///< of assign: ?=
  ExpressionPtr target, value;  ///< of assign; `value` of a call, CASE, WHILE, REPEAT; `target` of FOR
  ExpressionPtr to, by;         ///< of FOR, with `value` as its first value
  std::vector<Branch> branches;
  Statements body;
};

struct TypeSpec;
using TypeSpecPtr = std::unique_ptr<TypeSpec>;

/// R_EDGE, F_EDGE: in the body the input is TRUE at a rising, falling edge only.
enum class InputEdge { none, rising, falling };

struct VariableDeclaration {
  std::string name, text;  ///< in capitals, as written
  Position at;
  std::string location;  ///< of AT, without percent sign
  std::string global;    ///< of VAR_EXTERNAL in a namespace: the whole name of the global variable
  Position location_at;
  InputEdge edge = InputEdge::none;
  Position edge_at;
  TypeSpec* type = nullptr;  ///< shared by the names of one list
  Expression* initial = nullptr;
};

struct TypeSpec {
  enum class Kind { named, array, string, structure, enumeration, reference, pointer };
  struct Dimension {
    ExpressionPtr low, high;  ///< of ARRAY[*] none
  };
  struct Enumerator {
    std::string name, text;
    Position at;
    ExpressionPtr value;
  };
  Kind kind = Kind::named;
  Position at;
  std::string name, text;   ///< of named; of an enumeration the type of its values, if it says one
  std::string space;        ///< of an enumeration: the namespace of its values, in capitals
  ExpressionPtr low, high;  ///< of a subrange
  std::vector<Dimension> dimensions;
  TypeSpecPtr element;   ///< of an array, a reference or a pointer
  ExpressionPtr length;  ///< of a string
  std::vector<VariableDeclaration> fields;
  std::vector<Enumerator> enumerators;
  std::vector<TypeSpecPtr> own_types;       ///< of fields
  std::vector<ExpressionPtr> own_initials;  ///< of fields
};

enum class VariableSection { local, input, output, in_out, temporary, global, external };

/// From where a method or a variable of VAR is used; INTERNAL is public_ within its namespace.
enum class Access { public_, protected_, private_ };

struct VariableBlock {
  VariableSection section = VariableSection::local;
  Access access = Access::protected_;
  bool retain = false, constant = false, is_internal = false;
  std::size_t scope = 0;  ///< of VAR_GLOBAL: one of SourceTree::scopes
  Position at;
  std::vector<VariableDeclaration> variables;
  std::vector<TypeSpecPtr> types;
  std::vector<ExpressionPtr> initials;
};

enum class PouKind { program, function, function_block, test, method };

/// A name behind EXTENDS, IMPLEMENTS or USING.
struct NamedPlace {
  std::string name, text;
  Position at;
};

/// A program organization unit; a class is a function block without a body.
struct PouDeclaration {
  PouKind kind = PouKind::program;
  std::string name, text;
  Position at;
  TypeSpecPtr result;
  std::vector<VariableBlock> blocks;
  Statements body;
  Position end;
  Access access = Access::public_;  ///< of a method
  bool is_class = false, is_final = false, is_abstract = false, overrides = false, is_internal = false;
  std::size_t scope = 0;                ///< one of SourceTree::scopes
  std::string space;                    ///< the namespace, in capitals
  NamedPlace extends;                   ///< of a function block; without a name: none
  std::vector<NamedPlace> implements;   ///< interfaces
  std::vector<PouDeclaration> methods;  ///< of a function block
};

/// INTERFACE; its methods have no statements.
struct InterfaceDeclaration {
  std::string name, text;
  Position at;
  bool is_internal = false;
  std::size_t scope = 0;  ///< one of SourceTree::scopes
  std::vector<NamedPlace> extends;
  std::vector<PouDeclaration> methods;
};

struct TypeDeclaration {
  std::string name, text;
  Position at;
  bool is_internal = false;
  std::size_t scope = 0;  ///< one of SourceTree::scopes
  TypeSpecPtr type;
  ExpressionPtr initial;
};

/// TASK name (INTERVAL := T#1ms, PRIORITY := 0);
struct TaskDeclaration {
  std::string name, text;
  Position at;
  ExpressionPtr interval, priority;
};

/// PROGRAM name WITH task : type (input := value, output => variable);
struct ProgramConfiguration {
  std::string name, text;
  Position at;
  std::string task, task_text;  ///< empty: without WITH
  Position task_at;
  std::string type, type_text;
  Position type_at;
  bool retain = false;
  ExpressionPtr call;  ///< of the instance with its connections
};

/// CONFIGURATION with its one RESOURCE; their global variables are among those of the sources.
struct ConfigurationDeclaration {
  std::string text;
  Position at;
  std::size_t scope = 0;  ///< one of SourceTree::scopes
  std::vector<TaskDeclaration> tasks;
  std::vector<ProgramConfiguration> programs;
};

/// Where names mean the same: a source, a piece of a namespace, or a unit with a USING of its own.
struct NamingScope {
  std::string name, text;  ///< of the namespace with those around it, in capitals and as written
  Position at;
  bool is_internal = false;
  std::size_t outer = 0;
  std::vector<NamedPlace> usings;
};

/// Everything that the sources declare. Names are whole ones, with their namespaces, behind resolve_names().
struct SourceTree {
  std::vector<NamingScope> scopes = std::vector<NamingScope>(1);  ///< the first one is around all
  std::vector<TypeDeclaration> types;
  std::vector<VariableBlock> globals;
  std::vector<PouDeclaration> pous;
  std::vector<InterfaceDeclaration> interfaces;
  std::vector<ConfigurationDeclaration> configurations;
};

}  // namespace trunnion::st
