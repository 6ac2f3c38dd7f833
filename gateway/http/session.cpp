// SPDX-License-Identifier: Apache-2.0
#include "http/session.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>

#include "core/compression.hpp"
#include "core/requests.hpp"
#include "core/rights.hpp"
#include "core/site.hpp"
#include "http/session_parts.hpp"
#include "http/watch.hpp"

namespace trunnion::gateway {

namespace beast = boost::beast;
namespace http = beast::http;
namespace net = boost::asio;
using std::chrono::seconds;

namespace {

constexpr seconds first_request{5};  // who connects has something to say
// What has come on a new connection may have been taken from it and wait for its turn.
constexpr std::chrono::milliseconds turn{5};

/// Of a request of any body.
template <class Request>
idl::gateway::Sender sender(const Request& request, bool secure) {
  const auto origin = view(request[http::field::origin]);
  using idl::gateway::Sender;
  if (origin.empty()) return Sender::TOOL;
  return foreign_origin(origin, view(request[http::field::host]), secure) ? Sender::FOREIGN_PAGE
                                                                          : Sender::PAGE;
}

}  // namespace

HttpSession::HttpSession(Transport&& transport, Api& api, StreamHub& hub, const Site& site)
    : stream_(std::move(transport)), api_(api), hub_(hub), site_(site) {
  connection_.peer = stream_.peer();
}

void HttpSession::start() {
  stream_.expires_after(first_request);
  stream_.begin([self = shared_from_this()](beast::error_code error, std::optional<char> first) {
    if (error) return;
    if (first) {
      *static_cast<char*>(self->buffer_.prepare(1).data()) = *first;
      self->buffer_.commit(1);
    }
    self->read_header();
  });
}

void HttpSession::read_next() {
  stream_.expires_after(timeout);
  read_header();
}

void HttpSession::close() { stream_.close(); }

Connection HttpSession::connection() const {
  auto now = connection_;
  now.arriving =
      now.activity == Activity::waiting &&
      (complete_ || stream_.has_unread() || std::chrono::steady_clock::now() - waits_since_ < turn);
  return now;
}

void HttpSession::read_header() {
  connection_.activity = Activity::waiting;
  complete_ = false;
  waits_since_ = std::chrono::steady_clock::now();
  header_.emplace();
  header_->header_limit(16 << 10);
  header_->body_limit(largest_program);
  http::async_read_header(
      stream_, buffer_, *header_,
      Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
        if (error == http::error::body_limit)
          return self->answer_and_close(error_answer(413, "the body is larger than 128 MiB"));
        if (error == http::error::header_limit)
          return self->answer_and_close(error_answer(431, "the header is too large"));
        if (error.category() == http::make_error_code(http::error::bad_method).category() &&
            error != http::error::end_of_stream && error != http::error::partial_message)
          return self->answer_and_close(error_answer(400, "this is not HTTP: " + error.message()));
        if (error) return;
        self->on_header();
      }));
}

void HttpSession::on_header() {
  const auto& request = header_->get();
  keep_alive_ = request.keep_alive();
  gzip_ = accepts_gzip(view(request[http::field::accept_encoding]));
  const std::string target(request.target());
  const auto mark = target.find('?');
  const auto path = target.substr(0, mark);
  query_ = mark == std::string::npos ? "" : target.substr(mark + 1);
  line_.reset();
  const bool is_api = path.starts_with("/api/");
  match_ = is_api ? match(view(request.method_string()), path) : Match{};
  if (match_.result == RouteResult::found && is_journaled(match_.operation)) {
    line_ = std::make_unique<JournalLine>(begin_line(sender(request, stream_.secure()), connection_.peer,
                                                     view(request.method_string()), target));
  }
  if (request.count(http::field::host) > 1)
    return answer_and_close(error_answer(400, "the request has more than one header Host"));
  if (!site_.is_named(view(request[http::field::host])))
    return answer_and_close(
        error_answer(421, "this machine is not called '" + std::string(view(request[http::field::host])) +
                              "': use its address, or enter the name in host_names of machine.yaml"));
  if (stream_.wants_tls() && !stream_.secure()) return refuse_clear_text();
  if (sender(request, stream_.secure()) == idl::gateway::Sender::FOREIGN_PAGE)
    return answer_and_close(error_answer(403, "a page of another site must not operate this machine"));
  if (!is_api) {
    if (request.method() != http::verb::get) return answer_and_close(unrouted(RouteResult::no_method));
    connection_.activity = Activity::transferring;
    return api_.page(path, gzip_, answer_here());
  }
  if (match_.result != RouteResult::found) return answer_and_close(unrouted(match_.result));
  user_ =
      api_.access().identify(view(request[http::field::cookie]), view(request[http::field::authorization]),
                             prolongs_session(match_.operation));
  if (line_ && user_) set_user(*line_, *user_);
  if (auto refusal = api_.access().refusal(user_, match_)) return answer_and_close(std::move(*refusal));
  if (match_.operation == Operation::write_program) {
    connection_.activity = Activity::transferring;
    return continue_then(&HttpSession::begin_upload);
  }
  const auto length = header_->content_length();
  if (length && *length > largest_body(match_.operation)) return too_large_body();
  complete_ = length.value_or(0) <= buffer_.size();
  continue_then(&HttpSession::read_body);
}

