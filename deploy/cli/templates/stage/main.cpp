#include "@NAME@_core.hpp"
#include "stream/stage_service.hpp"

namespace {

using Frame = trunnion::idl::stream::AxisFrame;

class Service : public trunnion::stream::StageService<Frame> {
 public:
  explicit Service(trunnion::service::Node& node)
      : StageService(node, trunnion::stream::Stage::@STAGE_ENUM@, trunnion::topics::@INPUT@,
                     trunnion::topics::@OUTPUT@, [] { return std::make_unique<@IDENTIFIER@::Core>(); }) {}
};

}  // namespace

int main(int argc, char** argv) { return trunnion::service::service_main<Service>(argc, argv, "@STAGE@"); }
