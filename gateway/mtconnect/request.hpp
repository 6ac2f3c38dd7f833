// SPDX-License-Identifier: Apache-2.0
// Requests to an MTConnect agent (MTConnect Standard 2.4, part 1, section 8).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trunnion::gateway::mtconnect {

enum class Kind { probe, current, sample, assets };

struct Request {
  Kind kind = Kind::probe;
  std::string path;                   ///< XPath; empty = everything
  std::optional<std::uint64_t> at;    ///< current: state after this observation
  std::optional<std::uint64_t> from;  ///< sample: first observation
  std::int64_t count = 100;  ///< sample: observations; negative = backwards from `from`. assets: at most
  std::optional<std::uint32_t> interval;  ///< ms between two documents of a stream; none = one document
  std::uint32_t heartbeat = 10000;        ///< ms after which a stream sends an empty document
  std::vector<std::string> assets;        ///< ids that are asked for; empty = all
  bool removed = false;                   ///< assets: also those that were removed
  std::string type;                       ///< assets: of this type only; empty = all
};

/// `method` and `target` (path and query) of an HTTP request to an agent whose only device has this name and
/// UUID. Observations are limited to `buffer_size`. Throws RequestError (documents.hpp).
Request parse_request(std::string_view method, std::string_view target, const std::string& device,
                      const std::string& uuid, std::size_t buffer_size);

}  // namespace trunnion::gateway::mtconnect
