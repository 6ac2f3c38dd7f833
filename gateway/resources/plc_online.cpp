// SPDX-License-Identifier: Apache-2.0
#include "resources/plc_online.hpp"

#include <algorithm>
#include <cctype>

#include "plc/online/task_times.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;
using idl::plc::OnlineAction;
using plc_online::ShownVariables;

constexpr std::uint32_t most_listed = 1000, most_rows = 100000;

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::uint32_t count_of(const std::string& query, const char* name, std::uint32_t otherwise,
                       std::uint32_t most) {
  const auto given = query_value(query, name);
  if (given.empty()) return otherwise;
  const auto number = path_number(given, most);
  if (!number)
    throw BadRequest(name, std::string(name) + " must be a whole number up to " + std::to_string(most));
  return *number;
}

idl::plc::OnlineRequest request_for(OnlineAction action) {
  idl::plc::OnlineRequest request{};
  request.action = action;
  return request;
}

Answer accepted() { return json_answer(200, {{"accepted", true}}); }

}  // namespace

PlcOnline::PlcOnline(Mailbox& mailbox, Worker& requests)
    : mailbox_(mailbox), requests_(requests), tracer_(service::make_client_id()) {}

void PlcOnline::handle(const Match& match, const RequestText& request, const Respond& respond) {
  try {
    switch (match.operation) {
      case Operation::plc_programs:
        return answer_programs(respond);
      case Operation::plc_source:
        return answer_source(match.parts.at(0), request.query, respond);
      case Operation::plc_variables:
        return answer_variables(request.query, respond);
      case Operation::plc_forces: {
        const auto cluster = mailbox_.newest();
        if (!cluster || !cluster->plc_forces)
          return respond(problem_answer(504, "the plc service has not published yet"));
        auto forces = bus::to_json(*cluster->plc_forces);
        return respond(json_answer(200, {{"values", forces["values"]}}));
      }
      case Operation::plc_tasks:
        return answer_tasks(respond);
      case Operation::plc_uses:
        return answer_uses(request.query, respond);
      case Operation::plc_force:
        return order(force_request(parse_body(request.body)), respond);
      case Operation::plc_release:
        return order(release_request(parse_body(request.body)), respond);
      case Operation::plc_start_trace:
        return start_trace(parse_body(request.body), respond);
      case Operation::plc_trace:
        return read_trace(request.query, respond);
      case Operation::plc_end_trace:
        return order(of_trace(request_for(OnlineAction::END_TRACE)), respond);
      case Operation::plc_begin_load: {
        const auto body = parse_body(request.body);
        if (body.contains("undo")) {
          commands::only(body, {"undo"});
          if (body["undo"] != true) throw BadRequest("undo", "undo must be true");
          return with_sources(idl::plc::ProgramSet::PREVIOUS, respond, [this, respond](const auto& files) {
            send_all(std::make_shared<const std::vector<Request>>(load_requests(*files)), 0, respond);
          });
        }
        return send_all(std::make_shared<const std::vector<Request>>(load_requests(load_files(body))), 0,
                        respond);
      }
      case Operation::plc_load:
        return answer_load(std::make_shared<std::vector<std::string>>(), respond);
      case Operation::plc_compare:
        commands::only(parse_body(request.body), {});
        return order(request_for(OnlineAction::COMPARE), respond);
      case Operation::plc_take_over: {
        const auto body = parse_body(request.body);
        commands::only(body, {"accept_differences"});
        auto take = request_for(OnlineAction::TAKE_OVER);
        take.accept_differences = body.contains("accept_differences") &&
                                  commands::boolean(body["accept_differences"], "accept_differences");
        return order(take, respond);
      }
      default:
        return order(request_for(OnlineAction::END_LOAD), respond);
    }
  } catch (const BadRequest& bad) {
    respond(problem_answer(400, bad.what(), bad.field));
  }
}

void PlcOnline::send(Request request, const Respond& respond, Done done) {
  mailbox_.post(
      [this, request = std::move(request), respond, done = std::move(done)](Links& links, double now) {
        links.online.submit(
            request,
            [this, respond, done](const Request& asked, const std::optional<Reply>& reply) {
              if (reply && reply->accepted)
                return requests_.post([done, asked, reply = *reply] { done(asked, reply); });
              auto answer = reply ? problem_answer(409, reply->reason)
                                  : problem_answer(504, "no answer from the plc service");
              answer.asked = {asked.client, asked.number, 1};
              respond(std::move(answer));
            },
            now);
      });
}

