// SPDX-License-Identifier: Apache-2.0
#include "compensation_core.hpp"
#include "one_bit.hpp"

namespace trunnion::variants {

using Core = OneBitOff<compensation::CompensationCore, idl::stream::AxisBatch>;

class Service : public stream::StageService<idl::stream::AxisBatch> {
 public:
  explicit Service(service::Node& node)
      : StageService(node, stream::Stage::COMPENSATION, topics::kinematics_batch, topics::compensation_batch,
                     [] { return std::make_unique<Core>(); }) {}
};

}  // namespace trunnion::variants

int main(int argc, char** argv) {
  return trunnion::service::service_main<trunnion::variants::Service>(argc, argv, "compensation");
}
