// SPDX-License-Identifier: Apache-2.0
// The bodies of the machine over HTTP.
#pragma once

#include <string>

#include "answer.hpp"
#include "cluster_side/mailbox.hpp"
#include "core/worker.hpp"

namespace trunnion::gateway {

/// Answers GET /api/bodies/{channel} later, from `files`: bodies.yaml in `directory` is read anew
/// each time. 404 without that channel, 409 with the place of an error in the file.
void answer_bodies(const Mailbox& mailbox, Worker& files, const std::string& directory,
                   const std::string& channel, const Respond& respond);

}  // namespace trunnion::gateway
