// SPDX-License-Identifier: Apache-2.0
// Everything that is known while sources are translated: types, variables, program organization units,
// memory.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "plc/machine/byte_code.hpp"
#include "plc/semantics/emitter.hpp"
#include "plc/semantics/reference.hpp"
#include "plc/semantics/value.hpp"
#include "plc/syntax/ast.hpp"

namespace trunnion::st {

/// Names of registers, in capitals.
using RegisterNames = std::map<std::string, RegisterAddress, std::less<>>;

struct Pou;

struct Variable {
  std::string name, text;
  Position at;
  const Type* type = nullptr;
  VariableSection section = VariableSection::local;
  bool retain = false;
  Value constant;  ///< of VAR CONSTANT with an elementary type
  bool is_constant = false;
  Place place;  ///< of in_out: the cell of the address
  bool used = false;
  std::vector<std::uint64_t> initial;  ///< cells
  bool pointed = false;                ///< of in_out: it has pointers, which may be used later than the call
  const Pou* declared_in = nullptr;    ///< of an instance of a function block: the block that declares it
  Access access = Access::protected_;
  bool is_internal = false;
  Variable* external = nullptr;  ///< of VAR_EXTERNAL: the global variable
};

/// A program, function, function block, test or method while it is translated and afterwards.
struct Pou {
  enum class State { declared, in_progress, done, failed };
  const PouDeclaration* declaration = nullptr;
  State state = State::declared;
  std::deque<Variable> variables;  ///< in the order of declaration
  std::map<std::string, Variable*, std::less<>> names;
  Variable* result = nullptr;  ///< of a function
  std::uint32_t routine = 0, frame = 0;
  std::uint32_t base = 0;              ///< of the only frame of a program, function or test
  Type type;                           ///< of the instances of a function block
  std::vector<std::uint64_t> initial;  ///< cells of the frame
  std::vector<std::uint32_t> timers;   ///< cells of the frame
  std::vector<Cells> retained;         ///< cells of the frame
  // Of a method. Its frame is among the intermediate results of whoever calls it.
  Pou* instance = nullptr;           ///< the function block whose variables it uses; SUPER() is a method too
  const Pou* declared_in = nullptr;  ///< the one that declares it
  std::uint32_t self = 0;            ///< cell of the frame with the address of the instance
  Interface* interface = nullptr;    ///< of a method of an interface, which calls that of the instance
  Position called_at;                ///< where it was needed first
  bool is_declared = false;          ///< its variables are
  const Pou* parent = nullptr;       ///< of a function block: the one that it extends
  /// Of a function block: its methods, by the block that declares them and their name.
  std::map<std::string, std::unique_ptr<Pou>, std::less<>> methods;

  bool is_method() const { return instance != nullptr || interface != nullptr; }
};

/// INTERFACE, while it is translated and afterwards.
struct Interface {
  const InterfaceDeclaration* declaration = nullptr;
  Type type;
  std::vector<Interface*> parents;
  std::map<std::string, std::unique_ptr<Pou>, std::less<>> methods;  ///< of this interface alone
};

/// Whether names, types and order of what a call gives and takes, and the result, are the same.
bool same_parameters(const Pou& a, const Pou& b);

/// As messages and the cross reference name it: Block.method.
std::string title_of(const Pou& pou);

/// The method of a function block that a name means.
struct MethodDeclaration {
  const PouDeclaration* declaration = nullptr;  ///< none: there is none
  const Pou* declared_in = nullptr;
};

struct Block {
  Pou* pou = nullptr;
};

/// The variables of a program in memory. Without CONFIGURATION each program has one of its own name.
struct Instance {
  Variable variable;  ///< its type is that of the program
  const Pou* pou = nullptr;
};

/// The translation of one set of sources.
class Unit {
 public:
  Unit(const SourceTree& tree, Diagnostics& diagnostics, const RegisterNames& registers,
       std::uint16_t library_files);

