// SPDX-License-Identifier: Apache-2.0
// Configurations of PLCopen XML as words of Structured Text.
#pragma once

#include "plc/plcopen/document.hpp"

namespace trunnion::st::plcopen {

/// The global variables of an element `configuration` and of its resources, and, when it has instances of
/// programs, a CONFIGURATION. What is wrong is reported, and missing in the result.
Tokens configuration_words(Document& document, Node configuration);

}  // namespace trunnion::st::plcopen
