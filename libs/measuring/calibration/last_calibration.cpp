// SPDX-License-Identifier: Apache-2.0
#include "calibration/last_calibration.hpp"

#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "machine/parameters.hpp"

namespace trunnion::calibration {

LastCalibration last_calibration(const std::string& journal) {
  LastCalibration last;
  int last_part = 0;
  std::map<std::uint32_t, double> newest;
  std::istringstream lines(journal);
  for (std::string line; std::getline(lines, line);) {
    const auto entry = nlohmann::json::parse(line, nullptr, false);
    if (!entry.is_object() || entry.value("what", "") != "parameter" || !entry.contains("number") ||
        !entry["number"].is_number_unsigned() || !entry.contains("old") || !entry.contains("new"))
      continue;
    const auto time = entry.value("time", ""), who = entry.value("who", "");
    const auto number = entry["number"].get<std::uint32_t>();
    if (!entry["old"].is_number() || !entry["new"].is_number()) continue;
    newest[number] = entry["new"].get<double>();
    if (!who.ends_with(calibrated_by) && !who.ends_with(undone_by)) continue;
    // The lines of one change have ascending parts, and in journals of former versions none.
    const auto found = entry.find("part");
    const int part = found != entry.end() && found->is_number_integer() ? found->get<int>() : last_part + 1;
    if (time != last.time || who != last.who || part <= last_part) last = {time, who, {}, {}};
    last_part = part;
    last.before.try_emplace(number, entry["old"].get<double>());
    last.after[number] = newest[number];
  }
  if (last.after.empty()) throw std::runtime_error("the journal has no calibration");
  if (last.who.ends_with(undone_by))
    throw std::runtime_error("the last calibration was undone already, at " + last.time);
  for (const auto& [number, value] : last.after)
    if (newest[number] != value)
      throw std::runtime_error("parameter " + machine::number_text(number) +
                               " was changed after the calibration of " + last.time + "; nothing undone");
  return last;
}

}  // namespace trunnion::calibration