void HttpSession::refuse_clear_text() {
  line_.reset();  // refused before anybody was asked
  const auto& request = header_->get();
  const auto host = std::string(view(request[http::field::host]));
  auto made = error_answer(host.empty() ? 426 : 308, "this gateway is reached by https:// only");
  if (!host.empty())
    made.headers.emplace_back("Location", "https://" + host + std::string(view(request.target())));
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    made.status = 426;
    made.headers.clear();
  }
  answer_and_close(std::move(made));
}

void HttpSession::continue_then(void (HttpSession::*next)()) {
  if (!beast::iequals(header_->get()[http::field::expect], "100-continue")) return (this->*next)();
  static const std::string go_on = "HTTP/1.1 100 Continue\r\n\r\n";
  net::async_write(stream_, net::buffer(go_on),
                   Transferred([self = shared_from_this(), next](beast::error_code error, std::size_t) {
                     if (!error) (self.get()->*next)();
                   }));
}

void HttpSession::read_body() {
  body_.emplace(std::move(*header_));
  body_->body_limit(largest_body(match_.operation));
  http::async_read(stream_, buffer_, *body_,
                   Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
                     if (error == http::error::body_limit) return self->too_large_body();
                     if (!error) self->dispatch();
                   }));
}

void HttpSession::dispatch() {
  if (match_.operation == Operation::stream || match_.operation == Operation::plc_watch) {
    if (!beast::websocket::is_upgrade(body_->get()))
      return answer(error_answer(426, "this path is for WebSocket only"));
    const auto& headers = body_->get();
    complete_ = true;  // the stream takes the transport, which connection() must not ask any more
    Visitor visitor{sender(headers, stream_.secure()), connection_.peer,
                    std::string(view(headers[http::field::cookie])),
                    std::string(view(headers[http::field::authorization]))};
    if (match_.operation == Operation::plc_watch)
      std::make_shared<WatchSession>(std::move(stream_), hub_, api_, std::move(visitor))->accept(headers);
    else
      std::make_shared<StreamSession>(std::move(stream_), hub_, api_, std::move(visitor))->accept(headers);
    return;
  }
  if (line_) add_body(*line_, body_->get().body());
  const auto& request = body_->get();
  connection_.activity = request.method() == http::verb::get ? Activity::transferring : Activity::answering;
  if (match_.operation == Operation::read_program) return begin_download();
  // Now that all of it is here: an order that never ends must not hold the right.
  const auto station =
      api_.operating().station_of(view(request[http::field::cookie]), connection_.peer, user_);
  if (auto refusal = api_.operating().refusal(station, match_, order_)) return answer(std::move(*refusal));
  const auto header = [&](http::field name) { return std::string(view(request[name])); };
  const RequestText text{query_,
                         request.body(),
                         header(http::field::range),
                         header(http::field::if_range),
                         header(http::field::if_match),
                         header(http::field::cookie),
                         connection_.peer,
                         user_};
  api_.handle(match_, text, answer_here());
}

Respond HttpSession::answer_here() {
  return [self = shared_from_this()](Answer made) {
    net::post(self->stream_.get_executor(),
              [self, made = std::move(made)]() mutable { self->answer(std::move(made)); });
  };
}

void HttpSession::journal(unsigned status, const Asked& asked, std::function<void()> then) {
  line_->status = static_cast<std::uint16_t>(status);
  set_asked(*line_, asked);
  if (user_)
    api_.access().note(user_->name, line_->method + " " + line_->target + ": " + std::to_string(status));
  // The callback of a request must be copyable, a line is not shared.
  const std::shared_ptr<JournalLine> line = std::move(line_);
  api_.mailbox().post([self = shared_from_this(), line, then = std::move(then)](Links& links, double) {
    links.journal.write(*line);
    net::post(self->stream_.get_executor(), then);
  });
}

void HttpSession::note_plc(unsigned status) {
  constexpr std::size_t noted = 300;  // bytes of the body: which values
  const auto& request = body_->get();
  auto text = std::string(view(request.method_string())) + " " + std::string(view(request.target()));
  text.append(" ").append(request.body(), 0, noted).append(": ").append(std::to_string(status));
  api_.access().note(user_->name, text);
}

void HttpSession::answer(Answer made) {
  api_.operating().answered(std::exchange(order_, nullptr), made.status);
  if (!line_) {
    if (user_ && is_of_plc_programs(match_.operation) && body_ && body_->get().method() != http::verb::get)
      note_plc(made.status);
    return send(std::move(made));
  }
  add_answer(*line_, made.body);
  const auto status = made.status;
  const auto asked = made.asked;
  journal(status, asked,
          [self = shared_from_this(), made = std::move(made)]() mutable { self->send(std::move(made)); });
}

