// SPDX-License-Identifier: Apache-2.0
// The parameters that are saved in a state directory, while no cluster uses it.
#pragma once

#include "contracts/types.hpp"
#include "machine/parameters.hpp"
#include "state_place.hpp"

namespace trunnion::cli {

/// What will be active from the next start on; `place` as state_place() gives it. Reads only. Throws
/// std::runtime_error.
machine::Parameters saved_parameters(const StatePlace& place);

/// Changes them as the parameters service does, its journal included. Throws std::runtime_error when a
/// cluster uses the directory, or with the reason why the change is refused.
idl::parameters::ParameterReply change_saved_parameters(const StatePlace& place,
                                                        const idl::parameters::ParameterRequest& request);

}  // namespace trunnion::cli
