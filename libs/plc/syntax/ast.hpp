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

struct Expression {
  enum class Kind {
    integer,    ///< text: digits, base
    real,       ///< text
    boolean,    ///< text: "1" or "0"
    string,     ///< text; base 16: WSTRING
    time,       ///< name: prefix, text
    name,       ///< text, name
    direct,     ///< name: address without percent sign
    member,     ///< parts[0].name
    part,       ///< parts[0].%name
    index,      ///< parts[0][parts[1..]]
    unary,      ///< name: - or NOT
    binary,     ///< name: operator
    call,       ///< parts[0](arguments)
    typed,      ///< name#parts[0]
    list,       ///< [a, b, 2(c)]: parts; repetitions in `repeat`
    structure,  ///< (a := 1, b := 2): arguments
  };
  Kind kind = Kind::integer;
  Position at;
  std::string text;  ///< as written
  std::string name;  ///< in capitals
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
  Position location_at;
  InputEdge edge = InputEdge::none;
  Position edge_at;
  TypeSpec* type = nullptr;  ///< shared by the names of one list
  Expression* initial = nullptr;
};

struct TypeSpec {
  enum class Kind { named, array, string, structure, enumeration };
  struct Dimension {
    ExpressionPtr low, high;
  };
  struct Enumerator {
    std::string name, text;
    Position at;
    ExpressionPtr value;
  };
  Kind kind = Kind::named;
  Position at;
  std::string name, text;   ///< of named; of an enumeration the type of its values, if it says one
  ExpressionPtr low, high;  ///< of a subrange
  std::vector<Dimension> dimensions;
  TypeSpecPtr element;   ///< of an array
  ExpressionPtr length;  ///< of a string
  std::vector<VariableDeclaration> fields;
  std::vector<Enumerator> enumerators;
  std::vector<TypeSpecPtr> own_types;       ///< of fields
  std::vector<ExpressionPtr> own_initials;  ///< of fields
};

enum class VariableSection { local, input, output, in_out, temporary, global, external };

struct VariableBlock {
  VariableSection section = VariableSection::local;
  bool retain = false, constant = false;
  Position at;
  std::vector<VariableDeclaration> variables;
  std::vector<TypeSpecPtr> types;
  std::vector<ExpressionPtr> initials;
};

enum class PouKind { program, function, function_block, test };

/// A program organization unit.
struct PouDeclaration {
  PouKind kind = PouKind::program;
  std::string name, text;
  Position at;
  TypeSpecPtr result;
  std::vector<VariableBlock> blocks;
  Statements body;
  Position end;
};

struct TypeDeclaration {
  std::string name, text;
  Position at;
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
  std::vector<TaskDeclaration> tasks;
  std::vector<ProgramConfiguration> programs;
};

/// Everything that the sources declare.
struct SourceTree {
  std::vector<TypeDeclaration> types;
  std::vector<VariableBlock> globals;
  std::vector<PouDeclaration> pous;
  std::vector<ConfigurationDeclaration> configurations;
};

}  // namespace trunnion::st
