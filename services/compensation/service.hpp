// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/compensation_core.hpp"
#include "stream/stage_service.hpp"

namespace trunnion::compensation {

class CompensationService : public stream::StageService<idl::stream::AxisFrame> {
 public:
  explicit CompensationService(service::Node& node);
};

}  // namespace trunnion::compensation
