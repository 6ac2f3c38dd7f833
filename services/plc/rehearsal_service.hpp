#pragma once

#include "node/node.hpp"
#include "node/parameter_client.hpp"
#include "round_link.hpp"
#include "standby_comparison.hpp"

namespace trunnion::plc {

/// The PLC as long as another one is the machine's: it repeats in private what that one does and says in its
/// heartbeat how many ticks were equal (frames_out) and what was not (detail). It writes nothing else.
class RehearsalService : public node::Service {
 public:
  /// Throws what load_programs() and RoundReader throw.
  explicit RehearsalService(node::Node& node);
  void pump() override;
  node::Health health() const override;

 private:
  node::ParameterClient parameters_;
  StandbyComparison comparison_;
  RoundReader rounds_;
  bus::Bytes bytes_;
  Round round_;
  bool play_again_ = false;
  std::uint64_t rounds_in_ = 0, rounds_lost_ = 0;
};

}  // namespace trunnion::plc
