// SPDX-License-Identifier: Apache-2.0
#include "hand_over.hpp"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace trunnion::channel {
namespace {

// Every field by name, for writing and reading.
template <class Modal, class Visit>
void visit_modal(Modal& modal, Visit&& v) {
  Modal::fields(modal, [&](const std::string& name, auto& field) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, canonical::Tilt>) {
      v("modal.tilt.active", field.active);
      for (std::size_t i = 0; i < field.origin.size(); ++i)
        v("modal.tilt.origin." + std::to_string(i), field.origin[i]);
      for (std::size_t i = 0; i < field.matrix.size(); ++i)
        v("modal.tilt.matrix." + std::to_string(i), field.matrix[i]);
    } else {
      v("modal." + name, field);
    }
  });
}

template <class Fields, class Visit>
void visit(Fields& h, Visit&& v) {
  v("mode", h.mode), v("program", h.program), v("program_revision", h.program_revision);
  v("tool", h.tool), v("feed_override", h.feed_override), v("rapid_override", h.rapid_override);
  v("spindle_override", h.spindle_override), v("spindle_programmed", h.spindle_programmed);
  v("single_block", h.single_block), v("optional_stop", h.optional_stop);
  v("reset_count", h.reset_count);
  visit_modal(h.modal, v);
}

// The last value of each enumeration that this build knows.
constexpr unsigned last(idl::channel::Mode) { return static_cast<unsigned>(idl::channel::Mode::REF); }
constexpr unsigned last(language::Plane) { return static_cast<unsigned>(language::Plane::yz); }
constexpr unsigned last(language::FeedMode) {
  return static_cast<unsigned>(language::FeedMode::per_revolution);
}
constexpr unsigned last(language::PathControl) {
  return static_cast<unsigned>(language::PathControl::exact_stop);
}
constexpr unsigned last(language::Transformation) {
  return static_cast<unsigned>(language::Transformation::rtcp);
}
constexpr unsigned last(language::CutterSide) { return static_cast<unsigned>(language::CutterSide::right); }
constexpr unsigned last(language::SpindleMode) {
  return static_cast<unsigned>(language::SpindleMode::surface);
}
constexpr unsigned last(language::SpindleDirection) {
  return static_cast<unsigned>(language::SpindleDirection::ccw);
}
constexpr unsigned last(bool) { return 1; }

template <class Value>
std::string text_of(const Value& value) {
  char text[64];
  if constexpr (std::is_same_v<Value, std::string>)
    return value;
  else if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, bool>)
    return std::to_string(static_cast<unsigned>(value));
  else
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

template <class Number>
bool parse(std::string_view text, Number& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc{} && result.ptr == text.data() + text.size();
}

// An enumeration may have grown in another build: what this one does not know it refuses.
template <class Value>
bool assign(std::string_view text, Value& value) {
  if constexpr (std::is_same_v<Value, std::string>) {
    value = text;
    return true;
  } else if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, bool>) {
    unsigned number = 0;
    if (!parse(text, number) || number > last(Value{})) return false;
    value = static_cast<Value>(number);
    return true;
  } else if constexpr (std::is_floating_point_v<Value>) {
    Value number = 0;
    if (!parse(text, number) || !std::isfinite(number)) return false;
    value = number;
    return true;
  } else {
    return parse(text, value);
  }
}

}  // namespace

std::string write_hand_over(const HandOver& hand_over, const std::string& boot) {
  std::string out = "boot " + boot + "\n";
  visit(hand_over,
        [&](const std::string& name, const auto& value) { out += name + " " + text_of(value) + "\n"; });
  return out;
}

bool read_hand_over(const std::string& text, const std::string& file, const std::string& boot,
                    HandOver& hand_over) {
  const std::string_view all = text;
  if (!text.starts_with("boot " + boot + "\n")) return false;
  HandOver read = hand_over;
  std::size_t line = 1;
  for (std::size_t at = all.find('\n') + 1; at < all.size();) {
    ++line;
    const auto end = std::min(all.find('\n', at), all.size());
    const auto row = all.substr(at, end - at);
    at = end + 1;
    const auto space = std::min(row.find(' '), row.size());
    bool good = false;
    visit(read, [&](const std::string& name, auto& value) {
      if (!good && name == row.substr(0, space) && space < row.size())
        good = assign(row.substr(space + 1), value);
    });
    if (!good)
      throw std::runtime_error(file + ":" + std::to_string(line) + ": '" + std::string(row.substr(0, 60)) +
                               "' is nothing a channel hands over");
  }
  hand_over = std::move(read);
  return true;
}

}  // namespace trunnion::channel
