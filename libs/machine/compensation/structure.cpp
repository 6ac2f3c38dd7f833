// SPDX-License-Identifier: Apache-2.0
#include "compensation/structure.hpp"

#include <sstream>

#include "canonical/axes.hpp"

namespace trunnion::volumetric {

std::variant<std::vector<StructureAxis>, std::string> parse_structure(const std::string& notation) {
  std::string text = notation;
  if (text.size() > 1 && text.front() == '[' && text.back() == ']') text = text.substr(1, text.size() - 2);
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  if (words.size() < 3 || words.front() != "w" || words.back() != "t")
    return "a structure begins with w and ends with t: w C' A' b X Y Z (S) t";
  words.erase(words.begin()), words.pop_back();
  if (words.back() == "(S)") words.pop_back();
  bool bed = false;
  std::vector<StructureAxis> structure;
  for (const auto& word : words) {
    if (word == "b") {
      if (bed) return "the bed b is there twice";
      bed = true;
      continue;
    }
    const bool workpiece = word.size() == 2 && word[1] == '\'';
    if (workpiece == bed) return "'" + word + "': axes with ' are before b, axes without it after b";
    const auto axis = canonical::axis_letters.find(word[0]);
    if (axis == std::string_view::npos || word.size() != (workpiece ? 2u : 1u))
      return "the machine has no linear or rotary axis '" + (workpiece ? word.substr(0, 1) : word) +
             "' in its kinematic chain";
    structure.push_back({axis, workpiece});
  }
  if (!bed) return "the bed b is missing";
  return structure;
}

}  // namespace trunnion::volumetric
