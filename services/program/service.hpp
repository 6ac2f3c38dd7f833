// SPDX-License-Identifier: Apache-2.0
// The process that keeps the part programs on disk and publishes their list.
#pragma once

#include <optional>

#include "directory_files.hpp"
#include "program_store.hpp"
#include "service/node.hpp"
#include "service/request.hpp"
#include "standby_service.hpp"

namespace trunnion::program {

class ProgramService : public service::Service {
 public:
  /// The service while it is on standby.
  using Standby = StandbyService;

  explicit ProgramService(service::Node& node);
  void pump() override;
  double period() const override { return 0.25; }
  service::Health health() const override;
  service::SnapshotAnswer snapshot() override;

 private:
  void raise_damaged();
  void watch_channels();
  service::Node& node_;
  DirectoryFiles programs_, state_;
  std::optional<DirectoryFiles> cycles_;
  ProgramStore store_;
  bus::Writer<idl::program::ProgramList> list_;
  bus::Reader<idl::channel::ChannelState> channels_;
  service::RequestServer<idl::program::ProgramRequest, idl::program::ProgramReply> requests_;
};

}  // namespace trunnion::program
