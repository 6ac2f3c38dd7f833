// SPDX-License-Identifier: Apache-2.0
// What the gateway's main() does, also for gateways of tests that show something else.
#pragma once

#include "cluster_side/cluster_view.hpp"

namespace trunnion {

/// The process of the gateway. `change`: as of ClusterView.
int gateway_main(int argc, char** argv, gateway::FeedbackChange change = {});

}  // namespace trunnion
