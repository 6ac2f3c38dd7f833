// SPDX-License-Identifier: Apache-2.0
#include "core/recording_table.hpp"

#include <charconv>

#include "bus/codec.hpp"
#include "bus/registry.hpp"
#include "contracts/topics.hpp"

namespace trunnion::gateway {
namespace {

template <class Number>
void append(std::string& text, Number value) {
  char digits[40];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace

RecordingTable::RecordingTable(std::unique_ptr<recording::Source> source)
    : source_(std::move(source)), reader_(*source_) {}

void RecordingTable::add(const idl::stream::Feedback& batch) {
  const std::size_t columns = batch.axis_count, rows = batch.count;
  if (rows == 0 || columns == 0) return;
  if (batch.commanded.size() < rows * columns || batch.actual.size() < rows * columns) return;
  if (columns_ == 0) {
    columns_ = batch.axis_count;
    text_ += "cycle";
    for (const char* name : {"commanded", "actual", "velocity", "torque"})
      for (std::size_t i = 0; i < columns; ++i) {
        text_.append(",").append(name).append("[");
        append(text_, i);
        text_ += ']';
      }
    text_ += '\n';
  }
  if (columns != columns_) return;
  for (std::size_t row = 0; row < rows; ++row) {
    append(text_, batch.first + row);
    for (const auto* values : {&batch.commanded, &batch.actual})
      for (std::size_t i = 0; i < columns; ++i) {
        text_ += ',';
        append(text_, (*values)[row * columns + i]);
      }
    for (const auto* values : {&batch.velocity, &batch.torque})
      for (std::size_t i = 0; i < columns; ++i) {
        text_ += ',';
        if (row + 1 == rows && i < values->size()) append(text_, (*values)[i]);
      }
    text_ += '\n';
  }
}

bool RecordingTable::read() {
  recording::MessageView message;
  idl::stream::Feedback batch;
  if (!reader_.next(message)) return false;
  const auto& channel = *message.channel;
  if (channel.topic != topics::feedback.name) return true;
  if (channel_ != channel.id) {
    const auto schema = reader_.schemas().find(channel.schema);
    if (schema == reader_.schemas().end() || schema->second.data != bus::find_topic(channel.topic)->schema)
      return true;
    channel_ = channel.id;
  }
  if (bus::decode(message.data, batch)) add(batch);
  return true;
}

bool RecordingTable::begin() {
  while (columns_ == 0)
    if (!read()) return false;
  return true;
}

std::optional<std::string> RecordingTable::next() {
  while (text_.size() < part_bytes && read()) {
  }
  std::string part;
  std::swap(part, text_);
  return part;
}

}  // namespace trunnion::gateway
