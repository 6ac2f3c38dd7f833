// SPDX-License-Identifier: Apache-2.0
// A gateway that shows an axis two micrometres beside its position: what verification must find. Linked with
// --wrap for StateDocument::apply(FeedbackFrame), whose name on the linker's level is below.
#include "src/state_document.hpp"

#define APPLY "_ZN8trunnion7gateway13StateDocument5applyERKNS_3idl6stream13FeedbackFrameE"

namespace trunnion::gateway {

void right_apply(StateDocument* document, const idl::stream::FeedbackFrame& frame) __asm__("__real_" APPLY);
void wrong_apply(StateDocument* document, const idl::stream::FeedbackFrame& frame) __asm__("__wrap_" APPLY);

void wrong_apply(StateDocument* document, const idl::stream::FeedbackFrame& frame) {
  auto wrong = frame;
  for (std::size_t i = 0; i < wrong.actual.size(); i += frame.axis_count) wrong.actual[i] += 0.002;
  right_apply(document, wrong);
}

}  // namespace trunnion::gateway
