// SPDX-License-Identifier: Apache-2.0
// A gateway that shows an axis two micrometres beside its position: what verification must find.
#include "gateway_main.hpp"

int main(int argc, char** argv) {
  return trunnion::gateway_main(argc, argv, [](trunnion::idl::stream::Feedback& feedback) {
    for (std::size_t i = 0; i < feedback.actual.size(); i += feedback.axis_count) feedback.actual[i] += 0.002;
  });
}
