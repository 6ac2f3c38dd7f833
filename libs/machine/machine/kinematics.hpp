// SPDX-License-Identifier: Apache-2.0
// The kinematic chain of a channel: from its parameters, and from a chain of elements into parameters.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/chain_elements.hpp"
#include "geometry/orientation.hpp"
#include "machine/alarm_definition.hpp"
#include "machine/parameters.hpp"

namespace trunnion::machine {

/// Parameters that make no chain. what() names the channel, the parameters and what is wrong.
class KinematicsError : public std::runtime_error {
 public:
  KinematicsError(const AlarmDefinition& alarm, const std::string& text)
      : std::runtime_error(text), alarm_(&alarm) {}
  const AlarmDefinition& alarm() const { return *alarm_; }

 private:
  const AlarmDefinition* alarm_;
};

/// The alarm about an error of configuring a channel's kinematics.
const AlarmDefinition& alarm_of(const std::exception& error);

/// Parameters 04c400..04c437, 04c905..04c907, 04c920..04c943 and 04c960..04c988. Throws KinematicsError.
geometry::Chain make_chain(const Parameters& parameters, std::uint16_t channel);

/// One line for each direction vector that is used and is not a unit vector (beyond 1e-4): it is normalized.
std::vector<std::string> kinematics_warnings(const Parameters& parameters, std::uint16_t channel);

/// Travel limits of the rotary axes A B C U V W of a channel; those it does not have are endless.
geometry::AngleTravels rotary_travels(const Parameters& parameters, std::uint16_t channel);

/// The parameters that describe the same chain: the form in which services get it. Throws KinematicsError.
std::map<std::uint32_t, ParameterValue> parameters_of_chain(const geometry::ChainDescription& description,
                                                            std::uint16_t channel);

/// A correction of the kinematic chain that has a name: what a measurement writes.
struct CorrectionElement {
  std::string name;
  std::uint32_t number = 0;  ///< of the parameter with X; Y and Z follow
  double sign = 1;           ///< the parameters are this times the vector towards the tool, mm
};

/// Those of a channel, of the table from the workpiece, then of the head from the tool.
std::vector<CorrectionElement> correction_elements(const Parameters& parameters, std::uint16_t channel);

/// True for the numbers parameters_of_chain() may return, of any channel.
bool is_chain_parameter(std::uint32_t number);

/// The meaning of `error`, in words.
std::string to_string(geometry::ChainError error);

}  // namespace trunnion::machine
