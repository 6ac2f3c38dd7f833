// SPDX-License-Identifier: Apache-2.0
// What a service must agree on with the others: the topics it writes and reads.
#pragma once

#include <string>
#include <vector>

#include "bus/registry.hpp"

namespace trunnion::bus {

/// 16 hexadecimal digits: FNV-1a, 64 bits, over name, type on the wire and quality of service of every topic
/// that `service` writes or reads by topics.yaml, in the order of the names. Services of different builds
/// understand each other when the contracts of each are equal in both, whatever else has changed.
/// `tools/generate_sdk.py` computes the same for services in C.
std::string contract_of(const std::string& service, const std::vector<TopicEntry>& topics = all_topics());

}  // namespace trunnion::bus
