// SPDX-License-Identifier: Apache-2.0
#include "http/watch.hpp"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/buffers_to_string.hpp>

#include "core/plc_requests.hpp"
#include "http/stream.hpp"
#include "service/request.hpp"

namespace trunnion::gateway {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using bus::Json;
using idl::plc::OnlineAction;

namespace {

constexpr std::size_t longest_message = 128 << 10, most_waiting = 8;

Json problem(const Answer& answer) { return {{"problem", Json::parse(answer.body, nullptr, false)}}; }

}  // namespace

WatchSession::WatchSession(Transport&& stream, StreamHub& hub, Api& api, Visitor visitor)
    : Viewer(std::move(visitor)),
      socket_(std::move(stream)),
      hub_(hub),
      api_(api),
      client_(service::make_client_id()) {}

void WatchSession::accept(const beast::http::request<beast::http::string_body>& request) {
  socket_.next_layer().expires_never();
  auto limits = websocket::stream_base::timeout::suggested(beast::role_type::server);
  limits.idle_timeout = std::chrono::seconds(20);
  limits.keep_alive_pings = true;
  socket_.set_option(limits);
  socket_.read_message_max(longest_message);
  socket_.async_accept(request, Done([self = shared_from_this()](beast::error_code error) {
                         if (error) return;
                         self->open_ = true;
                         self->hub_.join(self);
                         self->read();
                       }));
}

void WatchSession::read() {
  socket_.async_read(incoming_,
                     Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (error) return self->close();
                       self->take(beast::buffers_to_string(self->incoming_.data()));
                       self->incoming_.clear();
                       self->read();
                     }));
}

void WatchSession::take(const std::string& text) {
  try {
    watched_ = watch_request(parse_body(text));
    named_ = number_ + 1, slot_.reset();
    ask(*watched_);
  } catch (const BadRequest& bad) {
    send(problem(problem_answer(400, bad.what(), bad.field)));
  }
}

void WatchSession::ask(Request request) {
  request.client = client_;
  request.number = ++number_;
  api_.mailbox().post([self = shared_from_this(), request](Links& links, double now) {
    links.online.submit(
        request,
        [self](const Request& asked, const std::optional<Reply>& reply) {
          boost::asio::post(self->socket_.get_executor(),
                            [self, asked, reply] { self->answered(asked, reply); });
        },
        now);
  });
}

void WatchSession::answered(const Request& asked, const std::optional<Reply>& reply) {
  if (!open_ || asked.action != OnlineAction::WATCH || !watched_ || asked.paths != watched_->paths) return;
  if (!reply) return;  // a PLC that is being replaced: asked again within a second
  if (!reply->accepted) {
    watched_.reset(), slot_.reset();
    return send(problem(problem_answer(409, reply->reason)));
  }
  plc_online::ShownVariables shown(reply->variables);
  slot_ = reply->slot;
  const auto json = shown.json();
  const bool same = described_ && json == shown_.json();
  shown_ = std::move(shown);
  if (!same) {
    described_ = true, sent_.reset();
    send({{"variables", json}});
  }
  if (const auto& newest = hub_.newest()) offer(newest);
}

void WatchSession::offer(const std::shared_ptr<const ClusterState>& newest) {
  if (!slot_ || outgoing_.size() > 1) return;
  const auto found = newest->plc_watched.find(*slot_);
  if (found == newest->plc_watched.end() || found->second->client != client_) return;
  const auto& sample = found->second;
  // The values of another list may be as many.
  if (sample->number < named_ || sample->cells.size() != shown_.cells()) return;
  if (sent_ && sent_->cells == sample->cells && sent_->forced == sample->forced) return;
  sent_ = sample;
  send({{"scan", sample->scan},
        {"tick", sample->tick},
        {"values", shown_.texts(sample->cells)},
        {"forced", sample->forced}});
}

void WatchSession::each_second() {
  if (api_.access().on() && !api_.access().identify(visitor_.cookies, visitor_.authorization, false))
    return close();
  if (watched_) ask(*watched_);
}

void WatchSession::send(const Json& message) {
  if (outgoing_.size() >= most_waiting) return close();  // who asks and reads no answers
  outgoing_.push_back(bus::text_of(message));
  if (!writing_) write_next();
}

void WatchSession::write_next() {
  writing_ = true;
  socket_.text(true);
  socket_.async_write(boost::asio::buffer(outgoing_.front()),
                      Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
                        self->writing_ = false;
                        self->outgoing_.pop_front();
                        if (error) return self->close();
                        if (!self->outgoing_.empty()) self->write_next();
                      }));
}

void WatchSession::close() {
  if (!open_) return;
  open_ = false;
  if (watched_) {
    Request end{};
    end.action = OnlineAction::END_WATCH;
    watched_.reset();
    ask(end);
  }
  socket_.next_layer().close();
  hub_.leave(shared_from_this());
}

}  // namespace trunnion::gateway
