// SPDX-License-Identifier: Apache-2.0
// Which files of a directory make the programs of a PLC.
#pragma once

#include <string>

namespace trunnion::st {

/// Whether a file of this name is a source: what is compiled (.st except *_test.st, .xml), fast.il, main.il,
/// devices.yaml, messages.yaml, modbus.yaml.
bool is_source(const std::string& name);

}  // namespace trunnion::st
