#pragma once

#include <optional>

#include "directory_files.hpp"
#include "node/node.hpp"
#include "node/request.hpp"
#include "program_store.hpp"
#include "rehearsal_service.hpp"

namespace trunnion::program {

class ProgramService : public node::Service {
 public:
  /// What it does while it is a shadow.
  using Rehearsal = RehearsalService;

  explicit ProgramService(node::Node& node);
  void pump() override;
  double period() const override { return 0.25; }
  node::Health health() const override;

 private:
  node::Node& node_;
  DirectoryFiles programs_, state_;
  std::optional<DirectoryFiles> cycles_;
  ProgramStore store_;
  bus::Writer<idl::program::ProgramList> list_;
  node::RequestServer<idl::program::ProgramRequest, idl::program::ProgramReply> requests_;
};

}  // namespace trunnion::program
