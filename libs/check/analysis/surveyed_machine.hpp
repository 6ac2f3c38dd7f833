// SPDX-License-Identifier: Apache-2.0
// A machine whose programs are surveyed: so that one M code that its logic does not have hides no other.
#pragma once

#include "channel_setup/channel_setup.hpp"

namespace trunnion::analysis {

class SurveyedMachine final : public channel_setup::ChannelSetup {
 public:
  using ChannelSetup::ChannelSetup;

  const language::MFunctions* m_functions() const override { return permits_ ? nullptr : functions(); }
  /// What its logic carries out, whatever is permitted.
  const language::MFunctions* functions() const { return ChannelSetup::m_functions(); }
  /// From the next program on every M code may stand.
  void permit_every_m(bool permits) { permits_ = permits; }

 private:
  bool permits_ = false;
};

}  // namespace trunnion::analysis