void PlcOnline::order(Request request, const Respond& respond) {
  send(std::move(request), respond, [respond](const Request& asked, const Reply&) {
    auto answer = accepted();
    answer.asked = {asked.client, asked.number, 1};
    respond(std::move(answer));
  });
}

void PlcOnline::send_all(std::shared_ptr<const std::vector<Request>> requests, std::size_t next,
                         const Respond& respond) {
  if (next == requests->size()) return respond(accepted());
  send((*requests)[next], respond, [this, requests, next, respond](const Request&, const Reply&) {
    send_all(requests, next + 1, respond);
  });
}

std::uint64_t PlcOnline::running() const {
  const auto cluster = mailbox_.newest();
  if (!cluster || !cluster->plc_programs) return 0;
  const auto& programs = *cluster->plc_programs;
  return (static_cast<std::uint64_t>(programs.changes) + 1) << 32 | programs.crc32;
}

// --- Variables: the whole list is read once for each state of the programs.

void PlcOnline::with_variables(const Respond& respond, Then<Variables> then) {
  const auto programs = running();
  std::shared_ptr<const Variables> known;
  {
    const std::lock_guard lock(mutex_);
    if (programs != 0 && programs == variables_of_) known = variables_;
  }
  if (known) return then(known);
  read_variables(std::make_shared<Variables>(), programs, respond, std::move(then));
}

void PlcOnline::read_variables(std::shared_ptr<Variables> found, std::uint64_t programs,
                               const Respond& respond, Then<Variables> then) {
  auto request = request_for(OnlineAction::LIST_VARIABLES);
  request.first = static_cast<std::uint32_t>(found->size());
  send(request, respond, [this, found, programs, respond, then](const Request&, const Reply& reply) {
    found->insert(found->end(), reply.variables.begin(), reply.variables.end());
    if (found->size() < reply.total && !reply.variables.empty())
      return read_variables(found, programs, respond, then);
    {
      const std::lock_guard lock(mutex_);
      variables_ = found, variables_of_ = programs;
    }
    then(found);
  });
}

void PlcOnline::answer_variables(const std::string& query, const Respond& respond) {
  const auto offset = count_of(query, "offset", 0, 1000000);
  const auto limit = count_of(query, "limit", 200, most_listed);
  const auto search = upper(query_value(query, "search")), prefix = upper(query_value(query, "prefix"));
  with_variables(respond, [offset, limit, search, prefix, respond](const auto& all) {
    Variables shown;
    std::uint32_t total = 0;
    for (const auto& one : *all) {
      const auto path = upper(one.path);
      if (!path.starts_with(prefix) || path.find(search) == std::string::npos) continue;
      if (total++ >= offset && shown.size() < limit) shown.push_back(one);
    }
    respond(json_answer(200,
                        {{"total", total}, {"offset", offset}, {"variables", ShownVariables(shown).json()}}));
  });
}

void PlcOnline::answer_tasks(const Respond& respond) {
  auto request = request_for(OnlineAction::LIST_VARIABLES);
  request.paths = {plc_online::task_times_prefix};
  send(request, respond, [respond](const Request&, const Reply& reply) {
    try {
      respond(json_answer(200, {{"tasks", plc_online::json_of(plc_online::task_times(reply))}}));
    } catch (const std::runtime_error& e) {
      respond(problem_answer(409, e.what()));
    }
  });
}

void PlcOnline::answer_uses(const std::string& query, const Respond& respond) {
  auto request = request_for(OnlineAction::LIST_USES);
  request.paths = {query_value(query, "path")};
  if (request.paths[0].empty()) throw BadRequest("path", "path is missing");
  if (request.paths[0].size() > 240) throw BadRequest("path", "path has more than 240 characters");
  request.first = count_of(query, "offset", 0, 1000000);
  send(request, respond, [respond](const Request& asked, const Reply& reply) {
    auto uses = bus::Json::array();
    for (const auto& use : reply.uses) uses.push_back(bus::to_json(use));
    respond(json_answer(200, {{"total", reply.total}, {"offset", asked.first}, {"uses", std::move(uses)}}));
  });
}

// --- Sources.

void PlcOnline::with_sources(idl::plc::ProgramSet set, const Respond& respond,
                             const Then<std::vector<PlcSource>>& then) {
  read_sources(set, std::make_shared<std::vector<PlcSource>>(1), 0, respond, then);
}

