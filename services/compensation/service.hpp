// SPDX-License-Identifier: Apache-2.0
// The process of the compensation: the stage that corrects setpoints by the errors of the machine.
#pragma once

#include "core/compensation_core.hpp"
#include "stream/stage_service.hpp"

namespace trunnion::compensation {

class CompensationService : public stream::StageService<idl::stream::AxisBatch> {
 public:
  explicit CompensationService(service::Node& node);
};

}  // namespace trunnion::compensation
