// SPDX-License-Identifier: Apache-2.0
// Keeps Cyclone DDS on the loopback interface: it binds its sockets to no address.
#pragma once

namespace trunnion::bus {

/// Whether the domains of Cyclone DDS that this process makes from now on receive on the loopback interface
/// only.
void bind_to_loopback(bool only);

}  // namespace trunnion::bus
