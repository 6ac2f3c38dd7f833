// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/declarations.hpp"

#include <map>

#include "plc/semantics/type.hpp"

namespace trunnion::st::plcopen {
namespace {

const std::map<std::string_view, const char*> sections = {
    {"inputVars", "VAR_INPUT"},  {"outputVars", "VAR_OUTPUT"}, {"inOutVars", "VAR_IN_OUT"},
    {"localVars", "VAR"},        {"tempVars", "VAR_TEMP"},     {"externalVars", "VAR_EXTERNAL"},
    {"globalVars", "VAR_GLOBAL"}};

/// The value of `holder` (initialValue, value): simpleValue, arrayValue or structValue.
std::optional<Tokens> value_words(Document& document, Node holder, int depth) {
  const auto inside = children(holder);
  if (inside.size() != 1 || depth > deepest_element) {
    document.error(holder, "expected one simpleValue, arrayValue or structValue");
    return std::nullopt;
  }
  const auto value = inside[0];
  if (local_name(value) == "simpleValue") return document.expression(value, "value");
  const bool is_array = local_name(value) == "arrayValue";
  if (!is_array && local_name(value) != "structValue") {
    document.error(
        value, "expected simpleValue, arrayValue or structValue, found " + std::string(local_name(value)));
    return std::nullopt;
  }
  auto result = document.words(is_array ? "[" : "(", value);
  bool first = true;
  for (const auto one : children(value, "value")) {
    if (!first) append(result, document.words(",", one));
    first = false;
    auto inner = value_words(document, one, depth + 1);
    if (!inner) return std::nullopt;
    const auto repetition = attribute(one, "repetitionValue");
    if (!is_array) {
      auto member = document.name(one, "member");
      if (!member) return std::nullopt;
      append(result, std::move(*member));
      append(result, document.words(":=", one));
    } else if (!repetition.empty() && repetition != "1") {
      auto count = document.expression(one, "repetitionValue");
      if (!count) return std::nullopt;
      append(result, std::move(*count));
      append(result, document.words("(", one));
      append(*inner, document.words(")", one));
    }
    append(result, std::move(*inner));
  }
  append(result, document.words(is_array ? "]" : ")", value));
  return result;
}

/// name AT address : type := value;
Tokens variable_words(Document& document, Node variable, int depth) {
  auto words = document.name(variable, "name");
  const auto type = child(variable, "type");
  if (!type) document.error(variable, "the variable '" + attribute(variable, "name") + "' has no type");
  auto type_tokens = type ? type_words(document, type, depth) : std::nullopt;
  if (!words || !type_tokens) return {};
  if (const auto address = attribute(variable, "address"); !address.empty()) {
    auto where = document.words(address, variable);
    if (where.size() != 1 || where[0].kind != TokenKind::direct) {
      document.error(variable, "'" + address + "' is no address like %IX0.3 or %W10");
      return {};
    }
    append(*words, document.words("AT", variable));
    append(*words, std::move(where));
  }
  append(*words, document.words(":", variable));
  append(*words, std::move(*type_tokens));
  if (const auto initial = child(variable, "initialValue")) {
    auto value = value_words(document, initial, depth);
    if (!value) return {};
    append(*words, document.words(":=", initial));
    append(*words, std::move(*value));
  }
  append(*words, document.words(";", variable));
  return std::move(*words);
}

std::optional<Tokens> array_words(Document& document, Node type, int depth) {
  auto result = document.words("ARRAY[", type);
  bool first = true;
  for (const auto dimension : children(type, "dimension")) {
    if (!first) append(result, document.words(",", dimension));
    first = false;
    auto low = document.expression(dimension, "lower"), high = document.expression(dimension, "upper");
    if (!low || !high) return std::nullopt;
    append(result, std::move(*low));
    append(result, document.words("..", dimension));
    append(result, std::move(*high));
  }
  append(result, document.words("] OF", type));
  auto element = type_words(document, child(type, "baseType"), depth + 1);
  if (!element) return std::nullopt;
  append(result, std::move(*element));
  return result;
}

std::optional<Tokens> enumeration_words(Document& document, Node type) {
  auto result = document.words("(", type);
  bool first = true;
  for (const auto value : children(child(type, "values"), "value")) {
    if (!first) append(result, document.words(",", value));
    first = false;
    auto name = document.name(value, "name");
    if (!name) return std::nullopt;
    append(result, std::move(*name));
    if (attribute(value, "value").empty()) continue;
    auto number = document.expression(value, "value");
    if (!number) return std::nullopt;
    append(result, document.words(":=", value));
    append(result, std::move(*number));
  }
  append(result, document.words(")", type));
  return result;
}

std::optional<Tokens> subrange_words(Document& document, Node type, int depth) {
  const auto range = child(type, "range");
  auto base = type_words(document, child(type, "baseType"), depth + 1);
  if (!base) return std::nullopt;
  auto low = document.expression(range, "lower"), high = document.expression(range, "upper");
  if (!low || !high) return std::nullopt;
  append(*base, document.words("(", type));
  append(*base, std::move(*low));
  append(*base, document.words("..", type));
  append(*base, std::move(*high));
  append(*base, document.words(")", type));
  return base;
}

}  // namespace

std::optional<Tokens> type_words(Document& document, Node holder, int depth) {
  const auto inside = children(holder);
  if (inside.size() != 1 || depth > deepest_element) {
    document.error(holder,
                   depth > deepest_element ? "types contain each other too deeply" : "expected one type");
    return std::nullopt;
  }
  const auto type = inside[0];
  const auto name = local_name(type);
  const auto upper = upper_case(name);
  if (name == "derived") return document.name(type, "name");
  if (name == "array") return array_words(document, type, depth);
  if (name == "enum") return enumeration_words(document, type);
  if (name == "subrangeSigned" || name == "subrangeUnsigned") return subrange_words(document, type, depth);
  if (name == "struct") {
    auto result = document.words("STRUCT", type);
    for (const auto field : children(type, "variable"))
      append(result, variable_words(document, field, depth + 1));
    append(result, document.words("END_STRUCT", type));
    return result;
  }
  if (upper == "STRING" || upper == "WSTRING") {
    auto result = document.words(upper, type);
    if (attribute(type, "length").empty()) return result;
    auto length = document.expression(type, "length");
    if (!length) return std::nullopt;
    append(result, document.words("[", type));
    append(result, std::move(*length));
    append(result, document.words("]", type));
    return result;
  }
  if (elementary(upper) != nullptr) return document.words(upper, type);
  document.error(type, "the type '" + std::string(name) + "' is not available");
  return std::nullopt;
}

Tokens data_types(Document& document, Node types) {
  Tokens result;
  for (const auto one : children(types, "dataType")) {
    auto name = document.name(one, "name");
    auto type = type_words(document, child(one, "baseType"));
    if (!name || !type) continue;
    append(result, document.words("TYPE", one));
    append(result, std::move(*name));
    append(result, document.words(":", one));
    append(result, std::move(*type));
    if (const auto initial = child(one, "initialValue"))
      if (auto value = value_words(document, initial, 0)) {
        append(result, document.words(":=", initial));
        append(result, std::move(*value));
      }
    append(result, document.words("; END_TYPE", one));
  }
  return result;
}

Tokens variable_list(Document& document, Node list) {
  const auto section = sections.find(local_name(list));
  if (section == sections.end()) {
    document.error(list, "'" + std::string(local_name(list)) + "' is not available");
    return {};
  }
  auto result = document.words(section->second, list);
  const auto is_set = [&](const char* name) { return attribute(list, name) == "true"; };
  if (is_set("constant")) append(result, document.words("CONSTANT", list));
  if (is_set("retain") || is_set("persistent")) append(result, document.words("RETAIN", list));
  for (const auto variable : children(list, "variable"))
    append(result, variable_words(document, variable, 0));
  append(result, document.words("END_VAR", list));
  return result;
}

}  // namespace trunnion::st::plcopen
