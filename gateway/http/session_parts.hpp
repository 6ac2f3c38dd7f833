// SPDX-License-Identifier: Apache-2.0
// What the sources of HttpSession share.
#pragma once

#include <boost/beast/http/fields.hpp>
#include <boost/beast/http/message.hpp>
#include <chrono>
#include <string_view>

#include "answer.hpp"

namespace trunnion::gateway {

inline constexpr std::chrono::seconds timeout{30};
inline constexpr unsigned http_version = 11;

inline std::string_view view(boost::beast::string_view text) { return {text.data(), text.size()}; }

template <class Response>
void set_fields(Response& response, const Answer& made) {
  using boost::beast::http::field;
  response.set(field::content_type, made.type);
  response.set(field::cache_control, made.cache);
  response.set(field::vary, "Accept-Encoding");
  if (!made.encoding.empty()) response.set(field::content_encoding, made.encoding);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Content-Security-Policy", "frame-ancestors 'self'");
  for (const auto& [name, value] : made.headers) response.set(name, value);
}

}  // namespace trunnion::gateway
