// SPDX-License-Identifier: Apache-2.0
// The elements of a body in ladder diagram or function block diagram, and how they are connected.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plc/plcopen/document.hpp"

namespace trunnion::st::plcopen {

enum class Edge { none, rising, falling };
enum class Storage { none, set, reset };

/// The output of an element that an input takes.
struct Source {
  std::size_t element = 0;
  std::string output;  ///< formal parameter, in capitals; empty: the only one
  Node at;
};

struct Input {
  std::string name;  ///< formal parameter as written
  bool negated = false;
  Edge edge = Edge::none;
  std::vector<Source> sources;       ///< several: OR
  std::optional<Tokens> expression;  ///< written at the input itself
  Node at;
};

struct Output {
  std::string name;  ///< formal parameter as written
  bool negated = false;
};

struct Element {
  enum class Kind {
    power_rail,  ///< the left one
    right_rail,
    contact,
    coil,
    block,
    in_variable,
    out_variable,
    in_out_variable,
    connector,
    continuation,
    label,
    jump,
    return_,
  };
  Kind kind = Kind::contact;
  Node node;
  std::string id;  ///< localId
  double x = 0, y = 0;
  std::uint64_t order = 0;  ///< executionOrderId; 0: none
  bool negated = false;
  Edge edge = Edge::none;
  Storage storage = Storage::none;
  Tokens value;      ///< variable or expression
  std::string name;  ///< of a connector or label; typeName of a block
  Tokens instance;   ///< of a function block
  std::vector<Input> inputs;
  std::vector<Input> in_outs;
  std::vector<Output> outputs;
  std::size_t consumers = 0;
  std::size_t network = 0;  ///< from 0

  bool is_function() const { return kind == Kind::block && instance.empty(); }
};

struct Diagram {
  std::vector<Element> elements;  ///< as in the document
  std::size_t networks = 0;

  /// contact with localId 12
  static std::string described(const Element& element);
};

/// Reads the body (LD or FBD). Networks are numbered from top to bottom: elements that are connected other
/// than by a power rail are of one network. Without positions they are in the order of the document.
Diagram read_diagram(Document& document, Node body);

}  // namespace trunnion::st::plcopen
