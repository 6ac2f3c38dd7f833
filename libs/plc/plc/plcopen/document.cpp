// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/document.hpp"

#include <algorithm>
#include <iterator>

#include "plc/syntax/parser.hpp"

namespace trunnion::st::plcopen {

Document::Document(std::string_view text, std::uint16_t file, Diagnostics& diagnostics)
    : file_(file), diagnostics_(diagnostics) {
  lines_.push_back(0);
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') lines_.push_back(i + 1);
  const auto result = document_.load_buffer(text.data(), text.size(),
                                            pugi::parse_default | pugi::parse_ws_pcdata, pugi::encoding_utf8);
  if (result) return;
  diagnostics_.error(position(result.offset),
                     std::string("this is no XML document: ") + result.description());
  document_.reset();
}

Position Document::position(std::ptrdiff_t offset) const {
  const auto place = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
  const auto line = std::prev(std::upper_bound(lines_.begin(), lines_.end(), place));
  return {file_, static_cast<std::uint32_t>(line - lines_.begin()) + 1,
          static_cast<std::uint32_t>(place - *line) + 1};
}

Position Document::at(Node node) const { return position(node.offset_debug()); }

Tokens Document::words(std::string_view text, Node node) {
  auto tokens = tokenize(text, file_, diagnostics_);
  tokens.pop_back();  // the end
  for (auto& token : tokens) token.at = at(node);
  return tokens;
}

void Document::append_content(Node node, Tokens& tokens, int depth) {
  for (const auto inner : node.children()) {
    if (inner.type() == pugi::node_element && depth < deepest_element)
      append_content(inner, tokens, depth + 1);
    if (inner.type() != pugi::node_pcdata && inner.type() != pugi::node_cdata) continue;
    const auto start = at(inner);
    Diagnostics found;
    auto words = tokenize(inner.value(), file_, found);
    words.pop_back();
    const auto moved = [&](Position place) {
      if (place.line == 1) place.column += start.column - 1;
      place.line += start.line - 1;
      return place;
    };
    for (const auto& diagnostic : found.sorted()) diagnostics_.error(moved(diagnostic.at), diagnostic.text);
    for (auto& word : words) word.at = moved(word.at);
    append(tokens, std::move(words));
  }
}

Tokens Document::content(Node node) {
  Tokens tokens;
  append_content(node, tokens, 0);
  return tokens;
}

std::optional<Tokens> Document::expression(Node node) {
  auto tokens = content(node);
  if (!is_expression(tokens, at(node), diagnostics_)) return std::nullopt;
  return tokens;
}

std::optional<Tokens> Document::expression(Node node, const char* attribute) {
  auto tokens = words(plcopen::attribute(node, attribute), node);
  if (!is_expression(tokens, at(node), diagnostics_)) return std::nullopt;
  return tokens;
}

std::optional<Tokens> Document::name(Node node, const char* attribute) {
  const auto text = plcopen::attribute(node, attribute);
  Diagnostics ignored;
  auto tokens = tokenize(text, file_, ignored);
  if (ignored.errors() == 0 && tokens.size() == 2 && tokens[0].kind == TokenKind::identifier &&
      tokens[0].text == text) {
    tokens.pop_back();
    tokens[0].at = at(node);
    return tokens;
  }
  error(node, text.empty() ? std::string("the attribute ") + attribute + " with a name is missing"
                           : "'" + text + "' is no name: letters, digits and _, a letter first");
  return std::nullopt;
}

std::string_view local_name(Node node) {
  const std::string_view name = node.name();
  const auto colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

Node child(Node node, std::string_view name) {
  for (const auto inner : node.children())
    if (inner.type() == pugi::node_element && local_name(inner) == name) return inner;
  return {};
}

std::vector<Node> children(Node node, std::string_view name) {
  std::vector<Node> result;
  for (const auto inner : node.children())
    if (inner.type() == pugi::node_element && (name.empty() || local_name(inner) == name))
      result.push_back(inner);
  return result;
}

std::string attribute(Node node, const char* name) { return node.attribute(name).value(); }

}  // namespace trunnion::st::plcopen
