// SPDX-License-Identifier: Apache-2.0
#include "verification/csv.hpp"

#include <cstdio>
#include <string>
#include <unordered_map>

#include "bus/json.hpp"
#include "text/instant.hpp"
#include "verification/batch_rows.hpp"

namespace trunnion::verification {
namespace {

std::string cell(const bus::Json& value) {
  if (value.is_number_float()) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value.get<double>());
    return text;
  }
  if (!value.is_string()) return bus::text_of(value);
  const auto& text = value.get_ref<const std::string&>();
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

template <class Visit>
void for_each_row(const StoredRecording& recording, const bus::TopicEntry& topic, Visit visit) {
  MessageRows rows;
  std::vector<Field> fields;
  for (const auto& message : recording.messages) {
    if (message.topic != &topic || !rows.load(topic, message.cdr)) continue;
    for (std::size_t i = 0; i < rows.rows(); ++i) {
      rows.fields(i, fields);
      rows.append_spindles(i, fields);
      rows.append_uncompared(i, fields);
      visit(message, rows.span(), i, fields);
    }
  }
}

}  // namespace

std::size_t write_csv(const StoredRecording& recording, const bus::TopicEntry& topic, std::ostream& out) {
  std::vector<std::string> columns;
  std::unordered_map<std::string, std::size_t> place;
  for_each_row(recording, topic,
               [&](const auto&, const auto&, std::size_t, const std::vector<Field>& fields) {
                 for (const auto& field : fields)
                   if (place.emplace(field.name, columns.size()).second) columns.push_back(field.name);
               });
  const bool cyclic = is_cyclic(topic);
  out << (cyclic ? "cycle,channel,epoch" : "time_ns");
  for (const auto& column : columns) out << ',' << cell(column);
  out << ",time_utc\n";
  std::size_t lines = 0;
  std::vector<std::string> cells(columns.size());
  for_each_row(recording, topic,
               [&](const StoredMessage& message, const BatchSpan& span, std::size_t row,
                   const std::vector<Field>& fields) {
                 for (auto& text : cells) text.clear();
                 for (const auto& field : fields) cells[place.at(field.name)] = cell(field.value);
                 if (cyclic)
                   out << span.first + row << ',' << span.channel << ',' << span.epoch;
                 else
                   out << message.time;
                 for (const auto& text : cells) out << ',' << text;
                 out << ',' << text::instant(message.time, 9) << '\n';
                 ++lines;
               });
  return lines;
}

}  // namespace trunnion::verification
