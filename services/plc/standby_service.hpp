// SPDX-License-Identifier: Apache-2.0
// The PLC on standby, compared with the running one in a swap.
#pragma once

#include "round_link.hpp"
#include "service/node.hpp"
#include "service/parameter_client.hpp"
#include "standby_comparison.hpp"

namespace trunnion::plc {

/// The PLC while another one controls the machine: it repeats that one's rounds and reports in its heartbeat
/// the number of equal ticks and the difference. It writes nothing else.
class StandbyService : public service::Service {
 public:
  /// Throws what load_programs() and RoundReader throw.
  explicit StandbyService(service::Node& node);
  void pump() override;
  service::Health health() const override;

 private:
  service::ParameterClient parameters_;
  StandbyComparison comparison_;
  RoundReader rounds_;
  bus::Bytes bytes_;
  Round round_;
  bool play_again_ = false;
  std::uint64_t rounds_in_ = 0, rounds_lost_ = 0;
};

}  // namespace trunnion::plc
