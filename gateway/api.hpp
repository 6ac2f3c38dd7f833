// SPDX-License-Identifier: Apache-2.0
// The operations behind the routes, without any HTTP library.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "bus/json.hpp"
#include "mailbox.hpp"
#include "src/router.hpp"

namespace trunnion::gateway {

/// Largest body of a program upload and of everything else, in bytes.
inline constexpr std::uint64_t largest_program = 128u << 20, largest_body = 1u << 20;
/// Bytes of a program in one request of the bus.
inline constexpr std::size_t chunk_bytes = 60000;

struct Answer {
  unsigned status = 200;
  std::string body;
  std::string type = "application/json";
  std::string cache = "no-store";
  Asked asked = {};  ///< for the journal
};

/// Called once, on either thread.
using Respond = std::function<void(Answer)>;

Answer json_answer(unsigned status, const bus::Json& body);
/// {"error": text, "field": field}; the field only when there is one.
Answer error_answer(unsigned status, const std::string& text, const std::string& field = {});
/// As error_answer, for a path that does not match: 404, or 405 when another method would.
Answer unrouted(RouteResult result);

class Api {
 public:
  Api(Mailbox& mailbox, std::string contract, std::filesystem::path web)
      : mailbox_(mailbox), contract_(std::move(contract)), web_(std::move(web)) {}

  /// Everything but the stream and the reading and writing of programs.
  void handle(const Match& match, const std::string& query, const std::string& body, const Respond& respond);
  /// A file of the page.
  Answer page(std::string_view path) const;
  Mailbox& mailbox() { return mailbox_; }

 private:
  Answer read(const Match& match, const std::string& query) const;
  void send_channel(const Match& match, const bus::Json& body, const Respond& respond);
  void send_panel(std::string_view route, const bus::Json& body, const Respond& respond);
  void send_parameters(const Match& match, const bus::Json& body, const Respond& respond);
  void remove_program(const std::string& name, const Respond& respond);

  Mailbox& mailbox_;
  std::string contract_;
  std::filesystem::path web_;
};

using ProgramReply = std::optional<idl::program::ProgramReply>;
using ProgramDone = std::function<void(const ProgramReply&)>;

/// The answer when a request to the program service was not accepted.
Answer program_refusal(const ProgramReply& reply);

/// One upload: begin, write as often as needed, commit; abort when it cannot be finished. One call at a time.
class ProgramUpload {
 public:
  ProgramUpload(Mailbox& mailbox, std::string name) : mailbox_(mailbox), name_(std::move(name)) {}
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
