// SPDX-License-Identifier: Apache-2.0
// The process of the gantry: the stage that adds the setpoints of slave axes.
#pragma once

#include <map>

#include "core/gantry_core.hpp"
#include "stream/stage_service.hpp"

namespace trunnion::gantry {

/// Besides the stage: supervises position, speed and current of every pair in the drive's feedback.
class GantryService : public stream::StageService<idl::stream::AxisBatch> {
 public:
  explicit GantryService(service::Node& node);

 protected:
  bool needs_feedback() const override { return true; }
  void on_feedback(const idl::stream::Feedback& feedback) override;

 private:
  struct Supervised {
    machine::GantryPair pair;
    double offset = 0;  // mm, what the compensation of the two axes accounts for
  };
  void supervise(const Supervised& supervised, const idl::stream::Feedback& feedback);

  std::uint64_t revision_ = 0;
  std::map<std::uint16_t, std::vector<Supervised>> channels_;
};

}  // namespace trunnion::gantry
