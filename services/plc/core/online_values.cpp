// SPDX-License-Identifier: Apache-2.0
#include "online_values.hpp"

#include <algorithm>
#include <stdexcept>

#include "plc/syntax/token.hpp"
#include "plc/tools/value_text.hpp"
#include "text/utf8.hpp"

namespace trunnion::plc {
namespace {

constexpr std::size_t most_reply_bytes = 48000;  // of the descriptions in one reply
constexpr std::size_t most_listed = 256;
constexpr std::size_t most_reply_cells = 6000;

std::size_t size_of(const idl::plc::VariableInfo& info) {
  std::size_t size = 64 + info.path.size() + info.type.size() + info.unit.size();
  for (const auto& name : info.names) size += 24 + name.name.size();
  return size;
}

void describe(const std::vector<st::Location>& elements, idl::plc::OnlineReply& reply) {
  std::size_t size = 0;
  for (const auto& at : elements) {
    reply.variables.push_back(info_of(at));
    size += size_of(reply.variables.back());
  }
  if (size > most_reply_bytes)
    throw std::runtime_error("the names of these variables take " + std::to_string(size) +
                             " bytes; at most " + std::to_string(most_reply_bytes) + " fit; name fewer");
}

std::size_t cells_of(const std::vector<ValuePlace>& places) {
  std::size_t cells = 0;
  for (const auto& place : places) cells += place.cells;
  return cells;
}

}  // namespace

std::vector<st::Location> OnlineValues::elements_of(const std::vector<std::string>& paths) const {
  if (paths.empty()) throw std::runtime_error("name at least one variable");
  std::vector<st::Location> elements;
  for (const auto& path : paths) {
    const auto found = variables_.elements(path);
    elements.insert(elements.end(), found.begin(), found.end());
  }
  if (elements.size() > most_watched)
    throw std::runtime_error("these are " + std::to_string(elements.size()) + " variables; at most " +
                             std::to_string(most_watched) + " are read at once");
  return elements;
}

idl::plc::OnlineReply OnlineValues::answer(const idl::plc::OnlineRequest& request, PlcCore& core,
                                           double now) {
  using idl::plc::OnlineAction;
  idl::plc::OnlineReply reply;
  try {
    switch (request.action) {
      case OnlineAction::LIST_VARIABLES:
        list(request, reply);
        break;
      case OnlineAction::WATCH:
        watch(request, reply, now);
        break;
      case OnlineAction::END_WATCH:
        for (std::size_t i = 0; i < watch_slots; ++i)
          if (watches_[i] && watches_[i]->sample.client == request.client)
            watches_[i].reset(), freed_[i] = true;
        break;
      case OnlineAction::START_TRACE:
        start_trace(request, reply, core);
        break;
      case OnlineAction::READ_TRACE:
        read_trace(request, reply);
        break;
      case OnlineAction::END_TRACE:
        if (trace_ && trace_->client == request.client) end_trace(core);
        break;
      default:
        throw std::runtime_error("this is not asked of values");
    }
    reply.accepted = true;
  } catch (const std::runtime_error& e) {
    reply = {};
    reply.reason = text::shortened(e.what(), 256);
  }
  return reply;
}

void OnlineValues::list(const idl::plc::OnlineRequest& request, idl::plc::OnlineReply& reply) const {
  const auto prefix = request.paths.empty() ? std::string() : st::upper_case(request.paths[0]);
  std::size_t size = 0;
  bool full = false;
  for (const auto& at : variables_.all()) {
    if (!st::upper_case(at.path).starts_with(prefix)) continue;
    if (reply.total++ < request.first || full) continue;
    auto info = info_of(at);
    size += size_of(info);
    full = size > most_reply_bytes || reply.variables.size() == most_listed;
    if (!full) reply.variables.push_back(std::move(info));
  }
}

void OnlineValues::fill(Watch& watch) {
  watch.elements = elements_of(watch.paths);
  watch.places.clear();
  for (const auto& at : watch.elements) watch.places.push_back(place_of(at));
  const auto cells = cells_of(watch.places);
  if (cells > most_watched_cells)
    throw std::runtime_error("these variables take " + std::to_string(cells) + " cells of 64 bits; at most " +
                             std::to_string(most_watched_cells) + " are watched at once");
  watch.sample.cells.assign(cells, 0);
  watch.sample.forced.reserve(watch.places.size());
  watch.last.cells.reserve(cells);
  watch.last.forced.reserve(watch.places.size());
  watch.written = false;
}

void OnlineValues::watch(const idl::plc::OnlineRequest& request, idl::plc::OnlineReply& reply, double now) {
  auto slot = watch_slots;
  for (std::size_t i = watch_slots; i-- > 0;)
    if (!watches_[i]) slot = i;
  for (std::size_t i = 0; i < watch_slots; ++i)
    if (watches_[i] && watches_[i]->sample.client == request.client) slot = i;
  if (slot == watch_slots)
    throw std::runtime_error(std::to_string(watch_slots) +
                             " clients watch variables already; end one of them");
  auto& place = watches_[slot];
  if (!place || place->paths != request.paths) {
    Watch fresh;
    fresh.paths = request.paths;
    fill(fresh);
    fresh.sample.slot = static_cast<std::uint8_t>(slot);
    fresh.sample.client = request.client;
    fresh.sample.number = request.number;
    describe(fresh.elements, reply);
    place = std::move(fresh);
  } else {
    describe(place->elements, reply);
    place->sample.number = request.number;
    place->written = false;
  }
  place->until = now + watch_lifetime;
  reply.slot = static_cast<std::uint8_t>(slot);
}

void OnlineValues::expire(double now) {
  for (std::size_t i = 0; i < watch_slots; ++i)
    if (watches_[i] && watches_[i]->until < now) watches_[i].reset(), freed_[i] = true;
}

const idl::plc::Watched* OnlineValues::watched(std::size_t slot, const Memory& memory) {
  if (!watches_[slot]) {
    if (!freed_[slot]) return nullptr;
    freed_[slot] = false;
    empty_.slot = static_cast<std::uint8_t>(slot);
    return &empty_;
  }
  auto& watch = *watches_[slot];
  auto& sample = watch.sample;
  auto to = std::span(sample.cells);
  sample.forced.clear();
  for (std::size_t i = 0; i < watch.places.size(); ++i) {
    copy_value(memory, watch.places[i], to);
    to = to.subspan(watch.places[i].cells);
    for (std::uint32_t f = 0; f < memory.forces.count; ++f)
      if (memory.forces.values[f].cell == watch.places[i].cell &&
          memory.forces.values[f].bit == watch.elements[i].bit)
        sample.forced.push_back(static_cast<std::uint16_t>(i));
  }
  if (watch.written && sample.cells == watch.last.cells && sample.forced == watch.last.forced) return nullptr;
  sample.scan = memory.scans, sample.tick = memory.tick;
  watch.last.cells = sample.cells, watch.last.forced = sample.forced;
  watch.written = true;
  return &sample;
}

void OnlineValues::start_trace(const idl::plc::OnlineRequest& request, idl::plc::OnlineReply& reply,
                               PlcCore& core) {
  if (trace_ && trace_->client != request.client && !trace_->scans.complete())
    throw std::runtime_error("another client traces; wait until its trace ends");
  const auto elements = elements_of(request.paths);
  std::vector<ValuePlace> places;
  for (const auto& at : elements) places.push_back(place_of(at));
  const auto width = trace_time_cells + cells_of(places);
  if (width > most_reply_cells)
    throw std::runtime_error("these variables take " + std::to_string(width) +
                             " cells of 64 bits; a row has " + std::to_string(most_reply_cells) + " at most");
  if (request.scans == 0 || request.scans > most_trace_cells / width)
    throw std::runtime_error(std::to_string(request.scans) +
                             " scans: with these variables a trace has 1 .. " +
                             std::to_string(most_trace_cells / width));
  ScanTrace::Condition condition{request.condition, {}, {}, 0};
  if (condition.kind != idl::plc::TraceCondition::AT_ONCE) {
    const auto at = variables_.find_elementary(request.condition_path);
    if (at.type->kind == st::Kind::string)
      throw std::runtime_error("'" + at.path + "': it is " + at.type->name +
                               "; a trace begins at a number or a bit");
    if (condition.kind != idl::plc::TraceCondition::CHANGED) {
      try {
        st::set_value(*at.type, request.condition_value, std::span(&condition.value, 1));
      } catch (const std::runtime_error& e) {
        throw std::runtime_error("'" + at.path + "': " + e.what());
      }
    }
    condition.place = place_of(at);
    condition.value_kind = info_of(at).kind;
  }
  describe(elements, reply);
  end_trace(core);
  trace_.emplace(Trace{request.client, request.number, {places, request.scans, condition}});
  core.set_trace(&trace_->scans);
}

void OnlineValues::read_trace(const idl::plc::OnlineRequest& request, idl::plc::OnlineReply& reply) const {
  if (!trace_ || trace_->client != request.client)
    throw std::runtime_error(
        "there is no trace of this client; a restart of the PLC or other programs end it");
  const auto& scans = trace_->scans;
  reply.total = scans.rows();
  reply.complete = scans.complete();
  for (auto row = request.first; row < scans.rows() && reply.cells.size() + scans.width() <= most_reply_cells;
       ++row) {
    const auto values = scans.row(row);
    reply.cells.insert(reply.cells.end(), values.begin(), values.end());
  }
}

void OnlineValues::end_trace(PlcCore& core) {
  core.set_trace(nullptr);
  trace_.reset();
}

void OnlineValues::replace(st::Variables variables, PlcCore& core) {
  end_trace(core);
  variables_ = std::move(variables);
  for (std::size_t i = 0; i < watch_slots; ++i) {
    if (!watches_[i]) continue;
    try {
      const auto before = watches_[i]->elements.size();
      fill(*watches_[i]);
      if (watches_[i]->elements.size() == before) continue;
    } catch (const std::runtime_error&) {
    }
    watches_[i].reset(), freed_[i] = true;
  }
}

}  // namespace trunnion::plc
