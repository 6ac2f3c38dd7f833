// SPDX-License-Identifier: Apache-2.0
#include "resources/bodies.hpp"

#include "core/bodies_document.hpp"
#include "core/cluster_state.hpp"
#include "machine/chain_parameters.hpp"

namespace trunnion::gateway {

void answer_bodies(const Mailbox& mailbox, Worker& files, const std::string& directory,
                   const std::string& channel, const Respond& respond) {
  const auto number = path_number(channel, 65535);
  const auto cluster = mailbox.newest();
  if (!cluster || !cluster->parameters)
    return respond(problem_answer(504, "the parameters service has not published yet"));
  if (!number || !cluster->channels.contains(static_cast<std::uint16_t>(*number)))
    return respond(problem_answer(404, "no channel " + channel));
  const bool taken = files.offer([cluster, directory, number = static_cast<std::uint16_t>(*number), respond] {
    try {
      const auto bodies =
          collision::load_bodies(directory, machine::chain_parameters(*cluster->values, number));
      auto document = bodies_document(bodies);
      document["channel"] = number;
      document["derived"] = bodies.derived;
      respond(json_answer(200, document));
    } catch (const std::exception& error) {
      respond(problem_answer(409, error.what()));
    }
  });
  if (!taken) respond(busy_answer());
}

}  // namespace trunnion::gateway
