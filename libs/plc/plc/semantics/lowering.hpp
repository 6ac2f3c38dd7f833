// SPDX-License-Identifier: Apache-2.0
// Checks the body of one program organization unit and translates it into instructions.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "plc/semantics/emitter.hpp"
#include "plc/semantics/unit.hpp"

namespace trunnion::st {

/// Whether a call gives or takes it.
bool is_parameter(const Variable& variable, const Pou& pou);
/// Whether it is a register.
bool is_in_image(const Place& place);
/// The name or value of which the expression is a part.
const Expression& root_of(const Expression& e);

class Lowering {
 public:
  /// `pou` may be nullptr for constant expressions.
  Lowering(Unit& unit, Pou* pou, std::uint32_t first_temporary)
      : unit_(unit), pou_(pou), emit_(first_temporary) {}

  void body(const Statements& statements);
  /// `expected`: the type of what takes the value: an enumerated value without its type's name and a choice
  /// between literals have it.
  Value expression(const Expression& e, const Type* expected = nullptr);
  /// The value as one of the type, or an error at `at`. `what` begins the message: "the value".
  Value converted(Value value, const Type& to, Position at);
  Emitter& emitter() { return emit_; }
  /// Of a method of an interface: calls `method` when its `self` is of the block with this number.
  void dispatch(const Pou& method, std::uint64_t number);
  void end_dispatch();
  /// Instructions that give variables their initial values at each call.
  void initialize(const Variable& variable);

 private:
  // expressions
  Value literal_integer(const Expression& e);
  Value literal_time(const Expression& e);
  Value typed(const Expression& e);
  Value name(const Expression& e, const Type* expected);
  Value access(const Expression& e);
  Value member(const Expression& e);
  Value part(const Expression& e);
  Value dereference(const Expression& e);
  Value index(const Expression& e);
  /// parts[1..] of the index are those of the element of `value`.
  Value element(const Expression& e, Value value);
  Value index_number(const Expression& e);
  Value open_element(const Expression& e, Value value);
  void add_limits(const Value& array, std::vector<std::int32_t>& cells);
  /// REF(variable); nothing for other calls.
  std::optional<Value> reference_of(const Expression& e);
  std::string passing(const Expression& e) const;
  std::optional<Value> array_bound(const Expression& e, const Type* expected);
  Value open_limit(std::int32_t limit, const Type* expected, Position at);
  Value unary(const Expression& e, const Type* expected);
  Value inverted(const Value& value, Position at);
  Value binary(const Expression& e, const Type* expected);
  Value logic(const Expression& e, const Type* expected);
  Value arithmetic(const std::string& op, Value left, Value right, Position at);
  Value comparison(const std::string& op, Value left, Value right, Position at);
  Value time_arithmetic(const std::string& op, const Value& left, const Value& right, Position at);
  Value folded(const std::string& op, const Value& left, const Value& right, const Type& type, Position at);
  Value folded_comparison(const std::string& op, const Value& left, const Value& right) const;
  Value string_comparison(const std::string& op, const Value& left, const Value& right);
  Value power(Value left, Value right, const Type* expected, Position at);
  Value operation(Op op, const Type* type, const Value& left, const Value& right, bool narrow);
  bool settle(Value& left, Value& right, const std::string& op, Position at);
  Value as_number(const Value& value, Position at);
  Value as_bits(const Value& value, Position at);
  void mix(const std::string& op, Value& left, Value& right, Position at);
  Value converted_to_interface(const Value& value, const Type& to, Position at);
  std::optional<Value> converted_freely(const Value& value, const Type& to, Position at);
  Value failed(Position at, const std::string& text);
  Value error() const { return {elementary(Kind::error), false, 0, false, 0, "", {}, nullptr}; }
  Value temporary(const Type* type);
  Value kept(Value value);
  Value own_copy(const Value& value, const Type* expected, Position at);
  Value of_type(const Value& value, const Type& type, Position at);
  void initial_at(std::size_t jump, const Value& value);
  void fill(std::int32_t first, const std::vector<std::uint64_t>& cells);
  Value variable_value(Variable& variable);
  /// The function block whose body or method this is; nullptr elsewhere.
  Pou* instance() const;
  /// The block that declares this body or method.
  const Pou* declaring() const;
  /// The address of the running instance.
  Place self() const;
  /// The variable of the unit, in a method also of the instance; nullptr when there is none.
  Variable* own_variable(const Expression& name) const;
  bool is_inherited(const Variable& variable) const;
  std::string hidden(const Variable& variable) const;
  std::string internal(const std::string& text, const PouDeclaration& of) const;
  std::string scope_problem(const Expression& name) const;

  // pointers
  std::optional<Value> pointer_function(const Expression& e);
  Value refused_incomplete(const Type& type, Position at);
  Value size_of(const Expression& of);
  Value pointer_to(const Expression& of);
  Value pointer_of(const Value& value);
  Value pointed_by(const Value& pointer, Position at);
  std::string pointing(const Expression& of, const Value& value);
  bool is_of_method(const Variable& variable) const;
  std::int32_t moved_pointer(const Place& place);
  Value located(Value value);
  Value converted_to_pointer(const Value& value, const Type& to, Position at);
  Value number_of_pointer(const Value& pointer);
  Value pointer_arithmetic(const std::string& op, const Value& left, const Value& right, Position at);
  bool number_pointers(const std::string& op, Value& left, Value& right, Position at);
  bool check_pointed(const Expression& argument, const Variable& parameter);

