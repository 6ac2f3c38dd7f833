// SPDX-License-Identifier: Apache-2.0
#include "gantry_core.hpp"
#include "one_bit.hpp"

namespace trunnion::variants {

using Core = OneBitOff<gantry::GantryCore, idl::stream::AxisBatch>;

class Service : public stream::StageService<idl::stream::AxisBatch> {
 public:
  explicit Service(service::Node& node)
      : StageService(node, stream::Stage::GANTRY, topics::compensation_batch, topics::gantry_batch,
                     [] { return std::make_unique<Core>(); }) {}

 protected:
  bool needs_feedback() const override { return true; }
};

}  // namespace trunnion::variants

int main(int argc, char** argv) {
  return trunnion::service::service_main<trunnion::variants::Service>(argc, argv, "gantry");
}
