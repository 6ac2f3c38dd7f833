// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "canonical/axes.hpp"

#include "calibration/touches.hpp"

namespace trunnion::calibration {
namespace {

using canonical::axis_letters;
constexpr std::size_t most_lines = 1000;
constexpr double most = 1e6;

class LineReader {
 public:
  LineReader(const std::string& file, const ChainParameters& chain) : file_(file) {
    for (const auto& vector : metrology::root_vectors(chain)) rotary_ += axis_letters[3 + vector.angle];
  }

  // False for an empty line.
  bool read(std::string_view line, std::size_t number, std::array<double, 9>& values) {
    number_ = number;
    values.fill(0);
    std::array<bool, 9> given{};
    line = line.substr(0, line.find_first_of("#;"));
    bool any = false;
    for (std::size_t i = 0; i < line.size();) {
      if (line[i] == ' ' || line[i] == '\t' || line[i] == '\r') {
        ++i;
        continue;
      }
      const auto axis = axis_letters.find(line[i]);
      if (axis == std::string_view::npos || (axis > 2 && rotary_.find(line[i]) == rotary_.npos))
        fail(i, "expected a word of one of the axes XYZ" + rotary_ + ", for example X10.5");
      if (given[axis]) fail(i, std::string("axis ").append(1, line[i]).append(" is there twice"));
      given[axis] = any = true;
      const std::size_t end = std::min(line.find_first_of(" \t\rXYZABCUVW", i + 1), line.size());
      const char* first = line.data() + i + 1;
      if (first + 1 < line.data() + end && *first == '+' && first[1] != '-') ++first;
      const auto [stop, error] = std::from_chars(first, line.data() + end, values[axis]);
      const std::string word(line.substr(i + 1, end - i - 1));
      if (error != std::errc() || stop != line.data() + end || !std::isfinite(values[axis]))
        fail(i + 1, "'" + word + "' is not a number");
      if (std::abs(values[axis]) > most) fail(i + 1, word + " is not within -1000000 .. 1000000");
      i = end;
    }
    if (!any) return false;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!given[axis])
        fail(
            0,
            std::string("axis ").append(1, axis_letters[axis]).append(" is missing: a touch has X, Y and Z"));
    return true;
  }

  [[noreturn]] void fail(std::size_t column, const std::string& text) const {
    throw std::runtime_error(file_ + ":" + std::to_string(number_) + ":" + std::to_string(column + 1) +
                             ": error: " + text);
  }

 private:
  std::string file_, rotary_;
  std::size_t number_ = 0;
};

}  // namespace

std::vector<TouchedPose> parse_touches(const std::string& text, const std::string& file,
                                       const ChainParameters& chain) {
  LineReader reader(file, chain);
  std::vector<TouchedPose> poses;
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::array<double, 9> values{};
    const bool touch = reader.read(std::string_view(text).substr(at, end - at), ++number, values);
    if (number > most_lines) reader.fail(0, "more than " + std::to_string(most_lines) + " lines");
    at = end + 1;
    if (!touch) continue;
    const auto angles = geometry::angles_of(values.data());
    if (poses.empty() || poses.back().angles != angles) poses.push_back({angles, {}});
    poses.back().positions.emplace_back(values[0], values[1], values[2]);
  }
  if (poses.empty()) {
    reader.fail(0, "no touch");
  }
  return poses;
}

std::string text_of(const std::vector<TouchedPose>& poses, const ChainParameters& chain) {
  std::string text = "# One touch in a line: positions of the axes at the edge of the probe, deg and mm\n";
  for (const auto& pose : poses)
    for (const auto& position : pose.positions) {
      const auto vectors = metrology::root_vectors(chain);
      for (const auto& vector : vectors)
        text += fmt::format("{}{:.12g} ", axis_letters[3 + vector.angle], pose.angles[vector.angle]);
      text += fmt::format("X{:.6f} Y{:.6f} Z{:.6f}\n", position.x(), position.y(), position.z());
    }
  return text;
}

}  // namespace trunnion::calibration
