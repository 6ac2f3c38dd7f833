#pragma once

#include "src/gantry_core.hpp"
#include "stream/stage_service.hpp"

namespace trunnion::gantry {

/// Besides the stage: supervises the synchronization error of every pair in the drive's feedback.
class GantryService : public stream::StageService<idl::stream::AxisFrame> {
 public:
  explicit GantryService(service::Node& node);

 protected:
  bool needs_feedback() const override { return true; }
  void on_feedback(const idl::stream::FeedbackFrame& feedback) override;

 private:
  std::uint64_t revision_ = 0;
  std::vector<Pair> pairs_;
};

}  // namespace trunnion::gantry
