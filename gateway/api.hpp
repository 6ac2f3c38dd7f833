// SPDX-License-Identifier: Apache-2.0
// The operations behind the routes, without any HTTP library.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "answer.hpp"
#include "bus/json.hpp"
#include "cluster_side/mailbox.hpp"
#include "core/router.hpp"
#include "operators/access_control.hpp"
#include "operators/operating_control.hpp"
#include "programs/program_checker.hpp"
#include "programs/program_planner.hpp"
#include "resources/bodies.hpp"
#include "resources/measurement.hpp"
#include "resources/plc_online.hpp"
#include "resources/recordings.hpp"

namespace trunnion::gateway {

/// Largest body of a program upload and of everything else, in bytes.
inline constexpr std::uint64_t largest_program = 128u << 20;
/// Bytes of a program in one request of the bus.
inline constexpr std::size_t chunk_bytes = 60000;

/// As error_answer, for a path that does not match: 404, or 405 when another method would.
Answer unrouted(RouteResult result);

class Api {
 public:
  Api(Mailbox& mailbox, std::string contract, std::filesystem::path web, RecordingSettings recordings = {},
      AccessSettings access = {}, bool one_operates = false, MeasurementSettings measurement = {})
      : mailbox_(mailbox),
        contract_(std::move(contract)),
        web_(std::move(web)),
        checker_(mailbox, measurement.machine.directory),
        planner_(mailbox),
        recordings_(std::move(recordings)),
        access_(std::move(access), recordings_.worker()),
        operating_(one_operates, access_),
        plc_(mailbox, requests_),
        machine_directory_(measurement.machine.directory),
        measurement_(mailbox, recordings_.worker(), std::move(measurement)) {}
  ~Api() { stop(); }
  Api(const Api&) = delete;
  Api& operator=(const Api&) = delete;

  /// Everything but the stream and the reading and writing of programs. On the thread of the connections:
  /// what is_short() is begun at once, all else on the thread of the requests.
  void handle(const Match& match, const RequestText& request, const Respond& respond);
  /// A file of the page, later; as gzip when the client permits it and the build has made one.
  void page(const std::string& path, bool gzip, const Respond& respond);
  Mailbox& mailbox() { return mailbox_; }
  /// Remembers for a second what an upload has stored: the list of programs comes a moment later. On the
  /// thread of the connections only, as handle().
  void note_stored(const idl::program::ProgramEntry& entry);
  /// Its revision, 0 = none.
  std::uint64_t stored_lately(const std::string& name);
  AccessControl& access() { return access_; }
  OperatingControl& operating() { return operating_; }
  /// Where the source of an answer is read.
  Worker& files() { return recordings_.worker(); }
  /// Where bodies are read, and answers made and compressed.
  Worker& requests() { return requests_; }
  /// Ends the threads of requests, checks, plans and files; to be called while the mailbox exists.
  void stop() {
    requests_.stop();
    checker_.stop();
    planner_.stop();
    recordings_.stop();
  }

 private:
  void carry_out(const Match& match, const RequestText& request, const Respond& respond);
  Answer file_of_page(std::string_view path, bool gzip) const;
  Answer read(const Match& match, const std::string& query) const;
  void send_channel(const Match& match, const bus::Json& body, const std::optional<access::Identity>& user,
                    const Respond& respond);
  void send_panel(std::string_view route, const bus::Json& body, const Respond& respond);
  void send_parameters(const Match& match, const bus::Json& body, const RequestText& request,
                       const Respond& respond);
  /// 403 when `asked` has a parameter that the user must not change.
  std::optional<Answer> parameter_refusal(const idl::parameters::ParameterRequest& asked,
                                          const RequestText& request) const;
  /// Why the condition If-Match of a change does not hold, empty = it does or there is none. The revision of
  /// a table becomes that of the request.
  std::string changed_meanwhile(const Match& match, const std::string& if_match,
                                idl::parameters::ParameterRequest& request) const;
  void send_program(const idl::program::ProgramRequest& request, const Respond& respond);
  void remove_program(const std::string& name, const Respond& respond);
  void check(const Match& match, const std::string& query, const std::string& text, const Respond& respond);
  void plan(const Match& match, const std::string& query, const Respond& respond);

  Mailbox& mailbox_;
  std::string contract_;
  std::filesystem::path web_;
  Worker requests_{"gateway-work"};
  ProgramChecker checker_;
  ProgramPlanner planner_;
  Recordings recordings_;
  AccessControl access_;
  OperatingControl operating_;
  PlcOnline plc_;
  std::string machine_directory_;
  KinematicMeasurement measurement_;
  struct Stored {
    std::uint64_t revision = 0;
    std::chrono::steady_clock::time_point since;
  };
  std::map<std::string, Stored> stored_;  ///< of the thread of the connections
  /// The newest change of parameters, and the set that was known then. Of the thread of the requests.
  struct Sent {
    std::shared_ptr<const idl::parameters::ParameterSet> from;
    std::chrono::steady_clock::time_point since;
  };
  Sent sent_;
};

using ProgramReply = std::optional<idl::program::ProgramReply>;
using ProgramDone = std::function<void(const ProgramReply&)>;

/// The answer when a request to the program service was not accepted: 507 when there is no room.
Answer program_refusal(const ProgramReply& reply);

/// One upload: begin, write as often as needed, commit; abort when it cannot be finished. One call at a time.
class ProgramUpload {
 public:
  /// `role` of who stores it, as in ProgramRequest.
  ProgramUpload(Mailbox& mailbox, std::string name, std::uint8_t role)
      : mailbox_(mailbox), name_(std::move(name)), role_(role) {}
  void begin(ProgramDone done);
  /// At most chunk_bytes.
  void write(std::vector<std::uint8_t> data, ProgramDone done);
  void commit(ProgramDone done);
  void abort();
  /// So far.
  Asked asked() const { return {client_, 1, static_cast<std::uint32_t>(number_)}; }

 private:
  idl::program::ProgramRequest request(idl::program::Operation operation);
  void send(idl::program::ProgramRequest request, ProgramDone done);
  Mailbox& mailbox_;
  std::string name_;
  std::uint8_t role_;
  std::uint64_t client_ = service::make_client_id(), number_ = 0, size_ = 0;
  std::uint32_t crc_ = 0;
};

/// One download, part by part. One call at a time.
class ProgramDownload {
 public:
  ProgramDownload(Mailbox& mailbox, std::string name) : mailbox_(mailbox), name_(std::move(name)) {}
  /// Reads chunk_bytes at `offset`; `revision` 0 is the newest.
  void read(std::uint64_t revision, std::uint64_t offset, ProgramDone done);
  const std::string& name() const { return name_; }
  /// So far.
  Asked asked() const { return {client_, 1, static_cast<std::uint32_t>(number_)}; }

 private:
  Mailbox& mailbox_;
  std::string name_;
  std::uint64_t client_ = service::make_client_id(), number_ = 0;
};

}  // namespace trunnion::gateway
