// SPDX-License-Identifier: Apache-2.0
// The documents of an MTConnect agent (MTConnect Standard 2.4), as XML.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "mtconnect/device_model.hpp"
#include "mtconnect/observations.hpp"

namespace trunnion::gateway::mtconnect {

/// A tool as an asset. Lengths in mm.
struct ToolAsset {
  std::uint32_t number = 0;
  double length = 0;    ///< with wear
  double diameter = 0;  ///< with wear
  std::string name, time;
  bool removed = false;
  std::string id() const { return "T" + std::to_string(number); }
};

/// What every header says.
struct AgentHeader {
  std::uint64_t instance = 1;  ///< s since 1970-01-01 UTC, of the agent's start
  std::string sender;          ///< name of the computer
  std::string now;             ///< time of the document
  std::string model_changed;   ///< time since which the device is as it is
  std::size_t buffer_size = 0, assets = 0;
};
inline constexpr std::size_t most_assets = 1024;

/// A request that cannot be answered.
struct RequestError : std::runtime_error {
  RequestError(unsigned answered, std::string error_code, const std::string& text)
      : std::runtime_error(text), status(answered), code(std::move(error_code)) {}
  unsigned status;   ///< of HTTP
  std::string code;  ///< INVALID_REQUEST ...
};

std::string error_document(const AgentHeader& header, const RequestError& error);
std::string devices_document(const AgentHeader& header, const Device& device);
/// `observations` ascending by sequence; `first`, `last` and `next` as in the header.
std::string streams_document(const AgentHeader& header, const Device& device,
                             const std::vector<const Observation*>& observations, std::uint64_t first,
                             std::uint64_t last, std::uint64_t next);
std::string assets_document(const AgentHeader& header, const Device& device,
                            const std::vector<ToolAsset>& assets);

/// The items by their number: the components in their order, and in each its items.
std::vector<const DataItem*> items_of(const Device& device);

/// Numbers of the items that the XPath 1.0 expression `path` finds in the devices document: a data item, or
/// those below a component. Throws RequestError INVALID_PATH when it is no XPath or finds nothing.
std::set<std::uint32_t> items_at(const Device& device, const std::string& path);

}  // namespace trunnion::gateway::mtconnect