  /// Declares and translates everything.
  void run();

  // What declarations and bodies use:
  Diagnostics& diagnostics() { return diagnostics_; }
  /// The type of a specification; reports errors and returns the type `error`.
  const Type* type_of(const TypeSpec& spec, Pou* context);
  const Type* named_type(const std::string& upper);
  const Type* string_type(std::uint32_t length, bool wide = false);
  /// REF_TO or POINTER TO.
  const Type* reference_type(const Type& element, Kind kind = Kind::reference);
  /// The entry of ByteCode::pointed for variables of the type.
  std::int32_t pointed(const Type& type);
  /// The value of a constant expression, converted to the type; false when it is none, which is reported.
  bool constant(const Expression& expression, const Type& type, Pou* context, Value& value);
  /// Cells of an initial value.
  std::vector<std::uint64_t> initial_cells(const Expression* initial, const Type& type, Pou* context);
  /// The unit, translated; nullptr when there is none or it contains itself, which is reported at `at`.
  Pou* translated(const std::string& upper, Position at);
  Pou* find_pou(const std::string& upper);
  static MethodDeclaration find_method(const Pou& block, const std::string& upper);
  /// The method for instances of `instance`, translated; nullptr as for translated().
  Pou* method(Pou& instance, const MethodDeclaration& found, Position at);
  Interface* find_interface(const std::string& upper);
  /// The method of an interface, also of one that it extends; nullptr when there is none.
  Pou* prototype(Interface& interface, const std::string& upper);
  /// The method of an interface, translated: it calls that of the instance that its `self` names.
  const Pou* dispatcher(Pou& prototype, Position at);
  /// Whether the block, or one that it extends, has it behind IMPLEMENTS, or an interface that extends it.
  bool implements(const PouDeclaration& block, const Interface& interface);
  static bool extends(const Interface& interface, const Interface& other);
  /// The blocks of which values of interfaces name instances, by their number from 1.
  const std::vector<Pou*>& implementers() const { return implementers_; }
  std::uint64_t implementer_number(const Pou& block) const;
  Variable* find_global(const std::string& upper);
  /// An enumerated value of any type; nullptr when none or several have the name.
  const Enumerator* find_enumerator(const std::string& upper, const Type** type);
  const RegisterNames& registers() const { return registers_; }
  /// The place of a register, with its type.
  Value register_value(const RegisterAddress& address, const Type* type, Position at);
  /// Warns, once for each, of an address that had a function in another version.
  void warn_moved(const RegisterAddress& address, Position at);
  void use_register(std::uint32_t address, std::uint32_t count, bool written);
  std::uint32_t allocate(const std::vector<std::uint64_t>& initial);
  std::uint32_t string_constant(const std::string& text);
  std::int32_t range_entry(Range range);
  std::uint32_t add_routine(Emitter& emitter, std::uint32_t frame);
  void check_frame(const Pou& pou);
  /// Whether the rules of CoDeSys 2.3 for operands of different types hold here (docs/plc.md).
  bool is_codesys(Position at) const { return codesys_files.contains(at.file); }
  std::set<std::uint16_t> codesys_files;
  bool is_library(Position at) const { return at.file < library_files_; }
  /// Calls visit(pou, offset) for every instance of a function block in a variable of the type.
  static void each_block(const Type& type, std::uint32_t offset,
                         const std::function<void(const Pou&, std::uint32_t)>& visit);

  ByteCode code;
  std::deque<Variable> globals;
  std::map<std::string, Pou, std::less<>> pous;
  std::vector<Pou*> order;  ///< of translation
  std::deque<Instance> instances;
  std::vector<Reference> references;    ///< of bodies that are not the library's
  std::map<std::uint32_t, Loop> loops;  ///< by their Op::loop

  /// An instance that a CONFIGURATION declares.
  Variable* find_instance(const std::string& upper);
  /// Whether a CONFIGURATION says where the program runs, so that its name alone names no variables.
  bool is_configured(const Pou& pou) const;

