// SPDX-License-Identifier: Apache-2.0
// The programs of the running PLC over HTTP: variables, forces, trace, sources, and new programs.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "answer.hpp"
#include "cluster_side/mailbox.hpp"
#include "core/plc_requests.hpp"
#include "core/router.hpp"
#include "core/worker.hpp"
#include "plc/online/shown_variables.hpp"

namespace trunnion::gateway {

class PlcOnline {
 public:
  /// Answers are made on the thread of `requests`.
  PlcOnline(Mailbox& mailbox, Worker& requests);
  /// Answers later. Refusals are problem details (RFC 9457). Every operation of the programs but the watch.
  void handle(const Match& match, const RequestText& request, const Respond& respond);

 private:
  using Request = idl::plc::OnlineRequest;
  using Reply = idl::plc::OnlineReply;
  using Variables = std::vector<idl::plc::VariableInfo>;
  using Done = std::function<void(const Request&, const Reply&)>;
  template <class Found>
  using Then = std::function<void(std::shared_ptr<const Found>)>;

  /// `done` is called with an accepted reply, on the thread of the requests; anything else is answered.
  void send(Request request, const Respond& respond, Done done);
  /// Accepted or refused.
  void order(Request request, const Respond& respond);
  /// One after the other; the first that is refused ends them.
  void send_all(std::shared_ptr<const std::vector<Request>> requests, std::size_t next,
                const Respond& respond);

  void with_variables(const Respond& respond, Then<Variables> then);
  void read_variables(std::shared_ptr<Variables> found, std::uint64_t programs, const Respond& respond,
                      Then<Variables> then);
  void with_sources(idl::plc::ProgramSet set, const Respond& respond,
                    const Then<std::vector<PlcSource>>& then);
  void read_sources(idl::plc::ProgramSet set, std::shared_ptr<std::vector<PlcSource>> found,
                    std::uint32_t offset, const Respond& respond, Then<std::vector<PlcSource>> then);

  void answer_variables(const std::string& query, const Respond& respond);
  void answer_tasks(const Respond& respond);
  void answer_uses(const std::string& query, const Respond& respond);
  void answer_programs(const Respond& respond);
  void answer_source(const std::string& name, const std::string& query, const Respond& respond);
  void start_trace(const bus::Json& body, const Respond& respond);
  void read_trace(const std::string& query, const Respond& respond);
  void answer_load(std::shared_ptr<std::vector<std::string>> messages, const Respond& respond);
  /// Which programs run: a number that changes with them, 0 = not known.
  std::uint64_t running() const;
  /// Numbered as a request of the one who traces.
  Request of_trace(Request request);

  Mailbox& mailbox_;
  Worker& requests_;
  const std::uint64_t tracer_;
  std::mutex mutex_;
  std::shared_ptr<const Variables> variables_;
  std::uint64_t variables_of_ = 0;  ///< running() when they were read
  std::uint64_t trace_number_ = 0;
  std::shared_ptr<const plc_online::ShownVariables> traced_;
};

}  // namespace trunnion::gateway
