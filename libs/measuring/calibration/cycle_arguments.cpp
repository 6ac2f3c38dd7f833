// SPDX-License-Identifier: Apache-2.0
#include "calibration/cycle_arguments.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "calibration/circle_corrections.hpp"
#include "calibration/measurement_file.hpp"

namespace trunnion::calibration {
namespace {

constexpr std::string_view rotary_names = "ABCUVW";
constexpr unsigned variant = 1, probe_number = 3, sphere_diameter = 4, first_axis = 5, second_axis = 10;
constexpr unsigned tolerance = 15, measuring_path = 16, confidence = 17, touches_at_place = 18,
                   reserved_19 = 19, display = 20, reserved_21 = 21;

constexpr const char* argument_names[]{"",
                                       "S_MVAR",
                                       "name of the transformation",
                                       "number of the probe",
                                       "diameter of the sphere",
                                       "rotary axis 1, start angle of the touches",
                                       "rotary axis 1, start angle",
                                       "rotary axis 1, end angle",
                                       "rotary axis 1, number of points",
                                       "rotary axis 1, position of the other one",
                                       "rotary axis 2, start angle of the touches",
                                       "rotary axis 2, start angle",
                                       "rotary axis 2, end angle",
                                       "rotary axis 2, number of points",
                                       "rotary axis 2, position of the other one",
                                       "tolerance of the vectors",
                                       "measuring path",
                                       "confidence range",
                                       "number of measurements at one place",
                                       "argument 19",
                                       "plane and tolerance",
                                       "argument 21"};

/// A digit of a number, and the words of the inputs file that its values stand for; null: not used.
struct Digit {
  unsigned place;  // 0 = ones
  const char* key;
  std::array<const char*, 5> words;
};
// 11400: without reference, correct, complete measurement, on a circular path, without calibration.
constexpr Digit variant_digits[]{
    {0, "calibrate_probe", {"false", "true"}},
    {1, "positioning", {"circular", "paraxial"}},
    {2, "", {nullptr, nullptr, nullptr, nullptr, ""}},  // measure the kinematics completely: the only one
    {3, "mode", {"measure_only", "correct", "only_correct"}},
    {4, "reference", {nullptr, "without", "measure", "adapt"}},
};
constexpr Digit display_digits[]{
    {0, "plane", {"active", "G17", "G18", "G19"}}, {1, "", {"off", "on"}},  // the tolerance of the vectors
};

std::string shown(double value) { return fmt::format("{:.17g}", value); }
std::string short_number(double value) { return fmt::format("{:.10g}", value); }

[[noreturn]] void fail(unsigned argument, const std::string& why) {
  std::string text = "CYCLE9960, argument " + std::to_string(argument);
  text += std::string(" (") + argument_names[argument] + "): " + why;
  throw std::runtime_error(text);
}

class Writer {
 public:
  Writer(const CycleArguments& arguments, const MeasuredMachine& machine)
      : arguments_(arguments), machine_(machine) {}

  std::string text() {
    line(0, "{");
    digits(variant, variant_digits, true);
    only_one(probe_number, "this control has one probe");
    only_one(touches_at_place, "each place is touched once, by the fast and the slow touch of O9801");
    only_one(reserved_19, "nothing else is known of the manual");
    only_one(reserved_21, "nothing else is known of the manual");
    digits(display, display_digits, false);
    value(sphere_diameter, "sphere: {diameter_mm: ", "},");
    value(measuring_path, "measuring_path_mm: ", ",");
    value(confidence, "confidence_range_mm: ", ",");
    if (tolerance_on()) value(tolerance, "vector_tolerance_mm: ", ",");
    axes();
    line(0, "}");
    return std::move(text_);
  }
  // Of a line of text(), from 1; 0: of none.
  unsigned argument_of(std::size_t line) const {
    return line >= 1 && line <= arguments_of_lines_.size() ? arguments_of_lines_[line - 1] : 0;
  }