void PlcOnline::read_sources(idl::plc::ProgramSet set, std::shared_ptr<std::vector<PlcSource>> found,
                             std::uint32_t offset, const Respond& respond,
                             Then<std::vector<PlcSource>> then) {
  auto request = request_for(OnlineAction::READ_SOURCE);
  request.program = set;
  request.first = static_cast<std::uint32_t>(found->size() - 1);
  request.offset = offset;
  send(request, respond, [this, set, found, respond, then](const Request&, const Reply& reply) {
    auto& file = found->back();
    file.name = reply.file;
    file.text.append(reply.data.begin(), reply.data.end());
    if (file.text.size() < reply.size && !reply.data.empty())
      return read_sources(set, found, static_cast<std::uint32_t>(file.text.size()), respond, then);
    if (found->size() >= reply.total) return then(found);
    found->emplace_back();
    read_sources(set, found, 0, respond, then);
  });
}

void PlcOnline::answer_programs(const Respond& respond) {
  const auto cluster = mailbox_.newest();
  if (!cluster || !cluster->plc_programs)
    return respond(problem_answer(504, "the plc service has not published yet"));
  auto json = bus::to_json(*cluster->plc_programs);
  json.erase("plc");
  with_sources(idl::plc::ProgramSet::ACTIVE, respond, [json, respond](const auto& files) {
    auto body = json;
    body["files"] = Json::array();
    for (const auto& file : *files)
      body["files"].push_back({{"name", file.name}, {"bytes", file.text.size()}});
    respond(json_answer(200, body));
  });
}

void PlcOnline::answer_source(const std::string& name, const std::string& query, const Respond& respond) {
  const auto set = query_value(query, "set");
  if (!set.empty() && set != "active" && set != "previous")
    throw BadRequest("set", "set must be active or previous");
  const auto wanted = set == "previous" ? idl::plc::ProgramSet::PREVIOUS : idl::plc::ProgramSet::ACTIVE;
  with_sources(wanted, respond, [name, respond](const auto& files) {
    const auto found = std::ranges::find(*files, name, &PlcSource::name);
    if (found == files->end()) return respond(problem_answer(404, "the PLC runs no file " + name));
    Answer answer{200, found->text};
    answer.type = "text/plain; charset=utf-8";
    respond(std::move(answer));
  });
}

// --- Trace: one at a time, that of this gateway.

PlcOnline::Request PlcOnline::of_trace(Request request) {
  const std::lock_guard lock(mutex_);
  request.client = tracer_;
  request.number = ++trace_number_;
  return request;
}

void PlcOnline::start_trace(const Json& body, const Respond& respond) {
  send(of_trace(trace_request(body)), respond, [this, respond](const Request& asked, const Reply& reply) {
    auto shown = std::make_shared<const ShownVariables>(reply.variables);
    auto answer = json_answer(200, {{"accepted", true}, {"variables", shown->json()}});
    answer.asked = {asked.client, asked.number, 1};
    {
      const std::lock_guard lock(mutex_);
      traced_ = std::move(shown);
    }
    respond(std::move(answer));
  });
}

void PlcOnline::read_trace(const std::string& query, const Respond& respond) {
  auto request = request_for(OnlineAction::READ_TRACE);
  request.first = count_of(query, "from", 0, most_rows * 10);
  send(of_trace(request), respond, [this, respond](const Request& asked, const Reply& reply) {
    std::shared_ptr<const ShownVariables> shown;
    {
      const std::lock_guard lock(mutex_);
      shown = traced_;
    }
    if (!shown) return respond(problem_answer(409, "no trace was started here"));
    auto rows = Json::array();
    const auto width = shown->cells() + 2;
    const std::span cells(reply.cells);
    for (std::size_t at = 0; at + width <= cells.size(); at += width)
      rows.push_back({{"time_ms", cells[at]},
                      {"tick", cells[at + 1]},
                      {"values", shown->texts(cells.subspan(at + 2, shown->cells()))}});
    respond(json_answer(200, {{"from", asked.first},
                              {"total", reply.total},
                              {"complete", reply.complete},
                              {"variables", shown->json()},
                              {"rows", std::move(rows)}}));
  });
}

// --- New programs.

void PlcOnline::answer_load(std::shared_ptr<std::vector<std::string>> messages, const Respond& respond) {
  auto request = request_for(OnlineAction::LOAD_STATUS);
  request.first = static_cast<std::uint32_t>(messages->size());
  send(request, respond, [this, messages, respond](const Request&, const Reply& reply) {
    messages->insert(messages->end(), reply.messages.begin(), reply.messages.end());
    if (messages->size() < reply.total && !reply.messages.empty()) return answer_load(messages, respond);
    respond(json_answer(200, {{"phase", bus::to_string(reply.phase)},
                              {"compared", reply.compared},
                              {"differences", reply.differences},
                              {"messages", *messages}}));
  });
}

}  // namespace trunnion::gateway
