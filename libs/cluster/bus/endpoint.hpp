// SPDX-License-Identifier: Apache-2.0
// The small interface behind which a DDS vendor hides. It moves CDR bytes and knows no types.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bus/codec.hpp"
#include "bus/topic.hpp"
#include "bus/writer_origin.hpp"

namespace trunnion::bus {

/// Wakes the one thread of a service. Listeners only ever call notify(), which takes no lock: writing or
/// locking there deadlocks both vendors.
class Signal {
 public:
  Signal() = default;
  virtual ~Signal() = default;
  Signal(const Signal&) = delete;
  Signal& operator=(const Signal&) = delete;
  /// From any thread, as often as wanted.
  virtual void notify();
  /// True when notified since the last wait, false after `seconds`. For one thread only.
  bool wait(double seconds);

 private:
  enum State : std::uint32_t { idle, waiting, notified };
  std::atomic<std::uint32_t> state_{idle};
};

/// For readers in no hurry, nobody waits for it. A packet that woke the vendor's receiving thread makes that
/// thread sleep for 2 ms, so that the packets which follow gather in the socket's buffer and are taken in
/// together, as the interrupt coalescing of a network card does. Otherwise every packet costs its *sender* a
/// wake-up, which is more than the sending itself.
class Gathering : public Signal {
 public:
  void notify() override;
};

/// What a back end must know of a topic. key_of gives the RTPS key hash (9.6.3.8) of a CDR sample: the key in
/// big-endian CDR.
struct TopicDescription {
  std::string name;
  std::string wire_type;
  bool keyed = false;
  bool (*key_of)(std::span<const std::uint8_t> cdr, KeyHash& key) = nullptr;
};

struct EndpointQos {
  bool transient_local = false;
  int depth = 1;               ///< KEEP_LAST; 0 = KEEP_ALL (readers only)
  std::string user_data = {};  ///< what a writer tells those who discover it
};

/// Tells the writers of a domain apart; it means something to the participant alone that gives it.
using WriterId = std::array<std::uint8_t, 16>;

/// A writer in the domain, this process's own or another's.
struct DiscoveredWriter {
  WriterId id{};
  std::string topic, wire_type;
  std::string user_data;
};

struct SampleInfo {
  std::int64_t source_timestamp =
      0;  ///< ns since the epoch, the writer's clock: for statistics, never for order
  WriterId writer{};
};

/// The source time stamp of a message written now, ns. Readers of either vendor find the same number. It is
/// the monotonic clock plus what the wall clock was ahead of it when the cluster was started
/// (NetworkSettings::clock_offset), so that it rises even when the wall clock is put back.
std::int64_t source_time();
/// For processes that need source_time() before they have a bus: NetworkSettings::clock_offset.
void use_clock_offset(std::int64_t offset);
/// By how much the wall clock is ahead of the monotonic clock now, ns.
std::int64_t wall_clock_offset();

class RawWriter {
 public:
  virtual ~RawWriter() = default;
  /// `time` is a source_time().
  virtual bool write(std::span<const std::uint8_t> cdr, std::int64_t time) = 0;
  bool write(std::span<const std::uint8_t> cdr) { return write(cdr, source_time()); }
  virtual int matched() = 0;
};

class RawReader {
 public:
  virtual ~RawReader() = default;
  /// The next sample in `cdr`, or false.
  virtual bool take(Bytes& cdr, SampleInfo& info) = 0;
  virtual int matched() = 0;
};

enum class Vendor { fastdds, cyclonedds };
const char* to_string(Vendor vendor);
/// Throws std::invalid_argument naming the two that exist.
Vendor vendor_from(const std::string& name);

/// Where the participants of a cluster are.
struct NetworkSettings {
  std::uint32_t domain = 0;  ///< 0..100
  std::string interface_address = "127.0.0.1";
  std::string peers = "127.0.0.1";  ///< comma-separated addresses
  bool multicast = false;           ///< find the others by multicast and not by `peers`; data stay unicast
  std::string security =
      {};  ///< directory of the cluster's certificates (docs/security.md); empty: no security
  std::string identity =
      {};  ///< the service, "deploy" or "recorder": others see it in the participant's user
           ///< data, and it names the certificate and the permissions below `security`
  std::int64_t clock_offset =
      0;  ///< ns, of source_time(); the same in all processes of a host; 0: wall clock
};

class Backend {
 public:
  virtual ~Backend() = default;
  virtual std::unique_ptr<RawWriter> writer(const TopicDescription& topic, const EndpointQos& qos) = 0;
  /// `signal` may be null; it is notified whenever data arrives.
  virtual std::unique_ptr<RawReader> reader(const TopicDescription& topic, const EndpointQos& qos,
                                            Signal* signal) = 0;
  /// False when nothing has changed since the last call. Otherwise `writers` are all that are known now.
  virtual bool discover(std::vector<DiscoveredWriter>& writers) = 0;
  /// Where the writer of a sample is (SampleInfo::writer): what its process has told of itself.
  virtual WriterOrigin origin_of(const WriterId& writer) = 0;
  /// Takes in what was heard of others since the last call, for who calls neither of the two for a long time:
  /// every process that comes or goes would be kept as messages. For the thread that calls them.
  virtual void keep_up() {}
};

/// Throws std::runtime_error with the vendor's reason.
std::unique_ptr<Backend> make_cyclonedds(const NetworkSettings& network);
std::unique_ptr<Backend> make_fastdds(const NetworkSettings& network);

}  // namespace trunnion::bus
