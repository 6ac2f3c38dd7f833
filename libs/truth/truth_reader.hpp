// SPDX-License-Identifier: Apache-2.0
// The reader of truth.yaml.
#pragma once

#include "machine/yaml_reader.hpp"

namespace trunnion::truth {

using machine::Limits;
using TruthReader = machine::YamlReader;

}  // namespace trunnion::truth
