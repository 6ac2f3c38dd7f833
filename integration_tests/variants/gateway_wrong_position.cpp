// SPDX-License-Identifier: Apache-2.0
// A gateway that shows an axis two micrometres beside its position: what verification must find.
#include "gateway_main.hpp"

int main(int argc, char** argv) {
  return trunnion::gateway_main(argc, argv, [](trunnion::idl::stream::FeedbackFrame& frame) {
    for (std::size_t i = 0; i < frame.actual.size(); i += frame.axis_count) frame.actual[i] += 0.002;
  });
}
