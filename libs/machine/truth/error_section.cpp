// SPDX-License-Identifier: Apache-2.0
#include "truth/error_section.hpp"

namespace trunnion::truth {
namespace {

constexpr std::size_t most_terms = 32, most_coefficients = 8, most_points = 1000;
constexpr machine::Limits values{-1e5, 1e5}, positions{-1e5, 1e5}, widths{1e-3, 1e5};

// One term. Keys carry the units of the value and of the position.
class Term {
 public:
  Term(const machine::YamlReader& reader, const YAML::Node& node, bool angle, bool rotary)
      : reader_(reader),
        node_(node),
        value_(angle ? "_urad" : "_um"),
        place_(rotary ? "_deg" : "_mm"),
        unit_(angle ? 1e-6 : 1e-3) {}

  void read(ErrorFunction& function) {
    const std::string kinds[] = {"polynomial" + value_, "harmonic" + value_, "table" + value_,
                                 "reversal" + value_};
    int count = 0;
    for (const auto& kind : kinds) count += static_cast<bool>(node_[kind]);
    if (count != 1)
      reader_.fail(node_,
                   "a term has one of " + kinds[0] + ", " + kinds[1] + ", " + kinds[2] + " and " + kinds[3]);
    ErrorTerms* terms = &function.terms;
    if (const auto approach = node_["approach"])
      terms = reader_.choice<ErrorTerms*>(
          approach, {{"positive", &function.positive}, {"negative", &function.negative}});
    if (node_[kinds[0]]) {
      terms->polynomials.push_back(polynomial());
    } else if (node_[kinds[1]]) {
      terms->harmonics.push_back(harmonic());
    } else if (node_[kinds[2]]) {
      terms->tables.push_back(table());
    } else {
      only(kinds[3] + ", position_of");
      function.reversal += unit_ * reader_.number(node_[kinds[3]], values);
    }
  }

 private:
  void only(const std::string& keys) const {
    reader_.each(node_, keys, [&](const std::string& key, const YAML::Node&) {
      return (", " + keys + ",").find(", " + key + ",") != std::string::npos;
    });
  }
  double optional(const std::string& key, double otherwise, machine::Limits limits) const {
    return node_[key] ? reader_.number(node_[key], limits) : otherwise;
  }
  YAML::Node required(const std::string& key) const {
    if (!node_[key]) reader_.fail(node_, "'" + key + "' is missing");
    return node_[key];
  }

  Polynomial polynomial() const {
    only("polynomial" + value_ + ", origin" + place_ + ", unit" + place_ + ", approach, position_of");
    Polynomial p;
    p.coefficients = reader_.numbers(node_["polynomial" + value_], most_coefficients, values);
    for (double& c : p.coefficients) c *= unit_;
    p.origin = optional("origin" + place_, 0, positions);
    p.unit = optional("unit" + place_, place_ == "_mm" ? 1000 : 360, widths);
    return p;
  }

  Harmonic harmonic() const {
    only("harmonic" + value_ + ", period" + place_ + ", phase_deg, approach, position_of");
    return {reader_.number(required("period" + place_), widths),
            unit_ * reader_.number(node_["harmonic" + value_], values),
            optional("phase_deg", 0, {-360, 360})};
  }

  Table table() const {
    only("table" + value_ + ", positions" + place_ + ", interpolation, modulo" + place_ +
         ", approach, position_of");
    Table t;
    const auto at = required("positions" + place_), of = node_["table" + value_];
    t.positions = reader_.numbers(at, most_points, positions);
    t.values = reader_.numbers(of, most_points, values);
    for (double& value : t.values) value *= unit_;
    if (t.values.size() != t.positions.size())
      reader_.fail(of, std::to_string(t.values.size()) + " values for " + std::to_string(t.positions.size()) +
                           " positions");
    for (std::size_t i = 1; i < t.positions.size(); ++i)
      if (!(t.positions[i] - t.positions[i - 1] >= 1e-3))
        reader_.fail(at[i], "the positions must ascend by 0.001 or more");
    if (node_["interpolation"])
      t.cubic = reader_.choice<bool>(node_["interpolation"], {{"linear", false}, {"cubic", true}});
    t.modulo = optional("modulo" + place_, 0, widths);
    if (t.modulo > 0 && !(t.positions.back() - t.positions.front() <= t.modulo - 1e-3))
      reader_.fail(at, "the positions must be within one period, its end left out");
    return t;
  }

  const machine::YamlReader& reader_;
  const YAML::Node& node_;
  std::string value_, place_;
  double unit_;
};

}  // namespace

std::vector<ComponentError> read_errors(
    const machine::YamlReader& reader, const YAML::Node& list, std::size_t axis, std::size_t component,
    const std::function<std::size_t(const YAML::Node&, const std::string&)>& axis_of,
    const std::function<bool(std::size_t)>& rotary) {
  if (!list.IsSequence() || list.size() == 0 || list.size() > most_terms)
    reader.fail(list, "expected a list of 1 .. " + std::to_string(most_terms) + " terms");
  std::vector<ComponentError> errors;
  for (const auto& node : list) {
    if (!node.IsMap()) reader.fail(node, "a term is a map, for example {harmonic_um: 2, period_mm: 10}");
    const auto name = node["position_of"];
    const std::size_t source = name ? axis_of(name, reader.text(name)) : axis;
    auto error = errors.begin();
    while (error != errors.end() && error->source != source) ++error;
    if (error == errors.end()) error = errors.insert(errors.end(), {component, source, {}});
    Term(reader, node, component > 2, rotary(source)).read(error->function);
  }
  return errors;
}

}  // namespace trunnion::truth
