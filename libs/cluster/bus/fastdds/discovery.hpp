// SPDX-License-Identifier: Apache-2.0
// The writers and processes that a participant of Fast DDS has discovered, handed from the vendor's threads
// to the one that asks.
#pragma once

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bus/endpoint.hpp"

namespace trunnion::bus {

inline WriterId id_of(const eprosima::fastrtps::rtps::InstanceHandle_t& handle) {
  WriterId id;
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = handle.value[i];
  return id;
}

inline WriterOrigin origin_of(const eprosima::fastrtps::rtps::ParticipantProxyData& found) {
  using eprosima::fastrtps::rtps::IPLocator;
  WriterOrigin origin;
  origin.participant = prefix_text(found.m_guid.guidPrefix.value);
  const auto& data = found.m_userData.data_vec();
  origin.identity.assign(data.begin(), data.end());
  for (const auto& property : found.m_properties) take_property(origin, property.first(), property.second());
  const auto& addresses = found.metatraffic_locators.unicast;
  if (!addresses.empty())
    origin.address = IPLocator::ip_to_string(*addresses.begin()) + ":" +
                     std::to_string(IPLocator::getPhysicalPort(*addresses.begin()));
  return origin;
}

/// A listener takes no lock: what it hears is pushed onto a list, of which the asking thread takes all at
/// once.
class Discovery : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  Discovery() = default;
  ~Discovery() override { free(heard_.load()); }
  Discovery(const Discovery&) = delete;
  Discovery& operator=(const Discovery&) = delete;

  void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant*,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& found) override {
    using Found = eprosima::fastrtps::rtps::WriterDiscoveryInfo;
    const auto& data = found.info.m_qos.m_userData.data_vec();
    auto* const news = new News;
    news->writer = {id_of(eprosima::fastrtps::rtps::InstanceHandle_t(found.info.guid())),
                    found.info.topicName().to_string(),
                    found.info.typeName().to_string(),
                    {data.begin(), data.end()}};
    news->removed = found.status == Found::REMOVED_WRITER;
    push(news);
  }

  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& found) override {
    using Found = eprosima::fastrtps::rtps::ParticipantDiscoveryInfo;
    auto* const news = new News;
    news->writer.id = id_of(eprosima::fastrtps::rtps::InstanceHandle_t(found.info.m_guid));
    news->process = bus::origin_of(found.info);
    news->removed = found.status == Found::REMOVED_PARTICIPANT || found.status == Found::DROPPED_PARTICIPANT;
    push(news);
  }

  /// What was heard is no longer kept message by message.
  void keep_up() {
    News* const newest = heard_.exchange(nullptr);
    std::vector<News*> in_order;
    for (News* news = newest; news != nullptr; news = news->before) in_order.push_back(news);
    for (auto news = in_order.rbegin(); news != in_order.rend(); ++news) take(**news);
    free(newest);
  }

  /// All writers that are there now; false and `writers` as it was when nothing has changed since the last
  /// call. For one thread, as are origin_of() and keep_up().
  bool take_changes(std::vector<DiscoveredWriter>& writers) {
    keep_up();
    if (!std::exchange(changed_, false)) return false;
    writers.clear();
    for (const auto& [id, writer] : writers_) writers.push_back(writer);
    return true;
  }

  /// Of a writer whose process has left only what its id tells.
  WriterOrigin origin_of(const WriterId& writer) {
    keep_up();
    const auto found = processes_.find(prefix_of(writer));
    if (found != processes_.end()) return found->second;
    WriterOrigin origin;
    origin.participant = prefix_text(writer);
    return origin;
  }

 private:
  struct News {
    DiscoveredWriter writer;  // of a process its id alone
    std::optional<WriterOrigin> process;
    bool removed = false;
    News* before = nullptr;
  };
  using Prefix = std::array<std::uint8_t, 12>;
  static Prefix prefix_of(const WriterId& id) {
    Prefix prefix;
    std::copy_n(id.begin(), prefix.size(), prefix.begin());
    return prefix;
  }
  void push(News* news) {
    news->before = heard_.load();
    while (!heard_.compare_exchange_weak(news->before, news)) {
    }
  }
  void take(News& news) {
    if (news.process) {
      if (news.removed)
        processes_.erase(prefix_of(news.writer.id));
      else
        processes_[prefix_of(news.writer.id)] = std::move(*news.process);
      return;
    }
    changed_ = true;
    if (news.removed)
      writers_.erase(news.writer.id);
    else
      writers_[news.writer.id] = std::move(news.writer);
  }
  static void free(News* news) {
    while (news != nullptr) delete std::exchange(news, news->before);
  }
  std::atomic<News*> heard_{nullptr};
  std::map<WriterId, DiscoveredWriter> writers_;
  std::map<Prefix, WriterOrigin> processes_;
  bool changed_ = false;  // the writers, since they were asked for
};

}  // namespace trunnion::bus
