// SPDX-License-Identifier: Apache-2.0
#include "http/stream.hpp"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/buffers_to_string.hpp>

#include "bus/json.hpp"
#include "commands/command_table.hpp"
#include "core/merge_patch.hpp"
#include "core/operator_journal.hpp"
#include "core/router.hpp"

namespace trunnion::gateway {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using std::chrono::milliseconds;

constexpr milliseconds heartbeat_period{250};
constexpr std::size_t most_answers = 16;
constexpr std::size_t most_streams = 128;

std::shared_ptr<const std::string> text(const bus::Json& json) {
  return std::make_shared<const std::string>(bus::text_of(json));
}

}  // namespace

void StreamHub::start() {
  timer_.expires_after(std::chrono::seconds(1));
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (error) return;
    const auto all = viewers_;
    for (const auto& viewer : all) viewer->each_second();
    start();
  });
}

void StreamHub::show() {
  auto cluster = mailbox_.newest();
  if (!cluster || cluster == newest_) return;
  newest_ = std::move(cluster);
  cache_.clear();
  const auto all = viewers_;
  for (const auto& viewer : all) viewer->offer(newest_);
}

void StreamHub::join(const std::shared_ptr<Viewer>& viewer) {
  show();  // a new client begins with what is known now
  if (viewers_.size() >= most_streams)
    if (const auto chosen = one_to_close(connections())) close(*chosen);
  viewers_.push_back(viewer);
  count_ = viewers_.size();
}

std::vector<Connection> StreamHub::connections() const {
  std::vector<Connection> all;
  for (const auto& viewer : viewers_) all.push_back({viewer->peer(), Activity::streaming});
  return all;
}

void StreamHub::close(std::size_t index) {
  const auto chosen = viewers_.at(index);
  chosen->close();
}

void StreamHub::leave(const std::shared_ptr<Viewer>& viewer) {
  std::erase(viewers_, viewer);
  count_ = viewers_.size();
}

std::shared_ptr<const std::string> StreamHub::message(const std::shared_ptr<const ClusterState>& from,
                                                      bool heartbeat) {
  const std::uint64_t since = from ? from->sequence : 0;
  auto& cached = cache_[since];
  if (!cached) {
    if (from) {
      bus::Json json = {{"sequence", newest_->sequence},
                        {"since", since},
                        {"changes", merge_patch(from->document, newest_->document)}};
      // An empty text marks that there is no news, so that it is worked out once for all clients.
      cached = json["changes"].empty() ? std::make_shared<const std::string>() : text(json);
    } else {
      cached = text({{"sequence", newest_->sequence}, {"state", newest_->document}});
    }
  }
  // Who waits until an answer shows hears of it at once, also when it has changed nothing.
  if (cached->empty() && (heartbeat || since < newest_->replies))
    return text({{"sequence", newest_->sequence}, {"since", since}, {"changes", bus::Json::object()}});
  return cached;
}

void StreamSession::accept(const beast::http::request<beast::http::string_body>& request) {
  socket_.next_layer().expires_never();
  // The kernel must not queue what we do not: by default it would hold megabytes of old states.
  socket_.next_layer().limit_send_buffer(32 << 10);
  auto limits = websocket::stream_base::timeout::suggested(beast::role_type::server);
  limits.idle_timeout = std::chrono::seconds(20);
  limits.keep_alive_pings = true;
  socket_.set_option(limits);
  socket_.read_message_max(4096);
  socket_.async_accept(request, Done([self = shared_from_this()](beast::error_code error) {
                         if (error) return;
                         self->hub_.join(self);
                         self->read();
                         self->offer();
                       }));
}

void StreamSession::read() {
  // Reading also answers a client's pings and notices that it goes.
  socket_.async_read(incoming_,
                     Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (error) return self->close();
                       self->take_order(beast::buffers_to_string(self->incoming_.data()));
                       self->incoming_.clear();
                       self->read();
                     }));
}

void StreamSession::each_second() {
  const auto user = api_.access().identify(visitor_.cookies, visitor_.authorization, false);
  if (api_.access().on() && !user) return close();
  api_.operating().present(api_.operating().station_of(visitor_.cookies, visitor_.peer, user));
}

void StreamSession::take_order(const std::string& text) {
  const auto order = bus::Json::parse(text, nullptr, false);
  if (!order.is_object() || !order.contains("order")) return;
  const auto member = [&](const char* name, const bus::Json& otherwise) {
    return order.contains(name) ? order[name] : otherwise;
  };
  const auto path = member("path", "");
  const auto target = path.is_string() ? path.get<std::string>() : "";
  const auto found = match("POST", target);
  if (found.result != RouteResult::found || !commands::is_by_stream(found.command))
    return answer_order(order,
                        error_answer(404, "only " + commands::routes_by_stream() + " come by the stream"));
  const auto user = api_.access().identify(visitor_.cookies, visitor_.authorization, false);
  const auto station = api_.operating().station_of(visitor_.cookies, visitor_.peer, user);
  std::shared_ptr<OrderUnderWay> under_way;
  if (const auto refusal = api_.operating().refusal(station, found, under_way))
    return answer_order(order, *refusal);
  const auto body = member("body", bus::Json::object()).dump();
  auto line = std::make_shared<JournalLine>(begin_line(visitor_.sender, visitor_.peer, "POST", target));
  if (user) set_user(*line, *user);
  add_body(*line, body);
  api_.handle(found, {"", body}, [self = shared_from_this(), order, line, under_way](Answer made) {
    boost::asio::post(self->socket_.get_executor(), [self, order, line, under_way, made = std::move(made)] {
      self->api_.operating().answered(under_way, made.status);
      add_answer(*line, made.body);
      line->status = static_cast<std::uint16_t>(made.status);
      set_asked(*line, made.asked);
      self->api_.mailbox().post([line](Links& links, double) { links.journal.write(*line); });
      self->answer_order(order, made);
    });
  });
}

void StreamSession::answer_order(const bus::Json& order, const Answer& made) {
  // Who sends orders and reads no answers gets no more of them.
  if (answers_.size() >= most_answers) return close();
  answers_.push_back(text({{"answer", order["order"]},
                           {"status", made.status},
                           {"body", bus::Json::parse(made.body, nullptr, false)}}));
  offer();
}

void StreamSession::offer() {
  if (writing_) return;
  if (!answers_.empty()) {
    auto answer = std::move(answers_.front());
    answers_.pop_front();
    return send(std::move(answer));
  }
  const auto& newest = hub_.newest();
  if (!newest || newest == sent_) return;
  const auto now = std::chrono::steady_clock::now();
  auto message = hub_.message(sent_, now - last_message_ >= heartbeat_period);
  if (message->empty()) return;
  sent_ = newest;
  last_message_ = now;
  send(std::move(message));
}

void StreamSession::send(std::shared_ptr<const std::string> message) {
  writing_ = std::move(message);
  socket_.text(true);
  socket_.async_write(boost::asio::buffer(*writing_),
                      Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
                        self->writing_.reset();
                        if (error) return self->close();
                        self->offer();
                      }));
}

void StreamSession::close() {
  socket_.next_layer().close();
  hub_.leave(shared_from_this());
}

}  // namespace trunnion::gateway
