// SPDX-License-Identifier: Apache-2.0
#include "service/snapshot_desk.hpp"

#include <unistd.h>

#include <fstream>
#include <stdexcept>

#include "bus/json.hpp"
#include "machine/services.hpp"
#include "service/node.hpp"
#include "snapshot/assembly.hpp"
#include "text/utf8.hpp"

namespace trunnion::service {
namespace {
constexpr std::size_t longest_detail = 192;  // as in idl/service.idl
}

SnapshotDesk::SnapshotDesk(bus::Bus& bus, const Options& options)
    : bus_(bus),
      requests_(bus.reader(topics::snapshot_request)),
      snapshots_(bus.writer(topics::service_snapshot)) {
  head_.instance = options.instance;
  head_.service = options.service;
  const auto* definition = machine::find_service(options.service);
  if (definition != nullptr && definition->per_channel)
    head_.channel = static_cast<std::uint16_t>(options.channel);
  head_.pid = getpid();
}

void SnapshotDesk::serve(Service& service) {
  using idl::service::SnapshotKind;
  idl::service::SnapshotRequest request;
  while (requests_.take(request)) asked_ = true, refused_ = false;
  if (!asked_) return;
  const auto answer = service.snapshot();
  asked_ = answer.kind == SnapshotKind::LATER;
  if (asked_ && refused_) return;
  refused_ = asked_;
  ++head_.number;
  head_.time = static_cast<std::uint64_t>(bus::source_time());
  head_.kind = answer.kind;
  head_.detail = text::shortened(answer.detail, longest_detail);
  head_.taken.clear();
  for (const auto& [topic, time] : bus_.taken())
    head_.taken.push_back({topic, static_cast<std::uint64_t>(time)});
  for (const auto& part : snapshot::parts_of(head_, answer.state)) snapshots_.write(part);
}

std::shared_ptr<const bus::Json> read_snapshot(const std::string& file) {
  if (file.empty()) return nullptr;
  std::ifstream in(file, std::ios::binary);
  auto state = std::make_shared<bus::Json>(bus::Json::parse(in, nullptr, false));
  if (!state->is_object()) throw std::runtime_error(file + ": no snapshot of a service");
  return state;
}

}  // namespace trunnion::service
