// SPDX-License-Identifier: Apache-2.0
#include "machine_facts.hpp"

#include <filesystem>

#include "calibration/measurement_moves.hpp"
#include "machine/chain_parameters.hpp"
#include "machine/yaml.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::measurement {
namespace {

class BodyWays : public Ways {
 public:
  BodyWays(collision::MachineBodies bodies, const truth::Truth& truth,
           const calibration::MeasurementInputs& inputs, const calibration::MeasuredMachine& measured)
      : moves_(std::move(bodies), truth.solids, truth.probe, inputs, measured) {}
  calibration::AxisPosition check(const calibration::PlannedPose& pose,
                                  const calibration::AxisPosition& from) const override {
    return moves_.check(pose, from);
  }
  calibration::Way way(const calibration::AxisPosition& from,
                       const calibration::AxisPosition& to) const override {
    return moves_.way(from, to);
  }

 private:
  calibration::MeasurementMoves moves_;
};

truth::Truth truth_of(const machine::MachineConfig& machine, const machine::Parameters& delivered,
                      std::uint16_t channel) {
  const auto file = machine.directory + "/truth.yaml";
  if (!std::filesystem::exists(file)) return {};
  return truth::parse_truth(machine::read_text(file), file, machine::outline_of(delivered, channel));
}

collision::MachineBodies bodies_of(const std::string& directory, const machine::Parameters& active,
                                   std::uint16_t channel, const truth::Truth& truth) {
  auto bodies =
      collision::load_bodies(directory, machine::chain_parameters(active, channel), truth.geometry.structure);
  collision::add_solids(bodies.links, truth.solids, bodies.set);
  return bodies;
}

}  // namespace

MachineFacts load_facts(const machine::MachineConfig& machine) {
  MachineFacts facts;
  facts.name = machine.name;
  facts.delivered.values = machine::machine_parameters(machine);
  const auto truth = truth_of(machine, facts.delivered, 0);
  facts.gauges = calibration::probe_and_sphere(truth.probe, truth.solids);
  facts.ways = [directory = machine.directory, truth](
                   const calibration::MeasurementInputs& inputs, const calibration::MeasuredMachine& measured,
                   std::uint16_t channel, const machine::Parameters& active) -> std::shared_ptr<const Ways> {
    return std::make_shared<BodyWays>(bodies_of(directory, active, channel, truth), truth, inputs, measured);
  };
  return facts;
}

}  // namespace trunnion::measurement
