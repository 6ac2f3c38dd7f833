// SPDX-License-Identifier: Apache-2.0
// Who has written a message, from the discovery of Cyclone DDS.
#pragma once

#include <dds/dds.h>

#include "bus/endpoint.hpp"

namespace trunnion::bus {

/// Where a writer is, as `participant` has discovered it; nothing of one that has left. It makes readers of
/// the built-in topics and ends them, so it is not for every message.
WriterOrigin cyclone_origin(dds_entity_t participant, const WriterId& writer);

}  // namespace trunnion::bus
