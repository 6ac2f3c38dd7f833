// SPDX-License-Identifier: Apache-2.0
#include "answer.hpp"

#include <map>

#include "core/paging.hpp"
#include "core/worker.hpp"

namespace trunnion::gateway {

using bus::Json;

Answer json_answer(unsigned status, const Json& body) {
  // Texts of the bus may be cut within a character; such a byte must not take the answer down.
  return {status, bus::text_of(body)};
}

Answer error_answer(unsigned status, const std::string& text, const std::string& field) {
  Json body = {{"error", text}};
  if (!field.empty()) body["field"] = field;
  return json_answer(status, body);
}

Answer problem_answer(unsigned status, const std::string& detail, const std::string& field) {
  static const std::map<unsigned, const char*> titles = {{400, "Bad Request"},
                                                         {404, "Not Found"},
                                                         {409, "Conflict"},
                                                         {503, "Service Unavailable"},
                                                         {504, "Gateway Timeout"}};
  const auto title = titles.find(status);
  Json body = {{"type", "about:blank"},
               {"title", title == titles.end() ? "Error" : title->second},
               {"status", status},
               {"detail", detail}};
  if (!field.empty()) body["field"] = field;
  auto answer = json_answer(status, body);
  answer.type = "application/problem+json";
  return answer;
}

Answer busy_answer() {
  return error_answer(503, std::to_string(Worker::most_waiting) + " requests wait already: try again");
}

Answer list_answer(Json body, const char* member, const std::string& query) {
  const auto total = cut_to_page(body[member], query);
  auto answer = json_answer(200, body);
  answer.headers.emplace_back("X-Total-Count", std::to_string(total));
  return answer;
}

Answer refused_answer(std::uint32_t alarm, const std::string& reason) {
  return json_answer(409, {{"accepted", false}, {"alarm", alarm}, {"reason", reason}});
}

}  // namespace trunnion::gateway
