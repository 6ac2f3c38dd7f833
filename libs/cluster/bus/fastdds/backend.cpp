// SPDX-License-Identifier: Apache-2.0
// Fast DDS 2.9 back end: one TopicDataType that carries CDR bytes. UDP only (shared memory leaves stale
// segments after kill -9), no TypeObjects, short heartbeats so that a late joiner gets the history at once.
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <cstring>
#include <sstream>
#include <stdexcept>

#include "bus/endpoint.hpp"
#include "bus/endpoint_log.hpp"
#include "bus/security.hpp"
#include "discovery.hpp"

namespace trunnion::bus {
namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;
using eprosima::fastrtps::types::ReturnCode_t;
using DdsTopic = eprosima::fastdds::dds::Topic;  // not our own Topic

constexpr std::uint32_t initial_payload = 1024;

class BytesType : public TopicDataType {
 public:
  explicit BytesType(const TopicDescription& topic) : key_of_(topic.key_of) {
    setName(topic.wire_type.c_str());
    m_typeSize = initial_payload;
    m_isGetKeyDefined = topic.keyed;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<const Bytes*>(data);
    if (bytes.size() > payload->max_size) return false;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void* data, InstanceHandle_t* handle, bool) override {
    KeyHash key{};
    if (!m_isGetKeyDefined || !key_of_(*static_cast<const Bytes*>(data), key)) return false;
    for (std::size_t i = 0; i < key.size(); ++i) handle->value[i] = key[i];
    return true;
  }

 private:
  bool (*key_of_)(std::span<const std::uint8_t>, KeyHash&);
};

eprosima::fastrtps::Duration_t duration(double seconds) {
  return {static_cast<std::int32_t>(seconds),
          static_cast<std::uint32_t>((seconds - static_cast<std::int32_t>(seconds)) * 1e9)};
}

template <class Q>
void apply(Q& out, const EndpointQos& qos, bool keyed) {
  constexpr int keep_all_samples = 20000, instances = 256;
  out.reliability().kind = RELIABLE_RELIABILITY_QOS;
  out.reliability().max_blocking_time = duration(0.1);
  out.durability().kind = qos.transient_local ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  out.history().kind = qos.depth > 0 ? KEEP_LAST_HISTORY_QOS : KEEP_ALL_HISTORY_QOS;
  if (qos.depth > 0) out.history().depth = qos.depth;
  const int per_instance = qos.depth > 0 ? qos.depth : keep_all_samples;
  auto& limits = out.resource_limits();
  limits.max_instances = keyed ? instances : 1;
  limits.max_samples_per_instance = per_instance;
  limits.max_samples = keyed ? instances * per_instance : per_instance;
  limits.allocated_samples = 10;
  out.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  out.data_sharing().off();
}

class Writer : public RawWriter {
 public:
  Writer(Publisher* publisher, DdsTopic* topic, const EndpointQos& qos, bool keyed) : publisher_(publisher) {
    DataWriterQos out = DATAWRITER_QOS_DEFAULT;
    apply(out, qos, keyed);
    out.writer_data_lifecycle().autodispose_unregistered_instances = false;
    auto& times = out.reliable_writer_qos().times;
    // A history that is kept for whoever is late is always full, and Fast DDS then adds a heartbeat to every
    // sample for each of its readers, which every one of them answers. Twenty milliseconds find a lost packet
    // as well.
    const bool always_full = qos.transient_local && qos.depth > 1 && !keyed;
    out.reliable_writer_qos().disable_heartbeat_piggyback = always_full;
    times.heartbeatPeriod = duration(always_full ? 0.02 : 0.1);
    times.nackResponseDelay = duration(0);
    times.initialHeartbeatDelay = duration(0);
    out.user_data().data_vec({qos.user_data.begin(), qos.user_data.end()});
    writer_ = publisher_->create_datawriter(topic, out);
    if (writer_ == nullptr) throw std::runtime_error("Fast DDS: writer of " + topic->get_name());
  }
  ~Writer() override { publisher_->delete_datawriter(writer_); }
  bool write(std::span<const std::uint8_t> cdr, std::int64_t time) override {
    buffer_.assign(cdr.begin(), cdr.end());
    constexpr std::int64_t second = 1'000'000'000;
    const eprosima::fastrtps::Time_t stamp(static_cast<std::int32_t>(time / second),
                                           static_cast<std::uint32_t>(time % second));
    return writer_->write_w_timestamp(&buffer_, InstanceHandle_t(), stamp) == ReturnCode_t::RETCODE_OK;
  }
  int matched() override {
    PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count;
  }

