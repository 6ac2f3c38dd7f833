// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS 0.10 back end. A custom sertype carries CDR bytes made by bus/cdr.hpp, so that both vendors and
// every tool share one set of types. No TypeObjects are registered: mixed clusters match by (hashed) type
// name alone.
#include <dds/dds.h>
#include <dds/ddsi/ddsi_keyhash.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>
#include <dds/ddsrt/log.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "bus/endpoint.hpp"
#include "bus/endpoint_log.hpp"
#include "bus/security.hpp"
#include "loopback_bind.hpp"
#include "origin.hpp"
#include "secured_end.hpp"

#ifndef TRUNNION_CYCLONE_PLUGINS
#define TRUNNION_CYCLONE_PLUGINS ""
#endif

namespace trunnion::bus {
namespace {

using KeyFunction = bool (*)(std::span<const std::uint8_t>, KeyHash&);

struct SerType : ddsi_sertype {
  bool keyed;
  KeyFunction key_of;
};

struct SerData : ddsi_serdata {
  std::uint8_t* bytes;
  std::uint32_t size;
  KeyHash key;
};

SerData* cast(const ddsi_serdata* data) { return static_cast<SerData*>(const_cast<ddsi_serdata*>(data)); }
const SerType& type_of(const ddsi_sertype* type) { return *static_cast<const SerType*>(type); }

// The protocol may read up to the next multiple of four, so the buffer is padded with zeros.
SerData* make_data(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size) {
  auto* data = new SerData{};
  ddsi_serdata_init(data, type, kind);
  data->size = static_cast<std::uint32_t>(size);
  data->bytes = static_cast<std::uint8_t*>(std::calloc(1, (size + 3) & ~std::size_t{3}));
  return data;
}

void free_data(ddsi_serdata* base) {
  auto* data = cast(base);
  std::free(data->bytes);
  delete data;
}

void set_hash(SerData* data) {
  data->hash = data->type->serdata_basehash;
  for (int i = 0; i < 4; ++i) {
    std::uint32_t word;
    std::memcpy(&word, data->key.data() + 4 * i, 4);
    data->hash = data->hash * 31 + word;
  }
}

// Data from the wire: a keyed sample whose key cannot be read is not this type and is dropped.
ddsi_serdata* finish(SerData* data) {
  const auto& type = type_of(data->type);
  if (type.keyed) {
    if (data->kind == SDK_KEY) {
      if (data->size > cdr_header)
        std::memcpy(data->key.data(), data->bytes + cdr_header,
                    std::min<std::size_t>(16, data->size - cdr_header));
    } else if (!type.key_of({data->bytes, data->size}, data->key)) {
      free_data(data);
      return nullptr;
    }
  }
  set_hash(data);
  return data;
}

ddsi_serdata* from_wire(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragments,
                        std::size_t size) {
  auto* data = make_data(type, kind, size);
  std::size_t at = 0;
  for (; fragments != nullptr; fragments = fragments->nextfrag) {
    if (fragments->maxp1 <= at) continue;
    const unsigned char* payload = NN_RMSG_PAYLOADOFF(fragments->rmsg, NN_RDATA_PAYLOAD_OFF(fragments));
    std::memcpy(data->bytes + at, payload + at - fragments->min, fragments->maxp1 - at);
    at = fragments->maxp1;
  }
  return finish(data);
}

ddsi_serdata* from_vectors(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                           const ddsrt_iovec_t* vectors, std::size_t size) {
  auto* data = make_data(type, kind, size);
  std::size_t at = 0;
  for (std::size_t i = 0; i < count && at < size; ++i) {
    const std::size_t part = std::min<std::size_t>(vectors[i].iov_len, size - at);
    std::memcpy(data->bytes + at, vectors[i].iov_base, part);
    at += part;
  }
  return finish(data);
}

ddsi_serdata* from_keyhash(const ddsi_sertype* type, const ddsi_keyhash* hash) {
  if (!type_of(type).keyed) return nullptr;
  auto* data = make_data(type, SDK_KEY, cdr_header);
  std::memcpy(data->key.data(), hash->value, data->key.size());
  set_hash(data);
  return data;
}

// Our "sample" is a span of CDR bytes.
ddsi_serdata* from_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, const void* sample) {
  const auto& cdr = *static_cast<const std::span<const std::uint8_t>*>(sample);
  auto* data = make_data(type, kind, cdr.size());
  std::memcpy(data->bytes, cdr.data(), cdr.size());
  return finish(data);
}

const ddsi_serdata_ops serdata_ops = [] {
  ddsi_serdata_ops ops{};
  ops.eqkey = [](const ddsi_serdata* a, const ddsi_serdata* b) { return cast(a)->key == cast(b)->key; };
  ops.get_size = [](const ddsi_serdata* d) { return cast(d)->size; };
  ops.from_ser = from_wire;
  ops.from_ser_iov = from_vectors;
  ops.from_keyhash = from_keyhash;
  ops.from_sample = from_sample;
  ops.to_ser = [](const ddsi_serdata* d, std::size_t at, std::size_t size, void* out) {
    std::memcpy(out, cast(d)->bytes + at, size);
  };
  ops.to_ser_ref = [](const ddsi_serdata* d, std::size_t at, std::size_t size, ddsrt_iovec_t* out) {
    out->iov_base = cast(d)->bytes + at;
    out->iov_len = size;
    return ddsi_serdata_ref(d);
  };
  ops.to_ser_unref = [](ddsi_serdata* d, const ddsrt_iovec_t*) { ddsi_serdata_unref(d); };
  ops.to_sample = [](const ddsi_serdata*, void*, void**, void*) { return false; };
  ops.to_untyped = [](const ddsi_serdata* d) -> ddsi_serdata* {
    auto* key = make_data(d->type, SDK_KEY, cdr_header);
    key->type = nullptr;
    key->key = cast(d)->key;
    key->hash = d->hash;
    return key;
  };
  ops.untyped_to_sample = [](const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) { return true; };
  ops.free = free_data;
  ops.print = [](const ddsi_sertype*, const ddsi_serdata*, char* out, std::size_t size) {
    return static_cast<std::size_t>(std::snprintf(out, size, "[cdr]"));
  };
  ops.get_keyhash = [](const ddsi_serdata* d, ddsi_keyhash* out, bool) {
    std::memcpy(out->value, cast(d)->key.data(), cast(d)->key.size());
  };
  return ops;
}();

const ddsi_sertype_ops sertype_ops = [] {
  ddsi_sertype_ops ops{};
  ops.version = ddsi_sertype_v0;
  ops.free = [](ddsi_sertype* type) {
    ddsi_sertype_fini(type);
    delete static_cast<SerType*>(type);
  };
  ops.zero_samples = [](const ddsi_sertype*, void*, std::size_t) {};
  ops.realloc_samples = [](void**, const ddsi_sertype*, void*, std::size_t, std::size_t) {};
  ops.free_samples = [](const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {};
  ops.equal = [](const ddsi_sertype* a, const ddsi_sertype* b) {
    return type_of(a).keyed == type_of(b).keyed && type_of(a).key_of == type_of(b).key_of;
  };
  ops.hash = [](const ddsi_sertype* type) {
    std::uint32_t hash = 5381;
    for (const char* c = type->type_name; *c != 0; ++c) hash = hash * 33 + static_cast<std::uint8_t>(*c);
    return hash;
  };
  return ops;
}();

[[noreturn]] void fail(const std::string& what, dds_return_t code) {
  throw std::runtime_error("Cyclone DDS: " + what + ": " + dds_strretcode(code));
}

dds_entity_t make_topic(dds_entity_t participant, const TopicDescription& topic) {
  auto* type = new SerType{};
  type->keyed = topic.keyed;
  type->key_of = topic.key_of;
  ddsi_sertype_init_flags(
      type, topic.wire_type.c_str(), &sertype_ops, &serdata_ops,
      topic.keyed ? DDSI_SERTYPE_FLAG_REQUEST_KEYHASH : DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  ddsi_sertype* base = type;
  const dds_entity_t entity =
      dds_create_topic_sertype(participant, topic.name.c_str(), &base, nullptr, nullptr, nullptr);
  if (entity < 0) fail("topic " + topic.name, entity);
  return entity;
}

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};

std::unique_ptr<dds_qos_t, QosDeleter> make_qos(const EndpointQos& qos, bool writer) {
  std::unique_ptr<dds_qos_t, QosDeleter> result(dds_create_qos());
  const auto history = qos.depth > 0 ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL;
  const int depth = qos.depth > 0 ? qos.depth : 1;
  dds_qset_reliability(result.get(), DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(result.get(),
                      qos.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(result.get(), history, depth);
  if (writer) {
    if (qos.transient_local)
      dds_qset_durability_service(result.get(), 0, DDS_HISTORY_KEEP_LAST, depth, DDS_LENGTH_UNLIMITED,
                                  DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
    dds_qset_writer_data_lifecycle(result.get(), false);
    if (!qos.user_data.empty()) dds_qset_userdata(result.get(), qos.user_data.data(), qos.user_data.size());
  }
  return result;
}

class Writer : public RawWriter {
 public:
  Writer(dds_entity_t participant, const TopicDescription& description, const EndpointQos& qos)
      : topic_(make_topic(participant, description)),
        writer_(dds_create_writer(participant, topic_, make_qos(qos, true).get(), nullptr)) {
    if (writer_ < 0) fail("writer of " + description.name, writer_);
  }
  ~Writer() override {
    dds_delete(writer_);
    dds_delete(topic_);
  }
  bool write(std::span<const std::uint8_t> cdr, std::int64_t time) override {
    return dds_write_ts(writer_, &cdr, time) == DDS_RETCODE_OK;
  }
  int matched() override {
    dds_publication_matched_status_t status{};
    dds_get_publication_matched_status(writer_, &status);
    return static_cast<int>(status.current_count);
  }

 private:
  dds_entity_t topic_, writer_;
};

WriterId id_of(dds_instance_handle_t handle) {
  WriterId id{};
  std::memcpy(id.data(), &handle, sizeof handle);
  return id;
}

class Reader : public RawReader {
 public:
  Reader(dds_entity_t participant, const TopicDescription& description, const EndpointQos& qos,
         Signal* signal)
      : topic_(make_topic(participant, description)) {
    dds_listener_t* listener = nullptr;
    if (signal != nullptr) {
      listener = dds_create_listener(signal);
      dds_lset_data_available(listener, [](dds_entity_t, void* arg) { static_cast<Signal*>(arg)->notify(); });
    }
    reader_ = dds_create_reader(participant, topic_, make_qos(qos, false).get(), listener);
    if (listener != nullptr) dds_delete_listener(listener);
    if (reader_ < 0) fail("reader of " + description.name, reader_);
  }
  ~Reader() override {
    dds_delete(reader_);
    dds_delete(topic_);
  }
  bool take(Bytes& cdr, SampleInfo& info) override {
    for (;;) {
      ddsi_serdata* base = nullptr;
      dds_sample_info_t sample;
      if (dds_takecdr(reader_, &base, 1, &sample, DDS_ANY_STATE) <= 0) return false;
      const auto* data = cast(base);
      const bool valid = sample.valid_data && data->kind == SDK_DATA;
      if (valid) {
        cdr.assign(data->bytes, data->bytes + data->size);
        info.source_timestamp = sample.source_timestamp;
        info.writer = id_of(sample.publication_handle);
      }
      ddsi_serdata_unref(base);
      if (valid) return true;
    }
  }
  int matched() override {
    dds_subscription_matched_status_t status{};
    dds_get_subscription_matched_status(reader_, &status);
    return static_cast<int>(status.current_count);
  }

 private:
  dds_entity_t topic_, reader_;
};

std::string configuration(const NetworkSettings& network) {
  std::ostringstream xml;
  xml << "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface address=\""
      << network.interface_address << "\"/></Interfaces><AllowMulticast>"
      << (network.multicast ? "spdp" : "false")
      << "</AllowMulticast>"
         // A batch in one piece: fragments of a history that is asked for are sent several times over.
         "<FragmentSize>12000B</FragmentSize></General>"
         "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>39</"
         "MaxAutoParticipantIndex><Peers>";
  std::istringstream peers(network.multicast ? "" : network.peers);
  for (std::string peer; std::getline(peers, peer, ',');) xml << "<Peer address=\"" << peer << "\"/>";
  xml << "</Peers><SPDPInterval>0.5s</SPDPInterval><LeaseDuration>" << lease_seconds(network)
      << "s</LeaseDuration></Discovery>"
         // A writer never waits for a reader that is slow or dead: its bounded history is what it may lose.
         // A packet that a full socket buffer dropped is asked for again within milliseconds, before it is
         // overwritten. The interval between heartbeats doubles while nobody answers; its bound is what a cut
         // cable costs after it is whole again. A writer of Fast DDS asks for an acknowledgement more often
         // than it needs one: what is missing is told within NackDelay anyway. Fast DDS 2.9 understands that
         // somebody has left only by the key hash, and would go on sending until the lease ends.
         "<Internal><Watermarks><WhcHigh>64MB</WhcHigh></Watermarks><NackDelay>5ms</NackDelay>"
         "<AckDelay>100ms</AckDelay><GenerateKeyhash>true</GenerateKeyhash>"
         "<HeartbeatInterval max=\"100ms\">20ms</HeartbeatInterval>"
         // A reader that is there answers a heartbeat at once; when the whole cluster ends nobody does, and
         // every process would wait this long.
         "<WriterLingerDuration>100ms</WriterLingerDuration></Internal>"
         "</Domain></CycloneDDS>";
  return xml.str();
}

// A plugin is named by its whole path, or, where it is among the system's libraries, without directory and
// `lib`.
std::string plugin(const std::string& name) {
  const std::string directory = TRUNNION_CYCLONE_PLUGINS;
  return directory.empty() ? name : directory + "lib" + name + ".so";
}

std::unique_ptr<dds_qos_t, QosDeleter> participant_qos(const NetworkSettings& network) {
  std::unique_ptr<dds_qos_t, QosDeleter> qos(dds_create_qos());
  dds_qset_userdata(qos.get(), network.identity.data(), network.identity.size());
  if (network.security.empty()) return qos;
  const auto files = security_files(network, Vendor::cyclonedds);
  const auto set = [&](const std::string& name, const std::string& value) {
    dds_qset_prop(qos.get(), ("dds.sec." + name).c_str(), value.c_str());
  };
  set("auth.library.path", plugin("dds_security_auth"));
  set("auth.library.init", "init_authentication");
  set("auth.library.finalize", "finalize_authentication");
  set("access.library.path", plugin("dds_security_ac"));
  set("access.library.init", "init_access_control");
  set("access.library.finalize", "finalize_access_control");
  set("crypto.library.path", plugin("dds_security_crypto"));
  set("crypto.library.init", "init_crypto");
  set("crypto.library.finalize", "finalize_crypto");
  set("auth.identity_ca", files.authority);
  set("auth.private_key", files.key);
  set("auth.identity_certificate", files.certificate);
  set("access.permissions_ca", files.authority);
  set("access.governance", files.governance);
  set("access.permissions", files.permissions);
  return qos;
}

// Asking for participants at the addresses of a host that is off fails forty times each half second, and each
// time is a line for Cyclone.
void print_log(void*, const dds_log_data_t* data) {
  const std::string_view line(data->message, data->size);
  if (line.find("ddsi_udp_conn_write") == std::string_view::npos)
    std::fwrite(data->message - data->hdrsize, 1, data->hdrsize + data->size + 1,
                stderr);  // and the new line
}

// The participants of this process. Cyclone DDS 0.10 keeps what it knows of the other processes for the
// domain, not for the participant: when one is deleted while the others still tell it of their endpoints,
// those messages are dropped, and no later participant of this process ever learns of these endpoints. So a
// participant is deleted only at the end of the process, and one that nobody uses is used again.
class Participants {
 public:
  dds_entity_t acquire(const NetworkSettings& network) {
    const std::lock_guard lock(mutex_);
    const auto key = key_of(network);
    if (auto found = idle_.find(key); found != idle_.end()) {
      const auto participant = found->second;
      idle_.erase(found);
      return participant;
    }
    dds_set_log_sink(print_log, nullptr);
    bind_to_loopback(network.interface_address.starts_with("127.") && !network.multicast);
    dds_create_domain(network.domain, configuration(network).c_str());
    const auto participant = dds_create_participant(network.domain, participant_qos(network).get(), nullptr);
    if (participant < 0) fail("participant in domain " + std::to_string(network.domain), participant);
    [[maybe_unused]] static const int once =
        on_exit([](int status, void*) { Participants::of_this_process().end(status); }, nullptr);
    secured_ = secured_ || !network.security.empty();
    return participant;
  }
  void release(const NetworkSettings& network, dds_entity_t participant) {
    const std::lock_guard lock(mutex_);
    idle_.emplace(key_of(network), participant);
  }
  // The others learn at once that this process ends.
  void end(int status) {
    for (const auto& [key, participant] : idle_) dds_delete(participant);
    // A domain without security is left as it is: its end waits for a packet to itself, which never comes
    // when the network is gone.
    if (secured_) end_secured_domains(status);
  }
  static Participants& of_this_process() {
    static auto* const all = new Participants;  // outlives every Bus, static ones too
    return *all;
  }

 private:
  using Key = std::tuple<std::uint32_t, std::string, std::string, bool, std::string, std::string>;
  static Key key_of(const NetworkSettings& n) {
    return {n.domain, n.interface_address, n.peers, n.multicast, n.security, n.identity};
  }
  std::mutex mutex_;
  std::multimap<Key, dds_entity_t> idle_;
  bool secured_ = false;
};

class CycloneBackend : public Backend {
 public:
  explicit CycloneBackend(const NetworkSettings& network)
      : network_(network), participant_(Participants::of_this_process().acquire(network)) {}
  ~CycloneBackend() override {
    if (publications_ >= 0) dds_delete(publications_);
    Participants::of_this_process().release(network_, participant_);
  }
  std::unique_ptr<RawWriter> writer(const TopicDescription& topic, const EndpointQos& qos) override {
    log_endpoint(network_.identity, true, topic.name);
    return std::make_unique<Writer>(participant_, topic, qos);
  }
  std::unique_ptr<RawReader> reader(const TopicDescription& topic, const EndpointQos& qos,
                                    Signal* signal) override {
    log_endpoint(network_.identity, false, topic.name);
    return std::make_unique<Reader>(participant_, topic, qos, signal);
  }
  bool discover(std::vector<DiscoveredWriter>& writers) override {
    if (publications_ < 0) {
      publications_ = dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr);
      if (publications_ < 0) fail("reader of publications", publications_);
    }
    constexpr int most = 32;
    bool any = false;
    void* samples[most] = {};
    dds_sample_info_t infos[most];
    for (int count; (count = dds_take(publications_, samples, infos, most, most)) > 0;) {
      for (int i = 0; i < count; ++i) keep(infos[i], *static_cast<dds_builtintopic_endpoint_t*>(samples[i]));
      dds_return_loan(publications_, samples, count);
      any = true;
    }
    if (!any) return false;
    writers.clear();
    for (const auto& [handle, writer] : discovered_) writers.push_back(writer);
    return true;
  }
  WriterOrigin origin_of(const WriterId& writer) override { return cyclone_origin(participant_, writer); }

 private:
  // The handle of a publication is the same in this topic and with the samples it has written.
  void keep(const dds_sample_info_t& info, const dds_builtintopic_endpoint_t& endpoint) {
    if (info.instance_state != DDS_IST_ALIVE || !info.valid_data) {
      discovered_.erase(info.instance_handle);
      return;
    }
    auto& writer = discovered_[info.instance_handle];
    writer = {id_of(info.instance_handle), endpoint.topic_name, endpoint.type_name, {}};
    void* data = nullptr;
    std::size_t size = 0;
    if (dds_qget_userdata(endpoint.qos, &data, &size) && size > 0)
      writer.user_data.assign(static_cast<const char*>(data), size);
    dds_free(data);
  }

  NetworkSettings network_;
  dds_entity_t participant_;
  dds_entity_t publications_ = -1;  // made when somebody wants to know
  std::map<dds_instance_handle_t, DiscoveredWriter> discovered_;
};

}  // namespace

std::unique_ptr<Backend> make_cyclonedds(const NetworkSettings& network) {
  return std::make_unique<CycloneBackend>(network);
}

}  // namespace trunnion::bus
