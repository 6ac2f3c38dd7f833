// SPDX-License-Identifier: Apache-2.0
#include "api.hpp"

#include <algorithm>
#include <fstream>

#include "commands/command_table.hpp"
#include "core/paging.hpp"
#include "core/precondition.hpp"
#include "core/requests.hpp"
#include "core/rights.hpp"
#include "core/static_files.hpp"
#include "machine/alarm_constants.hpp"
#include "storage/crc32.hpp"

namespace trunnion::gateway {
extern const char* const openapi_text;  // gateway/openapi.json, embedded
namespace {

using bus::Json;

constexpr std::chrono::seconds shown_within{1};  // what the cluster has accepted is in the state by then

Answer silent(const char* who) {
  return error_answer(504, std::string("no answer from the ") + who + " service");
}

template <class Reply>
std::uint32_t alarm_of(const Reply& reply) {
  if constexpr (requires { reply.alarm; })
    return reply.alarm;
  else
    return 0;
}

/// What `who` made of one request; `accepted` gives the body when it was that.
template <class Request, class Reply, class Accepted>
Answer answer_to(const Request& asked, const std::optional<Reply>& reply, const char* who,
                 Accepted accepted) {
  auto answer = !reply             ? silent(who)
                : !reply->accepted ? refused_answer(alarm_of(*reply), reply->reason)
                                   : json_answer(200, accepted());
  answer.asked = {asked.client, asked.number, 1};
  return answer;
}

/// To a stop that the channel has not answered yet.
Answer repeated_answer(const idl::channel::ChannelRequest& asked, std::string_view route) {
  std::string name(route);
  std::ranges::replace(name, '-', ' ');
  auto answer = json_answer(
      202, {{"accepted", true},
            {"reason", name + " is repeated until channel " + std::to_string(asked.channel) +
                           " answers, for " + std::to_string(static_cast<int>(stop_repeated_for)) +
                           " s at most: press emergency stop if the axes still move"}});
  answer.asked = {asked.client, asked.number, 1};
  return answer;
}

Answer published(const Json& answer, const char* who) {
  return answer.is_null() ? error_answer(504, std::string("the ") + who + " service has not published yet")
                          : json_answer(200, answer);
}

template <class T>
Answer published(const std::shared_ptr<const T>& value, const char* who) {
  return published(value ? bus::to_json(*value) : Json(nullptr), who);
}

void submit(Mailbox& mailbox, idl::program::ProgramRequest request, ProgramDone done) {
  using Operation = idl::program::Operation;
  const bool part = request.operation == Operation::WRITE || request.operation == Operation::COMMIT_UPLOAD;
  mailbox.post([part, request = std::move(request), done = std::move(done)](Links& links, double now) {
    links.program.submit(
        request, [done](const auto&, const ProgramReply& reply) { done(reply); }, now,
        part ? give_up_part_after : give_up_after);
  });
}

Answer tagged(Answer answer, const std::string& tag) {
  if (answer.status == 200) answer.headers.emplace_back("ETag", tag);
  return answer;
}

}  // namespace

Answer unrouted(RouteResult result) {
  return result == RouteResult::no_method ? error_answer(405, "this path does not know this method")
                                          : error_answer(404, "no such path");
}

void Api::handle(const Match& match, const RequestText& request, const Respond& respond) {
  if (is_short(match.operation)) return carry_out(match, request, respond);
  if (!requests_.offer([this, match, request, respond] { carry_out(match, request, respond); }))
    respond(busy_answer());
}

void Api::carry_out(const Match& match, const RequestText& request, const Respond& respond) {
  const auto& [query, body] = std::tie(request.query, request.body);
  try {
    switch (match.operation) {
      case Operation::panel_command:
        return send_panel(match.command, parse_body(body), respond);
      case Operation::alarms_reset: {
        const auto reset = alarm_reset(parse_body(body));
        mailbox_.post([reset, respond](Links& links, double) {
          auto answer = json_answer(200, {{"accepted", true}});
          answer.asked = links.alarm_resets.write(reset);
          respond(std::move(answer));
        });
        return;
      }
      case Operation::set_parameter:
      case Operation::set_parameters:
      case Operation::set_tool:
      case Operation::set_work_offset:
        return send_parameters(match, parse_body(body), request, respond);
      case Operation::remove_tool:
        return send_parameters(match, {}, request, respond);
      case Operation::check:
        return check(match, query, body, respond);
      case Operation::plan_program:
        return plan(match, query, respond);
      case Operation::remove_program:
        return remove_program(match.parts.at(0), respond);
      case Operation::rename_program:
        stored_.erase(match.parts.at(0));
        return send_program(rename_request(match.parts[0], parse_body(body)), respond);
      case Operation::channel_command:
        return send_channel(match, parse_body(body), request.user, respond);
      case Operation::session:
        return respond(access_.session(request));
      case Operation::login:
        return access_.login(body, request.peer, respond);
      case Operation::logout:
        operating_.release(operating_.station_of(request.cookies, request.peer, request.user));
        return respond(access_.logout(request));
      case Operation::operating_right:
      case Operation::change_operating_right:
        return respond(operating_.handle(match, request));
      case Operation::plc_programs:
      case Operation::plc_source:
      case Operation::plc_variables:
      case Operation::plc_forces:
      case Operation::plc_tasks:
      case Operation::plc_uses:
      case Operation::plc_force:
      case Operation::plc_release:
      case Operation::plc_start_trace:
      case Operation::plc_trace:
      case Operation::plc_end_trace:
      case Operation::plc_begin_load:
      case Operation::plc_load:
      case Operation::plc_compare:
      case Operation::plc_take_over:
      case Operation::plc_end_load:
        return plc_.handle(match, request, respond);
      case Operation::bodies:
        return answer_bodies(mailbox_, files(), machine_directory_, match.parts.at(0), respond);
      case Operation::measurement:
      case Operation::measurement_start:
      case Operation::measurement_continue:
      case Operation::measurement_abort:
      case Operation::measurement_confirm:
      case Operation::measurement_discard:
      case Operation::measurement_inputs:
      case Operation::measurement_last:
      case Operation::measurement_undo:
      case Operation::manual_calibration:
      case Operation::manual_evaluation:
      case Operation::manual_write:
        return measurement_.handle(match, request, respond);
      case Operation::recordings:
      case Operation::read_recording:
      case Operation::recording_table:
      case Operation::start_recording:
      case Operation::stop_recording:
      case Operation::remove_recording:
        return recordings_.handle(match, request, respond);
      default:
        return respond(read(match, query));
    }
  } catch (const BadRequest& bad) {
    respond(error_answer(400, bad.what(), bad.field));
  }
}

Answer Api::read(const Match& match, const std::string& query) const {
  if (match.operation == Operation::openapi) return {200, openapi_text};
  const auto cluster = mailbox_.newest();
  if (!cluster) return error_answer(503, "the gateway is starting");
  switch (match.operation) {
    case Operation::status:
      return json_answer(200, status_answer(*cluster, contract_));
    case Operation::alarms:
      return list_answer(alarms_answer(*cluster), "alarms", query);
    case Operation::past_alarms:
      return list_answer(past_alarms_answer(*cluster, query_value(query, "search")), "alarms", query);
    case Operation::channels:
      return json_answer(200, channels_answer(*cluster));
    case Operation::channel: {
      const auto number = path_number(match.parts.at(0), 65535);
      const auto answer =
          number ? channel_answer(*cluster, static_cast<std::uint16_t>(*number)) : Json(nullptr);
      return answer.is_null() ? error_answer(404, "no channel " + match.parts[0]) : json_answer(200, answer);
    }
    case Operation::variables: {
      const auto number = path_number(match.parts.at(0), 65535);
      const auto found =
          number ? cluster->variables.find(static_cast<std::uint16_t>(*number)) : cluster->variables.end();
      if (found == cluster->variables.end())
        return error_answer(404, "no variables of channel " + match.parts[0]);
      return json_answer(200, bus::to_json(*found->second));
    }
    case Operation::parameters: {
      ParameterQuery wanted;
      wanted.group = query_value(query, "class");
      wanted.search = query_value(query, "search");
      wanted.offset = count_in_query(query, "offset", 0);
      wanted.limit = count_in_query(query, "limit", 500);
      return tagged(published(parameters_answer(*cluster, wanted), "parameters"), cluster->parameters_tag);
    }
    case Operation::parameter: {
      const auto number = path_number(match.parts.at(0), 999999);
      if (!number || machine::Catalogue::instance().find(*number) == nullptr)
        return error_answer(404, "no parameter " + match.parts[0]);
      return tagged(published(parameter_answer(*cluster, *number), "parameters"), cluster->parameters_tag);
    }
    case Operation::tools:
      if (!cluster->tools) return published(cluster->tools, "parameters");
      return tagged(list_answer(bus::to_json(*cluster->tools), "tools", query),
                    entity_tag(cluster->tools->revision));
    case Operation::work_offsets:
      return tagged(published(cluster->offsets, "parameters"),
                    entity_tag(cluster->offsets ? cluster->offsets->revision : 0));
    case Operation::programs:
      if (!cluster->programs) return published(cluster->programs, "program");
      return list_answer(bus::to_json(*cluster->programs), "programs", query);
    case Operation::plc_image:
      return published(cluster->image, "plc");
    default:
      return error_answer(404, "no such path");
  }
}

void Api::send_channel(const Match& match, const Json& body, const std::optional<access::Identity>& user,
                       const Respond& respond) {
  const auto number = path_number(match.parts.at(0), 65535);
  const auto cluster = mailbox_.newest();
  const auto known = cluster && number ? cluster->channels.find(static_cast<std::uint16_t>(*number))
                                       : decltype(cluster->channels.end()){};
  if (!cluster || !number || known == cluster->channels.end())
    return respond(error_answer(404, "no channel " + match.parts[0]));
  auto request = channel_request(match.command, body, known->second);
  request.role = role_of(user);
  request.who = user ? user->name : "hmi";
  const auto motion = commands::motion_of(request.command);
  mailbox_.post([request, motion, route = match.command, respond](Links& links, double now) {
    const auto answer = [motion, route, respond](const auto& asked, const auto& reply) {
      if (!reply && motion == commands::Motion::stops) return respond(repeated_answer(asked, route));
      respond(answer_to(asked, reply, "channel", [&] {
        return Json{{"accepted", true}, {"cycle", reply->cycle}};
      }));
    };
    if (motion == commands::Motion::stops) {
      links.withdraw_starts(request);
      links.repeat_only(request);
      return links.channel.submit_stop(request, answer, now);
    }
    if (motion == commands::Motion::starts) links.withdraw_stops(request);
    links.channel.submit(request, answer, now);
  });
}

void Api::send_panel(std::string_view route, const Json& body, const Respond& respond) {
  mailbox_.post([request = panel_request(route, body), respond](Links& links, double now) {
    links.panel.submit(
        request,
        [respond](const auto& asked, const auto& reply) {
          respond(answer_to(asked, reply, "plc", [] { return Json{{"accepted", true}}; }));
        },
        now);
  });
}

std::optional<Answer> Api::parameter_refusal(const idl::parameters::ParameterRequest& asked,
                                             const RequestText& request) const {
  if (!request.user || request.user->role >= access::Role::builder) return {};
  for (const auto& value : asked.values) {
    const auto* definition = machine::Catalogue::instance().find(value.number);
    if (definition != nullptr && definition->access == "builder")
      return error_answer(403, "parameter " + machine::number_text(value.number) +
                                   " needs the role builder, and " + request.user->name + " is " +
                                   access::name_of(request.user->role));
  }
  return {};
}

std::string Api::changed_meanwhile(const Match& match, const std::string& if_match,
                                   idl::parameters::ParameterRequest& request) const {
  if (if_match.empty()) return {};
  const auto cluster = mailbox_.newest();
  if (!cluster || !cluster->parameters || !cluster->tools || !cluster->offsets)
    return "the parameters service has not published yet";
  const auto check = [&](const std::string& now) {
    return if_match == "*" || if_match == now ? std::string()
                                              : "the change was made on " + if_match + ", and by now it is " +
                                                    now + ": read the values again";
  };
  // The service compares the revisions of its tables, too.
  const auto check_table = [&](std::uint64_t revision) {
    if (if_match != "*" && request.revision == 0) request.revision = revision;
    return check(entity_tag(revision));
  };
  if (match.operation == Operation::set_work_offset) return check_table(cluster->offsets->revision);
  if (match.operation == Operation::set_tool || match.operation == Operation::remove_tool)
    return check_table(cluster->tools->revision);
  if (sent_.from == cluster->parameters && std::chrono::steady_clock::now() - sent_.since < shown_within)
    return "another change of the parameters is under way: read the values again";
  return check(cluster->parameters_tag);
}

void Api::send_parameters(const Match& match, const Json& body, const RequestText& text,
                          const Respond& respond) {
  idl::parameters::ParameterRequest request;
  if (match.operation == Operation::set_work_offset) {
    request = work_offset_request(body);
  } else if (match.operation == Operation::set_parameters) {
    request = parameter_import(body);
  } else if (match.operation != Operation::set_parameter) {
    const auto number = path_number(match.parts.at(0), 999999);
    if (!number || *number == 0) return respond(error_answer(404, "no tool " + match.parts[0]));
    request = match.operation == Operation::set_tool
                  ? tool_request(*number, body)
                  : tool_removal(*number, query_value(text.query, "revision"));
  } else {
    const auto number = path_number(match.parts.at(0), 999999);
    const auto* definition = number ? machine::Catalogue::instance().find(*number) : nullptr;
    if (definition == nullptr) return respond(error_answer(404, "no parameter " + match.parts[0]));
    request = parameter_request(*number, definition->type == machine::ParameterType::text, body);
  }
  if (auto refusal = parameter_refusal(request, text)) return respond(std::move(*refusal));
  if (const auto changed = changed_meanwhile(match, text.if_match, request); !changed.empty())
    return respond(error_answer(412, changed));
  if (match.operation == Operation::set_parameter || match.operation == Operation::set_parameters)
    if (const auto cluster = mailbox_.newest())
      sent_ = {cluster->parameters, std::chrono::steady_clock::now()};
  if (text.user) request.who = text.user->name;  // who is logged in, whatever the body says
  request.role = role_of(text.user);
  mailbox_.post([request, respond](Links& links, double now) {
    links.parameters.submit(
        request,
        [respond](const auto& asked, const auto& reply) {
          respond(answer_to(asked, reply, "parameters", [&] {
            return Json{{"accepted", true}, {"revision", reply->revision}, {"pending", reply->pending}};
          }));
        },
        now);
  });
}

void Api::send_program(const idl::program::ProgramRequest& request, const Respond& respond) {
  mailbox_.post([request, respond](Links& links, double now) {
    links.program.submit(
        request,
        [respond](const auto& asked, const auto& reply) {
          respond(answer_to(asked, reply, "program", [] { return Json{{"accepted", true}}; }));
        },
        now);
  });
}

void Api::remove_program(const std::string& name, const Respond& respond) {
  commands::check_program_name(name);
  stored_.erase(name);
  idl::program::ProgramRequest request{};
  request.operation = idl::program::Operation::REMOVE;
  request.name = name;
  send_program(request, respond);
}

void Api::note_stored(const idl::program::ProgramEntry& entry) {
  stored_[entry.name] = {entry.revision, std::chrono::steady_clock::now()};
}

std::uint64_t Api::stored_lately(const std::string& name) {
  const auto old = std::chrono::steady_clock::now() - shown_within;
  std::erase_if(stored_, [&](const auto& one) { return one.second.since < old; });
  const auto found = stored_.find(name);
  return found == stored_.end() ? 0 : found->second.revision;
}

void Api::check(const Match& match, const std::string& query, const std::string& text,
                const Respond& respond) {
  const auto number = path_number(match.parts.at(0), 31);
  const auto cluster = mailbox_.newest();
  if (!cluster || !number || !cluster->channels.contains(static_cast<std::uint16_t>(*number)))
    return respond(error_answer(404, "no channel " + match.parts[0]));
  checker_.submit({text, query_value(query, "name"), static_cast<std::uint16_t>(*number), cluster, respond});
}

void Api::plan(const Match& match, const std::string& query, const Respond& respond) {
  const auto text = query_value(query, "channel");
  const auto number = path_number(text.empty() ? "0" : text, 31);
  const auto cluster = mailbox_.newest();
  if (!cluster || !number || !cluster->channels.contains(static_cast<std::uint16_t>(*number)))
    return respond(problem_answer(404, "no channel " + text));
  planner_.submit({match.parts.at(0), static_cast<std::uint16_t>(*number), cluster, respond});
}

void Api::page(const std::string& path, bool gzip, const Respond& respond) {
  if (!requests_.offer([this, path, gzip, respond] { respond(file_of_page(path, gzip)); }))
    respond(busy_answer());
}

Answer Api::file_of_page(std::string_view path, bool gzip) const {
  const auto file = find_static(web_, path);
  if (!file) return error_answer(404, "no such file");
  auto name = file->path;
  // Compressed once, when the page was built.
  gzip = gzip && std::filesystem::is_regular_file(name += ".gz");
  std::ifstream stream(gzip ? name : file->path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) return error_answer(500, "the file cannot be read");
  Answer answer{200, std::move(content), std::string(file->type),
                file->immutable ? "public, max-age=31536000, immutable" : "no-cache"};
  if (gzip) answer.encoding = "gzip";
  return answer;
}

Answer program_refusal(const ProgramReply& reply) {
  if (!reply) return silent("program");
  auto answer = refused_answer(reply->alarm, reply->reason);
  if (reply->alarm == alarm::storage_failed.number) answer.status = 507;
  return answer;
}

idl::program::ProgramRequest ProgramUpload::request(idl::program::Operation operation) {
  idl::program::ProgramRequest made{};
  made.client = client_;
  made.number = ++number_;
  made.operation = operation;
  made.name = name_;
  return made;
}

void ProgramUpload::send(idl::program::ProgramRequest sent, ProgramDone done) {
  submit(mailbox_, std::move(sent), std::move(done));
}

void ProgramUpload::begin(ProgramDone done) {
  send(request(idl::program::Operation::BEGIN_UPLOAD), std::move(done));
}

void ProgramUpload::write(std::vector<std::uint8_t> data, ProgramDone done) {
  auto part = request(idl::program::Operation::WRITE);
  part.offset = size_;
  size_ += data.size();
  crc_ = storage::crc32(crc_, data);
  part.data = std::move(data);
  send(std::move(part), std::move(done));
}

void ProgramUpload::commit(ProgramDone done) {
  auto end = request(idl::program::Operation::COMMIT_UPLOAD);
  end.crc32 = crc_;
  end.size = size_;
  end.role = role_;
  send(std::move(end), std::move(done));
}

void ProgramUpload::abort() {
  send(request(idl::program::Operation::ABORT_UPLOAD), [](const ProgramReply&) {});
}

void ProgramDownload::read(std::uint64_t revision, std::uint64_t offset, ProgramDone done) {
  idl::program::ProgramRequest request{};
  request.client = client_;
  request.number = ++number_;
  request.operation = idl::program::Operation::READ;
  request.name = name_;
  request.revision = revision;
  request.offset = offset;
  request.length = chunk_bytes;
  submit(mailbox_, std::move(request), std::move(done));
}

}  // namespace trunnion::gateway
