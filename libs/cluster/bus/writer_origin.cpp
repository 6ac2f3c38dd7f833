// SPDX-License-Identifier: Apache-2.0
#include "bus/writer_origin.hpp"

#include <algorithm>
#include <cstdio>

namespace trunnion::bus {
namespace {

// An alarm has 250 characters, and who it is must leave room for topic and field, which stand before and
// after.
constexpr std::size_t longest_line = 120;

// A stranger chooses these texts.
std::string printable(std::string text) {
  constexpr std::size_t longest = 40;
  if (text.size() > longest) text.resize(longest);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

// "udp/10.77.0.3:7413@2,..." is 10.77.0.3:7413.
std::string first_address(const std::string& list) {
  auto first = list.substr(0, list.find_first_of(",@"));
  const auto kind = first.find('/');
  return kind == std::string::npos ? first : first.substr(kind + 1);
}

}  // namespace

void take_property(WriterOrigin& origin, const std::string& name, const std::string& value) {
  if (value.empty()) return;
  if (name == "__Hostname" || name == "fastdds.physical_data.host") origin.host = value;
  if (name == "__ProcessName") origin.process = value;
  if (name == "__Pid" || name == "fastdds.physical_data.process") origin.pid = value;
  if (name == "__NetworkAddresses" && value != "localprocess") origin.address = first_address(value);
}

std::string prefix_text(std::span<const std::uint8_t> guid) {
  std::string text;
  for (const auto byte : guid.first(std::min<std::size_t>(12, guid.size()))) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", byte);
    text += digits;
  }
  return text;
}

std::string to_text(const WriterOrigin& origin) {
  const bool unknown = origin.pid.empty() && origin.host.empty() && origin.address.empty();
  if (unknown && origin.identity.empty() && origin.participant.empty()) return "a writer that has left";
  std::string text = origin.pid.empty() ? "a process" : "process " + printable(origin.pid);
  if (!origin.process.empty()) text += " (" + printable(origin.process) + ")";
  if (!origin.host.empty()) text += " on host " + printable(origin.host);
  if (!origin.address.empty()) text += ", " + printable(origin.address);
  if (!origin.identity.empty()) text += ", which says it is " + printable(origin.identity);
  // Where process and host are known the GUID would only fill the line.
  if (origin.pid.empty() || origin.host.empty())
    if (!origin.participant.empty()) text += ", GUID prefix " + printable(origin.participant);
  if (text.size() > longest_line) text.resize(longest_line);
  return text;
}

}  // namespace trunnion::bus
