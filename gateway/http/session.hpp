// SPDX-License-Identifier: Apache-2.0
// One HTTP connection: reads a request, has it answered, and so on until either side closes.
#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/optional.hpp>
#include <chrono>
#include <memory>

#include "api.hpp"
#include "core/connections.hpp"
#include "core/precondition.hpp"
#include "core/site.hpp"
#include "http/stream.hpp"
#include "http/transport.hpp"

namespace trunnion::gateway {

class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(Transport&& transport, Api& api, StreamHub& hub, const Site& site);
  void start();
  Connection connection() const;
  /// Another connection takes its place.
  void close();

 private:
  template <class Body>
  using Parser = boost::beast::http::request_parser<Body>;
  using Completion = void (HttpSession::*)(const ProgramReply&);

  /// Completes the line and hands it to the bus; `then` is called here afterwards.
  void journal(unsigned status, const Asked& asked, std::function<void()> then);
  /// The other side is gone, or what was sent to it is not whole.
  void journal_unanswered(const Asked& asked) {
    journal(0, asked, [] {});
  }
  void read_header();
  /// The next request of a connection that stays.
  void read_next();
  void on_header();
  /// Says that this gateway is reached by TLS, to a client that has come without.
  void refuse_clear_text();
  void continue_then(void (HttpSession::*next)());
  void read_body();
  void dispatch();
  /// An order to the programs of the PLC, in the journal of the users.
  void note_plc(unsigned status);
  /// Writes the line of the journal first when the request has one.
  void answer(Answer answer);
  void send(Answer answer);
  /// On the thread of the requests; sends it then.
  void compress(Answer answer);
  void write(Answer answer);
  /// Answers a request whose body has not been read; the connection ends with it.
  void answer_and_close(Answer answer);
  void too_large_body();
  /// Continues with answer() here, on the thread of the connection.
  Respond answer_here();
  /// A callback for the bus thread that continues here, on the thread of the connection.
  ProgramDone here(Completion next);

  void begin_upload();
  /// Empty, or why the upload's condition does not hold.
  std::string changed_program() const;
  void upload_begun(const ProgramReply& reply);
  void read_part();
  void part_stored(const ProgramReply& reply);
  void upload_stored(const ProgramReply& reply);
  void upload_refused(const ProgramReply& reply);
  /// Returns what was asked of the store until then.
  Asked abort_upload();

  void begin_download();
  void download_part(const ProgramReply& reply);
  void send_part();
  void download_broken();

  void send_source(Answer answer);
  void next_of_source();
  void send_of_source(std::optional<std::string> part);

  Transport stream_;
  boost::beast::flat_buffer buffer_;
  Api& api_;
  StreamHub& hub_;
  const Site& site_;
  Connection connection_;

  boost::optional<Parser<boost::beast::http::empty_body>> header_;
  boost::optional<Parser<boost::beast::http::string_body>> body_;
  boost::optional<Parser<boost::beast::http::buffer_body>> parts_;
  boost::beast::http::response<boost::beast::http::string_body> response_;
  Match match_;
  std::string query_;
  std::optional<access::Identity> user_;  ///< of the request under way
  std::shared_ptr<OrderUnderWay> order_;  ///< the request under way, when it is one that needs the right
  bool keep_alive_ = false;
  std::chrono::steady_clock::time_point waits_since_{};
  bool complete_ = false;              ///< the request that is being read has arrived whole
  bool gzip_ = false;                  ///< the client permits it
  std::unique_ptr<JournalLine> line_;  ///< of the request under way, when it is one for the journal

  std::unique_ptr<ProgramUpload> upload_;
  Precondition condition_;  ///< of the upload
  std::vector<std::uint8_t> part_;

  struct Download {
    explicit Download(ProgramDownload from) : source(std::move(from)) {}
    ProgramDownload source;
    std::uint64_t revision = 0, size = 0, offset = 0;
    boost::beast::http::response<boost::beast::http::buffer_body> response;
    boost::optional<boost::beast::http::response_serializer<boost::beast::http::buffer_body>> serializer;
    std::vector<std::uint8_t> part;
  };
  std::unique_ptr<Download> download_;

  /// An answer whose body is made while it is sent.
  struct Sending {
    std::shared_ptr<BodySource> source;
    boost::beast::http::response<boost::beast::http::buffer_body> response;
    boost::optional<boost::beast::http::response_serializer<boost::beast::http::buffer_body>> serializer;
    std::string part;
  };
  std::unique_ptr<Sending> sending_;
};

}  // namespace trunnion::gateway
