#include "rehearsal_service.hpp"

#include "program_files.hpp"

namespace trunnion::plc {
namespace {

constexpr int most_at_once = 1000;  // rounds between two signs of life

PlcCore with_programs(const service::Node& node) {
  PlcCore core;
  load_programs(node.options().machine.plc_directory(), core);
  return core;
}

}  // namespace

RehearsalService::RehearsalService(service::Node& node)
    : parameters_(node.bus()),
      rehearsal_(with_programs(node), node.options().virtual_time,
                 [this](std::uint64_t revision) { return parameters_.find(revision); }),
      rounds_(node.options().state_directory + rounds_file) {}

void RehearsalService::pump() {
  parameters_.poll();
  rounds_.breathe();
  for (int i = 0; i < most_at_once; ++i) {
    if (!play_again_) {
      if (!rounds_.read(bytes_)) break;
      ++rounds_in_;
      if (!bus::decode(bytes_, round_)) {
        rounds_.ask();
        break;
      }
    }
    const auto outcome = rehearsal_.play(round_, rounds_.generation());
    play_again_ = outcome == Rehearsal::Outcome::waiting;
    if (outcome == Rehearsal::Outcome::gap) rounds_.ask();
    if (play_again_ || outcome == Rehearsal::Outcome::differs) break;
  }
  if (!rounds_.lost()) return;
  ++rounds_lost_;
  play_again_ = false;
  rounds_.ask();
}

service::Health RehearsalService::health() const {
  service::Health health;
  health.lifecycle = idl::service::Lifecycle::INACTIVE;
  health.difference = rehearsal_.difference();
  health.compared = rehearsal_.equal_ticks();
  health.in_step = rehearsal_.in_step();
  health.frames_in = rounds_in_;
  health.frames_lost = rounds_lost_;
  return health;
}

}  // namespace trunnion::plc
