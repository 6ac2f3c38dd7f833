// SPDX-License-Identifier: Apache-2.0
// An XML document with the places of its elements.
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "plc/syntax/token.hpp"

namespace trunnion::st::plcopen {

using Node = pugi::xml_node;

/// What is at a place and behind it, for messages.
struct ElementPlace {
  Position at;
  std::string text;  ///< POU 'main', network 3, contact with localId 12
};

class Document {
 public:
  /// Reads the whole text. What is no XML is reported; root() is empty then.
  Document(std::string_view text, std::uint16_t file, Diagnostics& diagnostics);

  Node root() const { return document_.document_element(); }
  Position at(Node node) const;
  std::uint16_t file() const { return file_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  void error(Node node, const std::string& text) { diagnostics_.error(at(node), text); }

  /// The words of Structured Text, all at the place of `node`.
  Tokens words(std::string_view text, Node node);
  /// The text of the element and of those in it, each word at its own place.
  Tokens content(Node node);
  /// The content, or the attribute, as one expression; nothing when it is none, which is reported.
  std::optional<Tokens> expression(Node node);
  std::optional<Tokens> expression(Node node, const char* attribute);
  /// The attribute as a name; nothing when it is none, which is reported.
  std::optional<Tokens> name(Node node, const char* attribute);

 private:
  Position position(std::ptrdiff_t offset) const;
  void append_content(Node node, Tokens& tokens, int depth);

  pugi::xml_document document_;
  std::vector<std::size_t> lines_;  ///< offset of each line's first byte
  std::uint16_t file_;
  Diagnostics& diagnostics_;
};

/// The name of an element without the prefix of its namespace.
std::string_view local_name(Node node);
/// The first element in `node` of this name.
Node child(Node node, std::string_view name);
/// The elements in `node`, of this name when one is given.
std::vector<Node> children(Node node, std::string_view name = "");
std::string attribute(Node node, const char* name);

/// Elements of types and values that contain each other.
inline constexpr int deepest_element = 50;

}  // namespace trunnion::st::plcopen
