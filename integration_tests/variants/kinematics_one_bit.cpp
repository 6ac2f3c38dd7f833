// SPDX-License-Identifier: Apache-2.0
#include "kinematics_core.hpp"
#include "one_bit.hpp"

namespace trunnion::variants {

using Core = OneBitOff<kinematics::KinematicsCore, idl::stream::PathBatch>;

class Service : public stream::StageService<idl::stream::PathBatch> {
 public:
  explicit Service(service::Node& node)
      : StageService(node, stream::Stage::KINEMATICS, topics::path_batch, topics::kinematics_batch,
                     [] { return std::make_unique<Core>(); }) {}
};

}  // namespace trunnion::variants

int main(int argc, char** argv) {
  return trunnion::service::service_main<trunnion::variants::Service>(argc, argv, "kinematics");
}
