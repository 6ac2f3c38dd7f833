// SPDX-License-Identifier: Apache-2.0
#include "mdi.hpp"

namespace trunnion::channel {

void Mdi::enter(const idl::channel::ChannelRequest& request) {
  line_ = request.block, who_ = request.who, role_ = request.role;
  source_.emplace(line_);
  texts_.clear();
}

void Mdi::start(motion::MoveTaker& motion, const AxisValues& position,
                const language::VariableStore& variables) {
  flow_.start(motion, *source_, position, modal_, variables, {},
              frames_kept_ ? language::Beginning::line : language::Beginning::program);
}

void Mdi::end(std::uint32_t tool) {
  modal_ = flow_.modal();
  frames_kept_ = true;
  set_tool(tool);
}

}  // namespace trunnion::channel
