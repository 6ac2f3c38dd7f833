// SPDX-License-Identifier: Apache-2.0
#include "programs/stored_texts.hpp"

#include <chrono>
#include <future>

namespace trunnion::gateway {

StoredTexts::Text* StoredTexts::find(std::string_view call) {
  const auto [known, added] = texts_.try_emplace(std::string(call));
  if (added) known->second = read(known->first);
  return known->second.get();
}

std::unique_ptr<StoredTexts::Text> StoredTexts::read(const std::string& call) {
  idl::program::ProgramRequest request{};
  request.operation = idl::program::Operation::RESOLVE;
  request.name = call;
  const auto found = ask(request);
  if (!found || !found->accepted || found->entry.size > largest) return nullptr;
  auto text = std::make_unique<Text>();
  text->entry = found->entry;
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

std::optional<StoredTexts::Reply> StoredTexts::ask(idl::program::ProgramRequest request) {
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

}  // namespace trunnion::gateway
