// SPDX-License-Identifier: Apache-2.0
#include "core/operator_journal.hpp"

#include "core/rights.hpp"
#include "storage/crc32.hpp"

namespace trunnion::gateway {
namespace {

// Bounds of the strings in gateway.idl.
constexpr std::size_t address_bytes = 48, method_bytes = 8, target_bytes = 256, text_bytes = 1024,
                      user_bytes = 48;

void add(std::string& kept, std::uint64_t& size, std::uint32_t& crc, std::string_view part) {
  crc = storage::crc32(crc, {reinterpret_cast<const std::uint8_t*>(part.data()), part.size()});
  size += part.size();
  if (size <= text_bytes)
    kept += part;
  else
    kept.clear();
}

}  // namespace

bool is_of_plc_programs(Operation operation) {
  return operation >= Operation::plc_programs && operation <= Operation::plc_end_load;
}

bool is_journaled(Operation operation) {
  if (operation == Operation::read_program || operation == Operation::plan_program) return true;
  if (operation == Operation::start_recording || operation == Operation::stop_recording ||
      operation == Operation::remove_recording || operation == Operation::login ||
      operation == Operation::logout || operation == Operation::change_operating_right ||
      operation == Operation::manual_evaluation || is_of_plc_programs(operation))
    return false;  // nothing of it is on the bus, and no password gets there
  for (const auto& route : routes())
    if (route.operation == operation) return route.method != "GET";
  return false;
}

JournalLine begin_line(idl::gateway::Sender sender, std::string_view address, std::string_view method,
                       std::string_view target) {
  JournalLine line{};
  line.sender = sender;
  line.address = address.substr(0, address_bytes);
  line.method = method.substr(0, method_bytes);
  line.target = target.substr(0, target_bytes);
  line.role = role_of({});
  return line;
}

void add_body(JournalLine& line, std::string_view part) {
  add(line.body, line.body_size, line.body_crc32, part);
}

void add_answer(JournalLine& line, std::string_view part) {
  add(line.answer, line.answer_size, line.answer_crc32, part);
}

void set_user(JournalLine& line, const access::Identity& user) {
  line.user = std::string_view(user.name).substr(0, user_bytes);
  line.role = role_of(user);
}

void set_asked(JournalLine& line, const Asked& asked) {
  line.client = asked.client;
  line.number = asked.number;
  line.requests = asked.requests;
}

}  // namespace trunnion::gateway
