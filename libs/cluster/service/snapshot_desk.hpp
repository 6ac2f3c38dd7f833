// SPDX-License-Identifier: Apache-2.0
// Gives the explicit state of a service to recorders that ask for it.
#pragma once

#include <memory>
#include <string>

#include "bus/bus.hpp"
#include "bus/json_type.hpp"
#include "contracts/topics.hpp"
#include "service/options.hpp"

namespace trunnion::service {

class Service;

/// What a service answers to the request for its state.
struct SnapshotAnswer {
  idl::service::SnapshotKind kind = idl::service::SnapshotKind::NOT_NEEDED;
  std::string detail;  ///< LATER: why, one line
  std::string state;   ///< GIVEN: JSON by the names of its fields
};

class SnapshotDesk {
 public:
  SnapshotDesk(bus::Bus& bus, const Options& options);
  /// Between two calls of pump(): answers what has been asked. A state that cannot be given now is asked of
  /// the service again in every call.
  void serve(Service& service);

 private:
  bus::Bus& bus_;
  idl::service::ServiceSnapshot head_;
  bus::Reader<idl::service::SnapshotRequest> requests_;
  bus::Writer<idl::service::ServiceSnapshot> snapshots_;
  bool asked_ = false, refused_ = false;
};

/// The state in `file`, null when the name is empty. Throws std::runtime_error naming the file.
std::shared_ptr<const bus::Json> read_snapshot(const std::string& file);

}  // namespace trunnion::service
