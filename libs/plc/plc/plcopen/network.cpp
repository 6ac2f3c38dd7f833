// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/network.hpp"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <tuple>

namespace trunnion::st::plcopen {
namespace {

const std::map<std::string_view, Element::Kind> element_kinds = {
    {"leftPowerRail", Element::Kind::power_rail},
    {"rightPowerRail", Element::Kind::right_rail},
    {"contact", Element::Kind::contact},
    {"coil", Element::Kind::coil},
    {"block", Element::Kind::block},
    {"inVariable", Element::Kind::in_variable},
    {"outVariable", Element::Kind::out_variable},
    {"inOutVariable", Element::Kind::in_out_variable},
    {"connector", Element::Kind::connector},
    {"continuation", Element::Kind::continuation},
    {"label", Element::Kind::label},
    {"jump", Element::Kind::jump},
    {"return", Element::Kind::return_}};

template <class Number>
Number number(const std::string& text) {
  Number value{};
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

Edge edge_of(Node node) {
  const auto text = attribute(node, "edge");
  return text == "rising" ? Edge::rising : text == "falling" ? Edge::falling : Edge::none;
}

class NetworkReader {
  using Kind = Element::Kind;

 public:
  NetworkReader(Document& document, Node body) : document_(document), body_(body) {}

  Diagram run() {
    for (const auto node : children(body_)) read(node);
    for (auto& element : diagram_.elements) {
      const bool counts = element.kind != Kind::right_rail;
      for (auto& input : element.inputs) connect(input, counts);
      for (auto& input : element.in_outs) connect(input, counts);
    }
    number_networks();
    return std::move(diagram_);
  }

 private:
  void read(Node node) {
    const auto name = local_name(node);
    if (name == "comment" || name == "documentation" || name == "vendorElement") return;
    const auto found = element_kinds.find(name);
    if (found == element_kinds.end())
      return document_.error(
          node, "'" + std::string(name) + "' is not available in ladder and function block diagrams");
    Element element;
    element.kind = found->second;
    element.node = node;
    element.id = attribute(node, "localId");
    const auto position = child(node, "position");
    element.x = number<double>(attribute(position, "x")),
    element.y = number<double>(attribute(position, "y"));
    element.order = number<std::uint64_t>(attribute(node, "executionOrderId"));
    element.negated = attribute(node, "negated") == "true";
    element.edge = edge_of(node);
    const auto storage = attribute(node, "storage");
    element.storage = storage == "set" ? Storage::set : storage == "reset" ? Storage::reset : Storage::none;
    if (!read_content(element)) return;
    if (!ids_.emplace(element.id, diagram_.elements.size()).second)
      return document_.error(node, "the localId '" + element.id + "' is used twice in this body");
    diagram_.elements.push_back(std::move(element));
  }

  bool read_content(Element& element) {
    const auto node = element.node;
    switch (element.kind) {
      case Kind::contact:
      case Kind::coil:
        if (!value(element, "variable")) return false;
        break;
      case Kind::in_variable:
      case Kind::out_variable:
      case Kind::in_out_variable:
        if (!value(element, "expression")) return false;
        break;
      case Kind::block:
        return read_block(element);
      case Kind::connector:
      case Kind::continuation:
        element.name = attribute(node, "name");
        break;
      case Kind::label:
      case Kind::jump: {
        const auto name = document_.name(node, "label");
        if (!name) return false;
        element.name = (*name)[0].text;
        break;
      }
      default:
        break;
    }
    if (const auto in = child(node, "connectionPointIn")) element.inputs.push_back(input_of("", in, in));
    return true;
  }

  bool value(Element& element, const char* name) {
    const auto inner = child(element.node, name);
    if (!inner) {
      document_.error(element.node, "the variable is missing");
      return false;
    }
    auto words = document_.expression(inner);
    if (!words) return false;
    element.value = std::move(*words);
    return true;
  }

  bool read_block(Element& element) {
    const auto node = element.node;
    const auto type = document_.name(node, "typeName");
    if (!type) return false;
    element.name = (*type)[0].text;
    if (!attribute(node, "instanceName").empty()) {
      auto instance = document_.expression(node, "instanceName");
      if (!instance) return false;
      element.instance = std::move(*instance);
    }
    const auto read_inputs = [&](const char* list, std::vector<Input>& inputs) {
      for (const auto variable : children(child(node, list), "variable"))
        inputs.push_back(
            input_of(attribute(variable, "formalParameter"), variable, child(variable, "connectionPointIn")));
    };
    read_inputs("inputVariables", element.inputs);
    read_inputs("inOutVariables", element.in_outs);
    for (const auto variable : children(child(node, "outputVariables"), "variable"))
      element.outputs.push_back({parameter(attribute(variable, "formalParameter"), variable),
                                 attribute(variable, "negated") == "true"});
    return true;
  }

  /// The name of a parameter, which may be missing.
  std::string parameter(std::string name, Node node) {
    return name.empty() || document_.name(node, "formalParameter") ? name : "";
  }

  Input input_of(std::string name, Node holder, Node point) {
    Input input;
    input.name = parameter(std::move(name), holder);
    input.negated = attribute(holder, "negated") == "true";
    input.edge = edge_of(holder);
    input.at = holder;
    if (const auto inner = child(point, "expression")) input.expression = document_.expression(inner);
    for (const auto connection : children(point, "connection"))
      input.sources.push_back(
          {0, upper_case(parameter(attribute(connection, "formalParameter"), connection)), connection});
    return input;
  }

  void connect(Input& input, bool counts) {
    std::vector<Source> found;
    for (auto& source : input.sources) {
      const auto id = attribute(source.at, "refLocalId");
      const auto element = ids_.find(id);
      if (element == ids_.end()) {
        document_.error(source.at, "there is no element with the localId '" + id + "'");
        continue;
      }
      source.element = element->second;
      if (counts) ++diagram_.elements[source.element].consumers;
      found.push_back(source);
    }
    input.sources = std::move(found);
  }

  std::size_t root(std::size_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

  void number_networks() {
    auto& elements = diagram_.elements;
    parents_.resize(elements.size());
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (elements[i].kind == Kind::right_rail) continue;
      for (const auto* list : {&elements[i].inputs, &elements[i].in_outs})
        for (const auto& input : *list)
          for (const auto& source : input.sources)
            if (elements[source.element].kind != Kind::power_rail) parents_[root(i)] = root(source.element);
    }
    std::map<std::string, std::size_t> connectors;
    for (std::size_t i = 0; i < elements.size(); ++i)
      if (elements[i].kind == Kind::connector) connectors.emplace(elements[i].name, i);
    for (std::size_t i = 0; i < elements.size(); ++i)
      if (elements[i].kind == Kind::continuation)
        if (const auto found = connectors.find(elements[i].name); found != connectors.end())
          parents_[root(i)] = root(found->second);

    struct Extent {
      double top = 0, bottom = 0, left = 0;
      std::uint64_t order = 0;
      std::size_t first = 0, root = 0;
      bool is_label = false;
    };
    std::map<std::size_t, Extent> extents;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const auto& e = elements[i];
      if (e.kind == Kind::power_rail || e.kind == Kind::right_rail) continue;
      const auto [at, is_new] =
          extents.try_emplace(root(i), Extent{e.y, e.y, e.x, e.order, i, root(i), e.kind == Kind::label});
      if (is_new) continue;
      auto& extent = at->second;
      extent.top = std::min(extent.top, e.y), extent.bottom = std::max(extent.bottom, e.y);
      extent.left = std::min(extent.left, e.x);
      if (e.order > 0) extent.order = extent.order == 0 ? e.order : std::min(extent.order, e.order);
    }
    std::vector<Extent> sorted;
    for (const auto& [key, extent] : extents) sorted.push_back(extent);
    // A label stands beside the first elements of its network.
    for (auto& label : sorted)
      if (label.is_label)
        for (const auto& other : sorted)
          if (!other.is_label && other.top < label.top && label.top <= other.bottom) label.top = other.top;
    std::sort(sorted.begin(), sorted.end(), [](const Extent& a, const Extent& b) {
      const auto key = [](const Extent& e) {
        return std::tuple(e.order, e.top, !e.is_label, e.left, e.first);
      };
      return key(a) < key(b);
    });
    std::map<std::size_t, std::size_t> numbers;
    for (const auto& extent : sorted) numbers.emplace(extent.root, numbers.size());
    for (std::size_t i = 0; i < elements.size(); ++i)
      if (const auto found = numbers.find(root(i)); found != numbers.end())
        elements[i].network = found->second;
    diagram_.networks = numbers.size();
  }

  Document& document_;
  Node body_;
  Diagram diagram_;
  std::map<std::string, std::size_t> ids_;
  std::vector<std::size_t> parents_;
};

}  // namespace

std::string Diagram::described(const Element& element) {
  std::string name(local_name(element.node));
  if (element.kind == Element::Kind::block) name += " " + element.name;
  return name + " with localId " + element.id;
}

Diagram read_diagram(Document& document, Node body) { return NetworkReader(document, body).run(); }

}  // namespace trunnion::st::plcopen
