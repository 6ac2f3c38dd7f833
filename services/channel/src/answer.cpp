#include "answer.hpp"

#include <cstdio>

namespace trunnion::channel {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace trunnion::channel