 private:
  const double* find(unsigned argument) const {
    const auto found = arguments_.find(argument);
    return found == arguments_.end() ? nullptr : &found->second;
  }
  void line(unsigned argument, const std::string& words) {
    text_ += words + "\n";
    arguments_of_lines_.push_back(argument);
  }
  void value(unsigned argument, const char* before, const char* behind) {
    if (const auto* given = find(argument)) line(argument, before + shown(*given) + behind);
  }
  void only_one(unsigned argument, const char* why) {
    if (const auto* given = find(argument); given != nullptr && *given != 1)
      fail(argument, short_number(*given) + " is not 1: " + why);
  }

  template <std::size_t count>
  void digits(unsigned argument, const Digit (&known)[count], bool needed) {
    const auto* given = find(argument);
    if (given == nullptr) {
      if (needed) fail(argument, "it is missing; 11400 corrects the kinematics");
      return;
    }
    const double limit = std::pow(10.0, static_cast<double>(count));
    if (!(*given >= 0 && *given < limit) || *given != std::floor(*given))
      fail(argument, short_number(*given) + " is no whole number from 0 to " + short_number(limit - 1));
    auto rest = static_cast<unsigned long>(*given);
    for (const auto& digit : known) {
      const auto shown_digit = rest % 10;
      rest /= 10;
      const auto* word = shown_digit < digit.words.size() ? digit.words[shown_digit] : nullptr;
      if (word == nullptr) {
        constexpr const char* places[]{"ones", "tens", "hundreds", "thousands", "ten thousands"};
        fail(argument, short_number(*given) + ": digit " + std::to_string(shown_digit) + " of the " +
                           places[digit.place] + " is not known");
      }
      if (digit.key[0] != '\0') line(argument, std::string(digit.key) + ": " + word + ",");
    }
  }
  bool tolerance_on() const {
    const auto* given = find(display);
    return given != nullptr && static_cast<unsigned long>(*given) / 10 % 10 == 1;
  }

  void axes() {
    const auto vectors = counted_vectors(machine_.model);
    line(0, "axes: {");
    for (std::size_t i = 0; i < std::min<std::size_t>(vectors.size(), 2); ++i) {
      const unsigned first = i == 0 ? first_axis : second_axis;
      line(0, std::string(1, rotary_names[vectors[i].angle]) + ": {");
      constexpr const char* keys[]{
          "touch_start_deg: ", "start_deg: ", "end_deg: ", "points: ", "other_deg: "};
      for (unsigned k = 0; k < std::size(keys); ++k) value(first + k, keys[k], ",");
      line(0, "},");
    }
    line(0, "},");
  }

  const CycleArguments& arguments_;
  const MeasuredMachine& machine_;
  std::string text_;
  std::vector<unsigned> arguments_of_lines_;
};

}  // namespace

std::string inputs_text(const CycleArguments& arguments, const MeasuredMachine& machine) {
  Writer writer(arguments, machine);
  auto text = writer.text();
  try {
    parse_inputs(text, "", machine);
  } catch (const std::runtime_error& e) {
    // ":line:column: error: what is wrong"
    const std::string what = e.what();
    std::size_t line = 0;
    int read = 0;
    if (std::sscanf(what.c_str(), ":%zu:%*u: error: %n", &line, &read) < 1 || read == 0)
      throw std::runtime_error("CYCLE9960: " + what);
    const auto cause = what.substr(static_cast<std::size_t>(read));
    if (const auto argument = writer.argument_of(line); argument != 0) fail(argument, cause);
    throw std::runtime_error("CYCLE9960: " + cause);
  }
  return text;
}

Vec3 sphere_under_probe(const MeasurementInputs& in, const MeasuredMachine& machine,
                        const AxisPosition& position) {
  const auto chain = std::get<geometry::Chain>(geometry::Chain::make(machine.model));
  Angles angles{};
  std::copy(position.begin() + 3, position.end(), angles.begin());
  const double beyond = (in.sphere_diameter + in.ball_diameter) / 2 + in.measuring_path;
  return chain.tip_from_machine(Vec3(position[0], position[1], position[2]), angles,
                                in.probe_length + beyond);
}

}  // namespace trunnion::calibration
