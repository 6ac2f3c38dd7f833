// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "service.hpp"
#include "simulation/simulated_hardware.hpp"

namespace trunnion::drive {
namespace {

class SimulatedDrive : public DriveService {
 public:
  explicit SimulatedDrive(service::Node& node) : DriveService(node, std::make_unique<SimulatedHardware>()) {
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
