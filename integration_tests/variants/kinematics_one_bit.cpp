// SPDX-License-Identifier: Apache-2.0
#include "kinematics_core.hpp"
#include "one_bit.hpp"

namespace trunnion::variants {

using Core = OneBitOff<kinematics::KinematicsCore, idl::stream::PathFrame>;

class Service : public stream::StageService<idl::stream::PathFrame> {
 public:
  explicit Service(service::Node& node)
      : StageService(node, stream::Stage::KINEMATICS, topics::path_frame, topics::kinematics_frame,
                     [] { return std::make_unique<Core>(); }) {}
};

}  // namespace trunnion::variants

int main(int argc, char** argv) {
  return trunnion::service::service_main<trunnion::variants::Service>(argc, argv, "kinematics");
}
