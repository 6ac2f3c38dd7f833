// SPDX-License-Identifier: Apache-2.0
// Who has written a message: what a process tells of itself when the others discover it, in the words of
// either vendor.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace trunnion::bus {

/// What is not told is empty. Without DDS Security nobody checks that it is true.
struct WriterOrigin {
  std::string identity;       ///< the service, of a participant of this product
  std::string host, process;  ///< names
  std::string pid;
  std::string address;      ///< of its first socket for discovery, with the port
  std::string participant;  ///< prefix of its GUID
};

/// Properties of participants that say where a process is; the last is made by Cyclone DDS itself.
inline constexpr std::array<const char*, 6> origin_properties{"__Hostname",
                                                              "__ProcessName",
                                                              "__Pid",
                                                              "fastdds.physical_data.host",
                                                              "fastdds.physical_data.process",
                                                              "__NetworkAddresses"};

/// Takes a property if it is one of those.
void take_property(WriterOrigin& origin, const std::string& name, const std::string& value);

/// The first twelve bytes of a GUID, in hexadecimal.
std::string prefix_text(std::span<const std::uint8_t> guid);

/// For an operator, in one line and never empty: "process 4711 (trunnion-plc) on host mill, 10.77.0.3:7413".
/// Of each part at most 40 characters, of all together at most 120, printable ones.
std::string to_text(const WriterOrigin& origin);

}  // namespace trunnion::bus
