// SPDX-License-Identifier: Apache-2.0
#include "standby_service.hpp"

#include "online_service.hpp"
#include "program_files.hpp"

namespace trunnion::plc {
namespace {

constexpr int most_at_once = 1000;  // rounds between two heartbeats

Programs programs_of(const service::Node& node) {
  const auto sources = active_sources(node, boot_of(node));
  return translate(sources.files, node.options().machine.simulated(), sources.directory);
}

}  // namespace

StandbyService::StandbyService(service::Node& node)
    : parameters_(node.bus()),
      comparison_(programs_of(node), node.options().virtual_time,
                  [this](std::uint64_t revision) { return parameters_.find(revision); }),
      rounds_(node.options().state_directory + rounds_file) {}

void StandbyService::pump() {
  parameters_.poll();
  rounds_.send_heartbeat();
  for (int i = 0; i < most_at_once; ++i) {
    if (!play_again_) {
      if (!rounds_.read(bytes_)) break;
      ++rounds_in_;
      if (!bus::decode(bytes_, round_)) {
        rounds_.request_start();
        break;
      }
    }
    const auto outcome = comparison_.play(round_, rounds_.generation());
    play_again_ = outcome == StandbyComparison::Outcome::waiting;
    if (outcome == StandbyComparison::Outcome::gap) rounds_.request_start();
    if (play_again_ || outcome == StandbyComparison::Outcome::differs) break;
  }
  if (!rounds_.lost()) return;
  ++rounds_lost_;
  play_again_ = false;
  rounds_.request_start();
}

service::Health StandbyService::health() const {
  service::Health health;
  health.lifecycle = idl::service::Lifecycle::INACTIVE;
  health.difference = comparison_.difference();
  health.compared = comparison_.equal_ticks();
  health.in_step = comparison_.in_step();
  health.messages_in = rounds_in_;
  health.cycles_lost = rounds_lost_;
  return health;
}

}  // namespace trunnion::plc
