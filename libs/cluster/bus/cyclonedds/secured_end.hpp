// SPDX-License-Identifier: Apache-2.0
// The end of a process with DDS Security, which Cyclone DDS needs help with.
#pragma once

namespace trunnion::bus {

/// Ends all domains of a process that ends with `status` and had a secured one. Their threads would go on
/// encrypting while OpenSSL, loaded with the security plugins, clears up; what is registered for the end
/// later is called earlier. A domain whose network is gone does not end: after 2 s the process does.
void end_secured_domains(int status);

}  // namespace trunnion::bus
