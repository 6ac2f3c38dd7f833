// SPDX-License-Identifier: Apache-2.0
// A compensation with the sign of backlash turned round: what only a recording with backlash can find.
#include "compensation_core.hpp"
#include "machine/parameter_constants.hpp"
#include "stream/stage_service.hpp"

namespace trunnion::variants {

class Flipped : public compensation::CompensationCore {
 public:
  void configure(const machine::Parameters& parameters, std::uint16_t channel) override {
    auto flipped = parameters;
    for (std::uint16_t axis = 0; axis < 32; ++axis)
      if (const auto found = flipped.values.find(parameter::backlash.number(axis));
          found != flipped.values.end())
        found->second.value = -found->second.value;
    CompensationCore::configure(flipped, channel);
  }
};

class Service : public stream::StageService<idl::stream::AxisBatch> {
 public:
  explicit Service(service::Node& node)
      : StageService(node, stream::Stage::COMPENSATION, topics::kinematics_batch, topics::compensation_batch,
                     [] { return std::make_unique<Flipped>(); }) {}
};

}  // namespace trunnion::variants

int main(int argc, char** argv) {
  return trunnion::service::service_main<trunnion::variants::Service>(argc, argv, "compensation");
}