  // places
  std::int32_t cell(const Value& value, const Type& type);
  std::int32_t cell(const Value& value) { return cell(value, *value.type); }
  std::int32_t address(const Value& value);
  std::int32_t address(const Place& place);
  void store(const Value& target, const Value& value);
  void store_cell(const Place& place, const Type& type, std::int32_t cell);
  void copy(const Value& target, const Value& value);
  std::int32_t load(const Place& place, const Type& type);
  Place moved(Place place, std::int32_t cells) const;
  bool check_writable(const Value& target, Position at);
  void mark_written(const Value& target);
  /// The expression is that of a variable or a part of one; `value` is its value.
  void note(const Expression& e, const Value& value, Reference access);
  void note_read(const Expression& root, const Value& value);
  /// The value of what is written or called: no reading of it.
  Value target(const Expression& e);
  /// The variable that a reference is made to, which is read and written through it; an error when it may not
  /// be.
  Value referred(const Expression& e);
  void check_range(const Type& type, const Value& value, std::int32_t cell);

  // calls
  Value call(const Expression& e, const Type* expected);
  Value enabled_call(const Expression& e, const Type* expected);
  Value plain_call(const Expression& e, const Type* expected);
  const Type* instance_type(const Expression& e) const;
  bool has_own_control(const Expression& callee) const;
  Value call_function(Pou& function, const Expression& e);
  struct MethodCall {
    Pou* instance = nullptr;
    MethodDeclaration method;
    const Expression* of = nullptr;  ///< the variable that is the instance; none: the running one
    Pou* prototype = nullptr;        ///< of the interface that `of` is a value of
  };
  MethodDeclaration own_method(const Expression& callee) const;
  std::optional<MethodCall> called_method(const Expression& callee) const;
  bool is_accessible(const MethodCall& called) const;
  Value call_method(const MethodCall& called, const Expression& e);
  Value call_interface(const MethodCall& called, const Expression& e);
  void require_instance(std::int32_t value);
  void copy_cells(std::int32_t to, std::int32_t from, std::size_t count);
  Value call_with_frame(const Pou& method, std::int32_t self, const Expression& e);
  void call_block(const Value& instance, const Expression& e);
  void call_program(Pou& program, const Expression& e);
  bool bind(const Pou& pou, const Expression& e, bool is_block, std::vector<const Argument*>& bound);
  std::vector<std::int32_t> reference(const Argument& argument, const Variable& parameter);
  void give_output(const Argument& argument, const Value& output);
  std::optional<Value> standard_function(const Expression& e, const Type* expected);
  std::optional<Value> ladder_function(const Expression& e);
  Value move_converted(const Expression& to, const Value& value);
  Value disassemble(const Expression& count, const Expression& to, const Value& value, Position at);
  std::optional<Value> conversion(const Expression& e, const std::string& name);
  Value converted_to(const Value& value, const Type& to, bool truncate, Position at);
  Value converted_digits(const Value& value, const Type& to, bool from_digits, Position at);
  Value byte_order(bool reverse, const Value& value, const Expression& e);
  Value validity(bool digits, const Value& value, const Expression& e);
  Value selection(const std::string& name, const Expression& e, std::vector<Value> values,
                  const Type* expected);
  const Type* selected_type(const std::string& name, std::span<const Value> values, Position at);
  void store_chosen(const Value& target, const Value& selector, std::span<const Value> values, Position at);
  Value extreme_literal(const std::string& name, std::vector<Value> values, Position at);
  Value shift(const std::string& name, const std::vector<Value>& values, const Expression& e);
  Value string_function(const std::string& name, const std::vector<Value>& values, const Expression& e);
  Value plc_time(Kind kind);
  Value math_function(MathFunction function, const std::vector<Value>& values, const Expression& e,
                      const Type* expected);
  Value test_function(const std::string& name, const std::vector<Value>& values, const Expression& e);
  Value string_result(StringFunction function, std::span<const std::int32_t> arguments, std::uint32_t length,
                      bool wide = false);

  // statements
  void statement(const Statement& s);
  void assign(const Statement& s);
  void attempt(const Value& target, const Value& value, Position at);
  void attempt_reference(const Value& target, const Value& value, Position at);
  void if_statement(const Statement& s);
  void case_statement(const Statement& s);
  void case_label(const CaseLabel& label, const Value& selector, std::vector<std::size_t>& jumps,
                  std::vector<std::pair<std::int64_t, std::int64_t>>& seen);
  void for_statement(const Statement& s);
  void while_statement(const Statement& s);
  void repeat_statement(const Statement& s);
  void define(const Statement& s);
  void label(const Statement& s);
  void finish_jumps();
  std::int32_t condition(const Expression& e, const char* what);
  bool in_test() const;

  struct Loop {
    std::vector<std::size_t> exits, continues;
  };

  Unit& unit_;
  Pou* pou_;
  Emitter emit_;
  std::vector<Loop> loops_;
  std::vector<std::size_t> returns_;
  std::map<std::string, Value, std::less<>> defined_;  ///< intermediate values of diagrams
  std::map<std::string, std::size_t, std::less<>> labels_;
  struct Jump {
    std::size_t instruction;
    std::string label, text;
    Position at;
  };
  std::vector<Jump> jumps_;
  const Expression* target_ = nullptr;    ///< root of what is written
  const Expression* accessed_ = nullptr;  ///< the whole of a.b[i] while its parts are translated
};

}  // namespace trunnion::st
