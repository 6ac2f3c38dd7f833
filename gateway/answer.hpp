// SPDX-License-Identifier: Apache-2.0
// What is answered to a request, without any HTTP library.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "access/sessions.hpp"
#include "bus/json.hpp"
#include "core/body_source.hpp"
#include "core/operator_journal.hpp"

namespace trunnion::gateway {

/// What an operation reads of a request besides its path. Headers are empty when they are not there.
struct RequestText {
  std::string query = {}, body = {};
  std::string range = {}, if_range = {}, if_match = {}, cookies = {};
  std::string peer = {};                      ///< address of the other side
  std::optional<access::Identity> user = {};  ///< nobody when auth is off, or without a login
};

struct Answer {
  unsigned status = 200;
  std::string body;
  std::string type = "application/json";
  std::string cache = "no-store";
  Asked asked = {};                                               ///< for the journal
  std::string encoding = {};                                      ///< of the body: empty or gzip
  std::vector<std::pair<std::string, std::string>> headers = {};  ///< further ones
  std::shared_ptr<BodySource> source = {};   ///< takes the place of `body`, on the thread of the files
  std::optional<std::uint64_t> length = {};  ///< bytes that `source` gives, when they are known
};

/// Called once, on any thread.
using Respond = std::function<void(Answer)>;

Answer json_answer(unsigned status, const bus::Json& body);
/// {"error": text, "field": field}; the field only when there is one.
Answer error_answer(unsigned status, const std::string& text, const std::string& field = {});
/// 503: as many requests wait as may.
Answer busy_answer();
/// As "application/problem+json" (RFC 9457): {"type", "title", "status", "detail", "field"}.
Answer problem_answer(unsigned status, const std::string& detail, const std::string& field = {});

/// The part of the list `member` of `body` that offset and limit of the query ask for; how many it has is in
/// X-Total-Count. Throws BadRequest.
Answer list_answer(bus::Json body, const char* member, const std::string& query);

/// 409 with the number of an alarm, 0 = none, and the reason.
Answer refused_answer(std::uint32_t alarm, const std::string& reason);

}  // namespace trunnion::gateway
