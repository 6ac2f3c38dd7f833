// SPDX-License-Identifier: Apache-2.0
#include "program_checker.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>

#include "src/program_check.hpp"
#include "stored_texts.hpp"

namespace trunnion::gateway {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

void ProgramChecker::submit(Job job) {
  std::unique_lock lock(mutex_);
  if (jobs_.size() >= most_waiting) {
    lock.unlock();
    return job.respond(error_answer(503, "too many programs are being checked; try again"));
  }
  jobs_.push_back(std::move(job));
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  wake_.notify_one();
}

void ProgramChecker::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    jobs_.clear();
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void ProgramChecker::work() {
  // Orders and the stream come first; without the permission it is as any other thread.
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
      if (stopping_) return;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    job.respond(run(job));
  }
}

Answer ProgramChecker::run(const Job& job) {
  const auto& snapshot = *job.snapshot;
  if (!snapshot.parameters || !snapshot.tools || !snapshot.offsets)
    return error_answer(504, "the parameters service has not published yet");
  try {
    channel_setup::ChannelSetup machine(job.channel);
    machine.configure(*snapshot.values);
    machine.set_tools(*snapshot.tools);
    machine.set_offsets(*snapshot.offsets);
    StoredTexts texts(mailbox_);
    machine.resolve = [&texts](std::string_view name) { return texts.find(name); };
    language::StringSource text(job.text);
    const auto until = Clock::now() + std::chrono::duration<double>(longest);
    auto answer =
        json_answer(200, check_program(text, machine, [&] { return stopping_ || Clock::now() > until; }));
    answer.asked = texts.asked();
    return answer;
  } catch (const std::exception& error) {
    return json_answer(409, {{"accepted", false}, {"alarm", 0}, {"reason", error.what()}});
  }
}

}  // namespace trunnion::gateway
