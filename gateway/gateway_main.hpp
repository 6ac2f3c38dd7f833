// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cluster_view.hpp"

namespace trunnion {

/// The process of the gateway. `change`: as of ClusterView.
int gateway_main(int argc, char** argv, gateway::FeedbackChange change = {});

}  // namespace trunnion
