// SPDX-License-Identifier: Apache-2.0
// What of a service a recording exercises: a verification proves nothing of the rest. No DDS, no clock.
#pragma once

#include <string>
#include <vector>

#include "verification/stored_recording.hpp"

namespace trunnion::verification {

struct Feature {
  std::string name;
  bool seen = false;
};

/// The features of `service` and whether `expected`, its outputs that are compared, show them; `recording`
/// has the inputs. Empty for a service without a list of features.
std::vector<Feature> coverage_of(const std::string& service, const std::vector<StoredMessage>& expected,
                                 const StoredRecording& recording);

/// "2 of 3 features seen: backlash, pitch error; not correction".
std::string text_of(const std::vector<Feature>& features);

/// Those of `required` that were not seen, "all" for every one. Throws std::runtime_error for a name that is
/// none.
std::vector<std::string> missing(const std::vector<Feature>& features,
                                 const std::vector<std::string>& required);

}  // namespace trunnion::verification
