// SPDX-License-Identifier: Apache-2.0
// HttpSession: answers that are sent in parts.
#include <boost/asio/post.hpp>
#include <boost/beast/http/write.hpp>

#include "core/requests.hpp"
#include "http/session.hpp"
#include "http/session_parts.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::gateway {

namespace beast = boost::beast;
namespace http = beast::http;
namespace net = boost::asio;

// --- From a file: the next part is read when the one before has left.

void HttpSession::send_source(Answer made) {
  sending_ = std::make_unique<Sending>();
  auto& response = sending_->response;
  response.version(http_version);
  response.result(static_cast<http::status>(made.status));
  set_fields(response, made);
  if (made.length)
    response.content_length(*made.length);
  else
    response.chunked(true);
  response.keep_alive(keep_alive_);
  sending_->source = std::move(made.source);
  sending_->serializer.emplace(response);
  next_of_source();
}

void HttpSession::next_of_source() {
  api_.files().post([self = shared_from_this(), source = sending_->source] {
    auto part = source->next();
    net::post(self->stream_.get_executor(),
              [self, part = std::move(part)]() mutable { self->send_of_source(std::move(part)); });
  });
}

void HttpSession::send_of_source(std::optional<std::string> part) {
  auto& sending = *sending_;
  // The status has gone out already: only a body without its end can say that the rest cannot be had.
  if (!part) return stream_.close();
  sending.part = std::move(*part);
  const bool more = !sending.part.empty();
  auto& body = sending.response.body();
  body.data = more ? sending.part.data() : nullptr;
  body.size = sending.part.size();
  body.more = more;
  stream_.expires_after(timeout);
  http::async_write(stream_, *sending.serializer,
                    Transferred([self = shared_from_this(), more](beast::error_code error, std::size_t) {
                      if (error == http::error::need_buffer) error = {};
                      if (error) return;
                      if (more) return self->next_of_source();
                      self->sending_.reset();
                      if (self->keep_alive_) return self->read_next();
                      self->stream_.finish();
                    }));
}

// --- Download: each part is asked for when the one before has left.

void HttpSession::begin_download() {
  const auto& name = match_.parts.at(0);
  try {
    commands::check_program_name(name);
  } catch (const BadRequest&) {
    return answer(error_answer(404, "no program " + name));
  }
  download_ = std::make_unique<Download>(ProgramDownload(api_.mailbox(), name));
  download_->source.read(0, 0, here(&HttpSession::download_part));
}

void HttpSession::download_part(const ProgramReply& reply) {
  auto& download = *download_;
  const bool good = reply && reply->accepted && reply->offset == download.offset;
  if (!download.serializer) {
    if (!good) {
      const auto& name = download.source.name();
      const bool missing = reply && !reply->accepted && reply->alarm == alarm::program_missing.number;
      auto made = missing ? error_answer(404, "no program " + name) : program_refusal(reply);
      made.asked = download.source.asked();
      return answer(std::move(made));
    }
    download.revision = reply->entry.revision;
    download.size = reply->entry.size;
    download.response.version(http_version);
    download.response.result(http::status::ok);
    download.response.set(http::field::content_type, "text/plain; charset=utf-8");
    download.response.set(http::field::cache_control, "no-store");
    download.response.set("X-Program-Revision", std::to_string(download.revision));
    download.response.set(http::field::etag, '"' + std::to_string(download.revision) + '"');
    download.response.content_length(download.size);
    download.response.keep_alive(keep_alive_);
    download.serializer.emplace(download.response);
  } else if (!good) {
    // The status has gone out already: only a short body can tell that the program changed or its keeper is
    // gone.
    return download_broken();
  }
  download.part = reply->data;
  const auto left = download.size - download.offset;
  if (download.part.size() > left || (download.part.empty() && left > 0)) return download_broken();
  download.offset += download.part.size();
  add_answer(*line_, {reinterpret_cast<const char*>(download.part.data()), download.part.size()});
  send_part();
}

void HttpSession::download_broken() {
  journal_unanswered(download_->source.asked());
  stream_.close();
}

void HttpSession::send_part() {
  auto& body = download_->response.body();
  body.data = download_->part.empty() ? nullptr : download_->part.data();
  body.size = download_->part.size();
  body.more = download_->offset < download_->size;
  stream_.expires_after(timeout);
  http::async_write(stream_, *download_->serializer,
                    Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
                      if (error == http::error::need_buffer) error = {};
                      auto& download = *self->download_;
                      const auto asked = download.source.asked();
                      if (error) return self->journal_unanswered(asked);
                      if (download.offset < download.size)
                        return download.source.read(download.revision, download.offset,
                                                    self->here(&HttpSession::download_part));
                      self->download_.reset();
                      self->journal(200, asked, [self] {
                        if (self->keep_alive_) self->read_next();
                      });
                    }));
}

}  // namespace trunnion::gateway
