// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <stdexcept>

#include "machine/yaml.hpp"
#include "service.hpp"
#include "simulation/simulated_hardware.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::drive {
namespace {

// By truth.yaml beside machine.yaml, which refers to the machine as it was delivered.
std::unique_ptr<SimulatedHardware> hardware_of(const machine::MachineConfig& config) {
  const auto file = config.directory + "/truth.yaml";
  if (!std::filesystem::exists(file)) return std::make_unique<SimulatedHardware>();
  machine::Parameters delivered;
  delivered.values = machine::machine_parameters(config);
  const auto outline = machine::outline_of(delivered, 0);
  const auto truth = truth::parse_truth(machine::read_text(file), file, outline);
  std::optional<ProbeSetup> probe;
  if (truth.probe)
    probe.emplace(ProbeSetup{outline.design, truth::make_geometry(truth.geometry, outline, file),
                             *truth.probe, truth.solids});
  return std::make_unique<SimulatedHardware>(truth.drives, probe, truth.geometry.beam, truth.spindle_drives);
}

class SimulatedDrive : public DriveService {
 public:
  explicit SimulatedDrive(service::Node& node) : DriveService(node, hardware_of(node.options().machine)) {
    if (node.options().machine.hardware != machine::Hardware::simulation)
      throw std::runtime_error(
          "this program moves simulated axes only; machine.yaml says 'hardware: hal', which " +
          std::string("trunnion-drive-hal drives"));
  }
};

}  // namespace
}  // namespace trunnion::drive

int main(int argc, char** argv) {
  using namespace trunnion;
  return service::service_main<drive::SimulatedDrive>(argc, argv, "drive");
}