void HttpSession::send(Answer made) {
  connection_.activity = Activity::transferring;
  if (made.source) return send_source(std::move(made));
  if (gzip_ && made.encoding.empty() && made.body.size() >= least_compressed && is_compressible(made.type))
    return compress(std::move(made));
  write(std::move(made));
}

void HttpSession::compress(Answer made) {
  api_.requests().post([self = shared_from_this(), made = std::move(made)]() mutable {
    made.body = gzip(made.body, 1);  // the fastest: others wait meanwhile
    made.encoding = "gzip";
    net::post(self->stream_.get_executor(),
              [self, made = std::move(made)]() mutable { self->write(std::move(made)); });
  });
}

void HttpSession::write(Answer made) {
  response_ = {static_cast<http::status>(made.status), http_version};
  set_fields(response_, made);
  if (const auto shown = api_.mailbox().newest())
    response_.set("X-State-Sequence", std::to_string(shown->replies));
  response_.keep_alive(keep_alive_);
  response_.body() = std::move(made.body);
  response_.prepare_payload();
  stream_.expires_after(timeout);
  http::async_write(stream_, response_,
                    Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
                      if (error) return;
                      if (self->keep_alive_) return self->read_next();
                      self->stream_.finish();
                    }));
}

void HttpSession::answer_and_close(Answer made) {
  keep_alive_ = false;
  answer(std::move(made));
}

void HttpSession::too_large_body() {
  // Not read, so nothing can come of it.
  line_.reset();
  answer_and_close(error_answer(
      413, "the body is larger than " + std::to_string(largest_body(match_.operation) / 1024) + " KiB"));
}

ProgramDone HttpSession::here(Completion next) {
  return [self = shared_from_this(), next](const ProgramReply& reply) {
    net::post(self->stream_.get_executor(), [self, next, reply] { (self.get()->*next)(reply); });
  };
}

// --- Upload: one part of the body is read, stored, and only then the next one is read.

void HttpSession::begin_upload() {
  try {
    commands::check_program_name(match_.parts.at(0));
  } catch (const BadRequest& bad) {
    return answer_and_close(error_answer(400, bad.what(), bad.field));
  }
  condition_ = {std::string(view(header_->get()[http::field::if_match])),
                std::string(view(header_->get()[http::field::if_none_match]))};
  if (const auto changed = changed_program(); !changed.empty())
    return answer_and_close(error_answer(412, changed));
  parts_.emplace(std::move(*header_));
  parts_->body_limit(largest_program);
  upload_ = std::make_unique<ProgramUpload>(api_.mailbox(), match_.parts[0], role_of(user_));
  upload_->begin(here(&HttpSession::upload_begun));
}

std::string HttpSession::changed_program() const {
  const auto cluster = api_.mailbox().newest();
  return condition_.failed(cluster ? cluster->programs.get() : nullptr, match_.parts[0],
                           api_.stored_lately(match_.parts[0]));
}

void HttpSession::upload_begun(const ProgramReply& reply) {
  if (reply && reply->accepted) return read_part();
  auto made = program_refusal(reply);
  made.asked = upload_->asked();
  answer_and_close(std::move(made));
}

void HttpSession::read_part() {
  if (parts_->is_done()) {
    const auto changed = changed_program();
    if (changed.empty()) return upload_->commit(here(&HttpSession::upload_stored));
    auto made = error_answer(412, changed);
    made.asked = abort_upload();
    return answer_and_close(std::move(made));
  }
  part_.resize(chunk_bytes);
  parts_->get().body().data = part_.data();
  parts_->get().body().size = part_.size();
  parts_->get().body().more = true;
  stream_.expires_after(timeout);
  http::async_read(
      stream_, buffer_, *parts_,
      Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
        if (error == http::error::need_buffer) error = {};
        if (error) {
          const auto asked = self->abort_upload();
          if (error != http::error::body_limit) return self->journal_unanswered(asked);
          auto made = error_answer(413, "a program must not be larger than 128 MiB");
          made.asked = asked;
          return self->answer_and_close(std::move(made));
        }
        self->part_.resize(chunk_bytes - self->parts_->get().body().size);
        if (self->part_.empty()) return self->read_part();
        add_body(*self->line_, {reinterpret_cast<const char*>(self->part_.data()), self->part_.size()});
        self->upload_->write(std::move(self->part_), self->here(&HttpSession::part_stored));
      }));
}

void HttpSession::part_stored(const ProgramReply& reply) {
  if (reply && reply->accepted) return read_part();
  upload_refused(reply);
}

void HttpSession::upload_stored(const ProgramReply& reply) {
  if (!reply || !reply->accepted) return upload_refused(reply);
  api_.note_stored(reply->entry);
  auto made = json_answer(200, {{"accepted", true}, {"program", bus::to_json(reply->entry)}});
  made.asked = upload_->asked();
  answer(std::move(made));
}

void HttpSession::upload_refused(const ProgramReply& reply) {
  auto made = program_refusal(reply);
  made.asked = abort_upload();
  answer_and_close(std::move(made));
}

Asked HttpSession::abort_upload() {
  upload_->abort();
  const auto asked = upload_->asked();
  upload_.reset();
  return asked;
}

}  // namespace trunnion::gateway