  static constexpr std::uint32_t clock_offset_cell = image_cells;  ///< ns that a test has advanced the time

 private:
  void register_types();
  void build_types();
  void declare_globals(const VariableBlock& block);
  void declare_pous();
  const Type* enumeration(const TypeSpec& spec, const std::string& name);
  const Type* array(const TypeSpec& spec, Pou* context);
  const Type* open_array(const TypeSpec& spec, const Type* element);
  const Type* reference(const TypeSpec& element, Kind kind, Pou* context);
  const Type* named(const std::string& upper, const Type* type);
  const Type* structure(const TypeSpec& spec, const std::string& name, Pou* context);
  const Type* subrange(const TypeSpec& spec, const Type* base, Pou* context);
  const Type* build(const TypeSpec& spec, const std::string& name, Pou* context);
  void declare_variables(Pou& pou);
  void declare_variable(Pou& pou, const Pou& declared_in, const VariableBlock& block,
                        const VariableDeclaration& declaration);
  void declare_blocks(Pou& pou, const Pou& declared_in);
  void find_parent(Pou& pou);
  void translate(Pou& pou);
  bool complete(Pou& pou, Position at);
  /// For instances of the block that declares it; nullptr when it is not translated.
  static const Pou* declared_method(const MethodDeclaration& found);
  void check_methods(const Pou& block);
  void check_override(const Pou& block, const PouDeclaration& declaration);
  void check_abstract(const Pou& block);
  void compare_overrides(const Pou& block);
  void translate_methods();
  void declare_interfaces();
  void declare_prototypes();
  void translate_dispatcher(Pou& pou);
  void check_interfaces(const Pou& block);
  void refuse_retention(const Type& type, const std::string& name, Position at);
  bool locate(Variable& variable, const VariableDeclaration& declaration);
  void retain(const RegisterAddress& first, std::uint32_t count, Position at);
  void warn_unused(const Pou& pou);
  void declare_instances();
  Instance& add_instance(const Pou& pou, Variable variable, std::uint32_t base, bool retain);
  void add_tasks();
  void list_cells(const Expression& list, const Type& type, Pou* context, std::vector<std::uint64_t>& cells);
  void structure_cells(const Expression& list, const Type& type, Pou* context,
                       std::vector<std::uint64_t>& cells);
  void finish();

  const SourceTree& tree_;
  Diagnostics& diagnostics_;
  const RegisterNames& registers_;
  std::uint16_t library_files_;
  std::deque<Type> types_;
  std::map<std::string, const Type*, std::less<>> named_;
  std::map<std::string, const TypeDeclaration*, std::less<>> declared_;
  std::set<std::string> in_progress_;
  std::map<std::pair<const Type*, Kind>, const Type*> references_to_;
  std::vector<const Type*> pointed_types_;  ///< Pointed::element is the place of a type here
  std::vector<std::pair<Type*, std::string>> open_references_;  ///< to types that contain them
  const TypeSpec* in_out_spec_ = nullptr;                       ///< of the VAR_IN_OUT that is declared
  std::map<std::pair<std::uint32_t, bool>, const Type*> strings_;
  std::map<std::string, Variable*, std::less<>> global_names_;
  std::map<std::string, std::vector<std::pair<const Type*, const Enumerator*>>, std::less<>> enumerators_;
  std::map<std::string, std::uint32_t> string_constants_;
  std::set<std::pair<std::uint32_t, int>> moved_;  ///< address and bit, warned of
  std::map<std::uint32_t, bool> used_registers_;   ///< address -> written
  std::deque<Block> blocks_;
  std::map<std::string, Variable*, std::less<>> instance_names_;
  std::deque<PouDeclaration> task_declarations_;
  std::deque<Pou> tasks_;
  std::map<std::string, Interface, std::less<>> interfaces_;
  std::vector<Pou*> implementers_;
};

}  // namespace trunnion::st
