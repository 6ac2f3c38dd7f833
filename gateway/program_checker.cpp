// SPDX-License-Identifier: Apache-2.0
#include "program_checker.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <future>
#include <map>

#include "src/program_check.hpp"

namespace trunnion::gateway {
namespace {

using Clock = std::chrono::steady_clock;
using Reply = idl::program::ProgramReply;

/// Texts of subprograms, from the program service. Waits for its answers.
class StoredTexts {
 public:
  static constexpr std::size_t largest = 8u << 20;  ///< bytes of one text
  static constexpr std::uint32_t part = 60000;      ///< bytes in one request

  explicit StoredTexts(Mailbox& mailbox) : mailbox_(mailbox) {}

  language::TextSource* find(std::string_view call) {
    const auto [known, added] = texts_.try_emplace(std::string(call));
    if (added) known->second = read(known->first);
    return known->second.get();
  }
  /// For the journal.
  Asked asked() const { return {client_, number_ > 0 ? 1u : 0u, static_cast<std::uint32_t>(number_)}; }

 private:
  struct Text final : language::TextSource {
    std::string bytes;
    language::ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
      return language::StringSource(bytes).read(offset, buffer, capacity);
    }
  };

  std::unique_ptr<Text> read(const std::string& call) {
    idl::program::ProgramRequest request{};
    request.operation = idl::program::Operation::RESOLVE;
    request.name = call;
    const auto found = ask(request);
    if (!found || !found->accepted || found->entry.size > largest) return nullptr;
    auto text = std::make_unique<Text>();
    request.operation = idl::program::Operation::READ;
    request.name = found->entry.name;
    request.revision = found->entry.revision;
    request.length = part;
    while (text->bytes.size() < found->entry.size) {
      request.offset = text->bytes.size();
      const auto reply = ask(request);
      if (!reply || !reply->accepted || reply->data.empty()) return nullptr;
      text->bytes.append(reply->data.begin(), reply->data.end());
    }
    return text;
  }

  std::optional<Reply> ask(idl::program::ProgramRequest request) {
    request.client = client_;
    request.number = ++number_;
    const auto answer = std::make_shared<std::promise<std::optional<Reply>>>();
    auto coming = answer->get_future();
    mailbox_.post([request, answer](Links& links, double now) {
      links.program.submit(
          request, [answer](const auto&, const auto& reply) { answer->set_value(reply); }, now);
    });
    // A mailbox that is not emptied any more answers nothing.
    if (coming.wait_for(std::chrono::seconds(3)) != std::future_status::ready) return {};
    return coming.get();
  }

  Mailbox& mailbox_;
  std::uint64_t client_ = service::make_client_id(), number_ = 0;
  std::map<std::string, std::unique_ptr<Text>> texts_;
};

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
    machine.configure(machine::parameters_of(*snapshot.parameters));
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
