// SPDX-License-Identifier: Apache-2.0
// The writers that a participant of Fast DDS has discovered, handed from the vendor's threads to the one that
// asks.
#pragma once

#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>

#include <atomic>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "bus/endpoint.hpp"

namespace trunnion::bus {

inline WriterId id_of(const eprosima::fastrtps::rtps::InstanceHandle_t& handle) {
  WriterId id;
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = handle.value[i];
  return id;
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
    auto* const news = new News{{id_of(eprosima::fastrtps::rtps::InstanceHandle_t(found.info.guid())),
                                 found.info.topicName().to_string(),
                                 found.info.typeName().to_string(),
                                 {data.begin(), data.end()}},
                                found.status == Found::REMOVED_WRITER,
                                heard_.load()};
    while (!heard_.compare_exchange_weak(news->before, news)) {
    }
  }

  /// All writers that are there now; false and `writers` as it was when nothing has changed since the last
  /// call. For one thread.
  bool take_changes(std::vector<DiscoveredWriter>& writers) {
    News* const newest = heard_.exchange(nullptr);
    if (newest == nullptr) return false;
    std::vector<News*> in_order;
    for (News* news = newest; news != nullptr; news = news->before) in_order.push_back(news);
    for (auto news = in_order.rbegin(); news != in_order.rend(); ++news) {
      if ((*news)->removed)
        writers_.erase((*news)->writer.id);
      else
        writers_[(*news)->writer.id] = std::move((*news)->writer);
    }
    free(newest);
    writers.clear();
    for (const auto& [id, writer] : writers_) writers.push_back(writer);
    return true;
  }

 private:
  struct News {
    DiscoveredWriter writer;
    bool removed;
    News* before;
  };
  static void free(News* news) {
    while (news != nullptr) delete std::exchange(news, news->before);
  }
  std::atomic<News*> heard_{nullptr};
  std::map<WriterId, DiscoveredWriter> writers_;
};

}  // namespace trunnion::bus
