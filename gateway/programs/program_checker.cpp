// SPDX-License-Identifier: Apache-2.0
#include "programs/program_checker.hpp"

#include <chrono>

#include "collision_guard/collision_guard.hpp"
#include "core/program_check.hpp"
#include "programs/stored_texts.hpp"

namespace trunnion::gateway {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

void ProgramChecker::submit(const Job& job) {
  if (!worker_.offer([this, job] { job.respond(run(job)); }))
    job.respond(error_answer(503, "too many programs are being checked; try again"));
}

void ProgramChecker::stop() {
  stopping_ = true;
  worker_.stop();
}

Answer ProgramChecker::run(const Job& job) {
  const auto& cluster = *job.cluster;
  if (!cluster.parameters || !cluster.tools || !cluster.offsets)
    return error_answer(504, "the parameters service has not published yet");
  try {
    channel_setup::ChannelSetup machine(job.channel);
    machine.configure(*cluster.values);
    machine.set_tools(*cluster.tools);
    machine.set_offsets(*cluster.offsets);
    StoredTexts texts(mailbox_);
    machine.resolve = [&texts](std::string_view name) { return texts.find(name); };
    const auto guard = collision_guard::load_guard(machine, machine_directory_, *cluster.values, job.channel);
    language::StringSource text(job.text, job.name);
    const auto until = Clock::now() + std::chrono::duration<double>(longest);
    auto answer = json_answer(
        200, check_program(text, machine, guard.get(), [&] { return stopping_ || Clock::now() > until; }));
    answer.asked = texts.asked();
    return answer;
  } catch (const std::exception& error) {
    return json_answer(409, {{"accepted", false}, {"alarm", 0}, {"reason", error.what()}});
  }
}

}  // namespace trunnion::gateway
