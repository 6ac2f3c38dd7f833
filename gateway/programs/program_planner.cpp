// SPDX-License-Identifier: Apache-2.0
#include "programs/program_planner.hpp"

#include <chrono>

#include "channel_setup/channel_setup.hpp"
#include "core/cluster_state.hpp"
#include "core/program_plan.hpp"
#include "programs/stored_texts.hpp"

namespace trunnion::gateway {

using Clock = std::chrono::steady_clock;

void ProgramPlanner::submit(const Job& job) {
  if (!worker_.offer([this, job] { job.respond(run(job)); }))
    job.respond(problem_answer(503, "too many programs are being planned; try again"));
}

void ProgramPlanner::stop() {
  stopping_ = true;
  worker_.stop();
}

Answer ProgramPlanner::run(const Job& job) {
  const auto& cluster = *job.cluster;
  if (!cluster.parameters || !cluster.tools || !cluster.offsets)
    return problem_answer(504, "the parameters service has not published yet");
  StoredTexts texts(mailbox_);
  auto answer = plan(job, texts);
  // Also of one that is refused: the requests are in the journal.
  answer.asked = texts.asked();
  return answer;
}

Answer ProgramPlanner::plan(const Job& job, StoredTexts& texts) {
  const auto& cluster = *job.cluster;
  try {
    auto* text = texts.find(job.program);
    if (text == nullptr)
      return problem_answer(404, "no program " + job.program + ", or it is larger than " +
                                     std::to_string(StoredTexts::largest >> 20) + " MB");
    auto& kept = kept_[job.channel];
    const auto of = text->entry.name + "\n" + std::to_string(text->entry.revision) + " " +
                    cluster.parameters_tag + " " + std::to_string(cluster.tools->revision) + " " +
                    std::to_string(cluster.offsets->revision) + " " +
                    std::to_string(cluster.programs ? cluster.programs->revision : 0);
    if (kept.of != of) {
      channel_setup::ChannelSetup machine(job.channel);
      machine.configure(*cluster.values);
      machine.set_tools(*cluster.tools);
      machine.set_offsets(*cluster.offsets);
      machine.resolve = [&texts](std::string_view name) { return texts.find(name); };
      const auto until = Clock::now() + std::chrono::duration<double>(longest);
      auto document = plan_document(*text, machine, [&] { return stopping_ || Clock::now() > until; });
      document["program"] = text->entry.name;
      document["revision"] = text->entry.revision;
      document["channel"] = job.channel;
      kept = {of, bus::text_of(document)};
    }
    return {200, kept.document};
  } catch (const std::exception& error) {
    return problem_answer(409, error.what());
  }
}

}  // namespace trunnion::gateway
