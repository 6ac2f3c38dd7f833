#pragma once

#include "rehearsal.hpp"
#include "round_link.hpp"
#include "service/node.hpp"
#include "service/parameter_client.hpp"

namespace trunnion::plc {

/// The PLC as long as another one is the machine's: it repeats in private what that one does and reports in
/// its heartbeat how many ticks were equal and what was not. It writes nothing else.
class RehearsalService : public service::Service {
 public:
  /// Throws what load_programs() and RoundReader throw.
  explicit RehearsalService(service::Node& node);
  void pump() override;
  service::Health health() const override;

 private:
  service::ParameterClient parameters_;
  Rehearsal rehearsal_;
  RoundReader rounds_;
  bus::Bytes bytes_;
  Round round_;
  bool play_again_ = false;
  std::uint64_t rounds_in_ = 0, rounds_lost_ = 0;
};

}  // namespace trunnion::plc
