// SPDX-License-Identifier: Apache-2.0
#include "hand_over.hpp"

#include "field_lines.hpp"

namespace trunnion::channel {

std::string write_hand_over(const HandOver& hand_over, const std::string& boot) {
  return "boot " + boot + "\n" + write_lines(hand_over);
}

bool read_hand_over(const std::string& text, const std::string& file, const std::string& boot,
                    HandOver& hand_over) {
  if (!text.starts_with("boot " + boot + "\n")) return false;
  hand_over = read_lines(text, file, hand_over);
  return true;
}

}  // namespace trunnion::channel
