// SPDX-License-Identifier: Apache-2.0
// Follows the published parameters and keeps the revisions that may still be in the stream.
#pragma once

#include <memory>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"
#include "machine/parameters.hpp"

namespace trunnion::service {

class ParameterClient {
 public:
  explicit ParameterClient(bus::Bus& bus) : bus_(bus), reader_(bus.reader(topics::parameter_set)) {}
  /// True when a newer revision has arrived. A set with a value beyond the limits of the catalogue is refused
  /// (Bus::refusals()).
  bool poll();
  /// Null until the first set has arrived.
  std::shared_ptr<const machine::Parameters> newest() const { return newest_; }
  /// The set with this revision: the newest or the one before. Null when it is not known.
  std::shared_ptr<const machine::Parameters> find(std::uint64_t revision) const;

 private:
  bus::Bus& bus_;
  bus::Reader<idl::parameters::ParameterSet> reader_;
  std::shared_ptr<const machine::Parameters> newest_, previous_;
};

}  // namespace trunnion::service
