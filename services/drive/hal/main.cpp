// SPDX-License-Identifier: Apache-2.0
// trunnion-drive-hal: the drive service on LinuxCNC's HAL. The only program of Trunnion that is linked with
// LinuxCNC.
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "../service.hpp"
#include "hal_hardware.hpp"

namespace trunnion::drive {
namespace {

std::unique_ptr<DriveHardware> hardware_for(const service::Options& options) {
  if (options.machine.hardware != machine::Hardware::hal)
    throw std::runtime_error(
        "this program drives a machine behind LinuxCNC's HAL; machine.yaml has no "
        "'hardware: hal'");
  if (options.virtual_time)
    throw std::runtime_error(
        "a machine with 'hardware: hal' runs in real time only: HAL's servo thread is the "
        "clock");
  HalSession::Options session;
  session.program =
      (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "trunnion-hal-session").string();
  session.file = options.machine.hal.file;
  session.domain = options.network.domain;
  session.watched_pid = options.parent_bound ? getppid() : getpid();
  return std::make_unique<HalHardware>(session, options.machine.hal.queue, options.state_directory);
}

class HalDrive : public DriveService {
 public:
  explicit HalDrive(service::Node& node) : DriveService(node, hardware_for(node.options())) {}
};

}  // namespace
}  // namespace trunnion::drive

int main(int argc, char** argv) {
  using namespace trunnion;
  return service::service_main<drive::HalDrive>(argc, argv, "drive");
}