 private:
  Publisher* publisher_;
  DataWriter* writer_;
  Bytes buffer_;
};

class Reader : public RawReader, DataReaderListener {
 public:
  Reader(Subscriber* subscriber, DdsTopic* topic, const EndpointQos& qos, bool keyed, Signal* signal)
      : subscriber_(subscriber), signal_(signal) {
    DataReaderQos in = DATAREADER_QOS_DEFAULT;
    apply(in, qos, keyed);
    in.reliable_reader_qos().times.heartbeatResponseDelay = duration(0);
    // Repeated at this interval until the writer's first heartbeat, which one of Cyclone that has written
    // nothing never sends: with 0 every such pair would keep a core busy for ever.
    in.reliable_reader_qos().times.initialAcknackDelay = duration(0.05);
    StatusMask mask = StatusMask::none();
    if (signal_ != nullptr) mask << StatusMask::data_available();
    reader_ = subscriber_->create_datareader(topic, in, signal_ != nullptr ? this : nullptr, mask);
    if (reader_ == nullptr) throw std::runtime_error("Fast DDS: reader of " + topic->get_name());
  }
  ~Reader() override { subscriber_->delete_datareader(reader_); }
  void on_data_available(DataReader*) override { signal_->notify(); }
  bool take(Bytes& cdr, SampleInfo& info) override {
    eprosima::fastdds::dds::SampleInfo sample;
    while (reader_->take_next_sample(&cdr, &sample) == ReturnCode_t::RETCODE_OK) {
      if (!sample.valid_data) continue;
      info.source_timestamp = sample.source_timestamp.to_ns();
      info.writer = id_of(sample.publication_handle);
      return true;
    }
    return false;
  }
  int matched() override {
    SubscriptionMatchedStatus status;
    reader_->get_subscription_matched_status(status);
    return status.current_count;
  }

 private:
  Subscriber* subscriber_;
  Signal* signal_;
  DataReader* reader_;
};

void secure(DomainParticipantQos& qos, const NetworkSettings& network) {
  if (network.security.empty()) return;
  auto files = security_files(network, Vendor::fastdds);
  const auto set = [&](const std::string& name, std::string value) {
    constexpr const char* scheme = "file:";
    if (value.rfind(scheme, 0) == 0) value.insert(5, "//");
    qos.properties().properties().emplace_back("dds.sec." + name, value);
  };
  const std::string auth = "auth.builtin.PKI-DH.", access = "access.builtin.Access-Permissions.";
  set("auth.plugin", "builtin.PKI-DH");
  set(auth + "identity_ca", files.authority);
  set(auth + "identity_certificate", files.certificate);
  set(auth + "private_key", files.key);
  set("access.plugin", "builtin.Access-Permissions");
  set(access + "permissions_ca", files.authority);
  set(access + "governance", files.governance);
  set(access + "permissions", files.permissions);
  set("crypto.plugin", "builtin.AES-GCM-GMAC");
}

class FastBackend : public Backend {
 public:
  explicit FastBackend(const NetworkSettings& network) : identity_(network.identity) {
    using namespace eprosima::fastdds::rtps;
    DomainParticipantQos qos = PARTICIPANT_QOS_DEFAULT;
    auto udp = std::make_shared<UDPv4TransportDescriptor>();
    udp->interfaceWhiteList.push_back(network.interface_address);
    udp->maxInitialPeersRange = 40;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    auto& builtin = qos.wire_protocol().builtin;
    std::istringstream peers(network.multicast ? "" : network.peers);
    for (std::string peer; std::getline(peers, peer, ',');) {
      eprosima::fastrtps::rtps::Locator_t locator;
      locator.kind = LOCATOR_KIND_UDPv4;
      eprosima::fastrtps::rtps::IPLocator::setIPv4(locator, peer);
      builtin.initialPeersList.push_back(locator);
    }
    // An (invalid) unicast locator in the list keeps Fast DDS from adding the multicast one.
    if (!network.multicast)
      builtin.metatrafficUnicastLocatorList.push_back(eprosima::fastrtps::rtps::Locator_t());
    builtin.discovery_config.leaseDuration = duration(lease_seconds(network));
    builtin.discovery_config.leaseDuration_announcementperiod = duration(0.5);
    qos.user_data().setValue({network.identity.begin(), network.identity.end()});
    secure(qos, network);
    participant_ = DomainParticipantFactory::get_instance()->create_participant(
        network.domain, qos, &discovery_, StatusMask::none());
    if (participant_ == nullptr)
      throw std::runtime_error("Fast DDS: participant in domain " + std::to_string(network.domain));
    publisher_ = participant_->create_publisher(PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
  }
  ~FastBackend() override {
    participant_->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  std::unique_ptr<RawWriter> writer(const TopicDescription& description, const EndpointQos& qos) override {
    log_endpoint(identity_, true, description.name);
    return std::make_unique<Writer>(publisher_, topic(description), qos, description.keyed);
  }
  std::unique_ptr<RawReader> reader(const TopicDescription& description, const EndpointQos& qos,
                                    Signal* signal) override {
    log_endpoint(identity_, false, description.name);
    return std::make_unique<Reader>(subscriber_, topic(description), qos, description.keyed, signal);
  }
  bool discover(std::vector<DiscoveredWriter>& writers) override { return discovery_.take_changes(writers); }
  WriterOrigin origin_of(const WriterId& writer) override { return discovery_.origin_of(writer); }
  void keep_up() override { discovery_.keep_up(); }

 private:
  DdsTopic* topic(const TopicDescription& description) {
    if (auto* known = participant_->lookup_topicdescription(description.name))
      return static_cast<DdsTopic*>(known);
    if (participant_->find_type(description.wire_type).empty()) {
      TypeSupport type(new BytesType(description));
      type.register_type(participant_, description.wire_type);
    }
    auto* result = participant_->create_topic(description.name, description.wire_type, TOPIC_QOS_DEFAULT);
    if (result == nullptr) throw std::runtime_error("Fast DDS: topic " + description.name);
    return result;
  }

  const std::string identity_;
  Discovery discovery_;
  DomainParticipant* participant_;
  Publisher* publisher_;
  Subscriber* subscriber_;
};

}  // namespace

std::unique_ptr<Backend> make_fastdds(const NetworkSettings& network) {
  return std::make_unique<FastBackend>(network);
}

}  // namespace trunnion::bus
