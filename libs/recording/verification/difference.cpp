// SPDX-License-Identifier: Apache-2.0
#include "verification/difference.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "verification/batch_rows.hpp"

namespace trunnion::verification {
namespace {

using Messages = std::vector<StoredMessage>;

constexpr std::uint64_t shown_rows = 3;  // before and after the first difference, as text

// In the order of the stream; then what is published when it changes and not by the clock.
const std::vector<std::string>& default_topics() {
  static const std::vector<std::string> handles = {
      "path_batch",     "kinematics_batch", "compensation_batch", "gantry_batch", "feedback",
      "stream_request", "parameter_set",    "tool_table",         "work_offsets", "auxiliary_request",
      "auxiliary_done", "macro_signal",     "cycle_request",      "cycle_reply",  "alarm"};
  return handles;
}

// One row: of a batch, or a whole message.
struct Point {
  std::uint64_t series = 0, index = 0;
  std::uint32_t epoch = 0;
  std::uint32_t row = 0;
  const StoredMessage* message = nullptr;
};

std::uint64_t series_of(const StoredMessage& message) {
  bus::KeyHash key{};
  if (!message.topic->description.keyed || !message.topic->description.key_of(message.cdr, key)) return 0;
  std::uint64_t series = 1469598103934665603u;  // FNV-1a: keys are longer than a number
  for (const auto byte : key) series = (series ^ byte) * 1099511628211u;
  return series;
}

std::vector<Point> points_of(const Messages& messages, const bus::TopicEntry& topic) {
  std::vector<Point> points;
  MessageRows rows;
  std::map<std::uint64_t, std::pair<std::uint64_t, const StoredMessage*>> last;
  for (const auto& message : messages) {
    if (message.topic != &topic) continue;
    if (is_cyclic(topic)) {
      if (!rows.load(topic, message.cdr)) continue;
      for (std::uint32_t i = 0; i < rows.rows(); ++i)
        points.push_back({rows.span().channel, rows.span().first + i, rows.span().epoch, i, &message});
      continue;
    }
    const auto series = series_of(message);
    auto& [count, before] = last[series];
    if (before != nullptr && topic.qos == bus::QosKind::state && before->cdr == message.cdr) continue;
    points.push_back({series, count++, 0, 0, &message});
    before = &message;
  }
  const auto order = [](const Point& p) { return std::tuple(p.series, p.index, ~p.epoch); };
  std::stable_sort(points.begin(), points.end(),
                   [&](const Point& a, const Point& b) { return order(a) < order(b); });
  points.erase(
      std::unique(points.begin(), points.end(),
                  [](const Point& a, const Point& b) { return a.series == b.series && a.index == b.index; }),
      points.end());
  return points;
}

// Decodes a message once for all its rows.
class RowCache {
 public:
  explicit RowCache(bool spindles) : spindles_(spindles) {}
  const std::vector<Field>& fields(const Point& point) {
    if (point.message != message_) {
      good_ = rows_.load(*point.message->topic, point.message->cdr);
      message_ = point.message;
    }
    if (!good_) {
      fields_ = {{"undecodable", true, false}};
      return fields_;
    }
    rows_.fields(point.row, fields_);
    if (spindles_) rows_.append_spindles(point.row, fields_);
    return fields_;
  }

 private:
  const bool spindles_;
  MessageRows rows_;
  const StoredMessage* message_ = nullptr;
  bool good_ = false;
  std::vector<Field> fields_;
};

std::string text_of_value(const bus::Json& value) {
  if (value.is_number_float()) return fmt::format("{:.17g}", value.get<double>());
  return bus::text_of(value);
}

class Comparison {
 public:
  Comparison(const Messages& a, const Messages& b, const DiffOptions& options)
      : a_(a), b_(b), options_(options) {}

  Difference run() {
    std::vector<std::string> handles;
    for (const auto& handle : default_topics())
      if (options_.topics.empty() || options_.topics.contains(handle)) handles.push_back(handle);
    for (const auto& handle : options_.topics)
      if (std::find(handles.begin(), handles.end(), handle) == handles.end()) handles.push_back(handle);
    for (const auto& handle : handles) {
      const auto* topic = bus::find_topic(handle);
      if (topic == nullptr) throw std::runtime_error("unknown topic '" + handle + "'");
      compare(*topic);
    }
    return std::move(out_);
  }

 private:
  void compare(const bus::TopicEntry& topic) {
    const auto a = points_of(a_, topic), b = points_of(b_, topic);
    if (a.empty() && b.empty()) return;
    TopicDifference d;
    d.topic = topic.handle;
    d.cyclic = is_cyclic(topic);
    std::optional<Candidate> first;
    std::size_t i = 0, k = 0;
    while (i < a.size() || k < b.size()) {
      const bool has_a = i < a.size(), has_b = k < b.size();
      const auto place = [](const Point& p) { return std::pair(p.series, p.index); };
      if (has_a && has_b && place(a[i]) == place(b[k])) {
        compare_rows(a[i], b[k], d, first);
        ++d.compared;
        ++i, ++k;
        continue;
      }
      const bool from_a = has_a && (!has_b || place(a[i]) < place(b[k]));
      const Point& lonely = from_a ? a[i++] : b[k++];
      if (options_.common) continue;
      if (d.only_a + d.only_b == 0 || lonely.index < d.first_only) d.first_only = lonely.index;
      ++(from_a ? d.only_a : d.only_b);
      propose(first, {lonely, lonely, ""});
    }
    if (d.cyclic) out_.cycles += d.compared;
    // A cycle orders the whole stream; numbers of messages mean something within their topic only.
    if (first && (!out_.first || (d.cyclic && out_.first->cyclic && first->a.index < out_.first->index)))
      out_.first = describe(topic, *first, a, b);
    out_.topics.push_back(std::move(d));
  }

  struct Candidate {
    Point a, b;
    std::string field;  // empty: only one side has the row
  };
  static void propose(std::optional<Candidate>& first, const Candidate& candidate) {
    if (!first || candidate.a.index < first->a.index) first = candidate;
  }

  bool same(const std::string& name, const bus::Json& a, const bus::Json& b, double& off) const {
    off = 0;
    if (!a.is_number_float() || !b.is_number_float()) return a == b;
    const double x = a.get<double>(), y = b.get<double>();
    if (std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y)) return true;
    off = std::abs(x - y);
    const double* tolerance = nullptr;
    for (const auto& [prefix, value] : options_.tolerances)  // ascending: a longer prefix comes later
      if (name.starts_with(prefix)) tolerance = &value;
    return tolerance != nullptr && off <= *tolerance;
  }

  void compare_rows(const Point& a, const Point& b, TopicDifference& d, std::optional<Candidate>& first) {
    if (a.row == b.row && a.message->cdr == b.message->cdr) return;
    const auto& left = cache_a_.fields(a);
    const auto& right = cache_b_.fields(b);
    const auto differs = [&](const std::string& name, double off) {
      if (options_.ignored.contains(d.topic + "." + name)) return;
      auto& field = d.fields[name];
      if (field.count++ == 0) field.first_index = a.index;
      field.first_index = std::min(field.first_index, a.index);
      if (!(off <= field.largest)) field.largest = off, field.largest_index = a.index;
      propose(first, {a, b, name});
    };
    const auto find = [](const std::vector<Field>& fields, std::size_t near,
                         const std::string& name) -> const Field* {
      if (near < fields.size() && fields[near].name == name) return &fields[near];
      const auto found =
          std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
      return found == fields.end() ? nullptr : &*found;
    };
    double off = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const auto* other = find(right, i, left[i].name);
      if (other != nullptr && left[i].moment != other->moment) continue;
      if (other != nullptr ? !same(left[i].name, left[i].value, other->value, off) : !left[i].at_batch_end)
        differs(left[i].name, off);
    }
    for (std::size_t i = 0; i < right.size(); ++i)
      if (!right[i].at_batch_end && find(left, i, right[i].name) == nullptr) differs(right[i].name, 0);
  }

  // What a side has of the field at this place.
  static std::string value_at(RowCache& cache, const std::vector<Point>& points, std::uint64_t series,
                              std::uint64_t index, const std::string& field) {
    const auto found = std::lower_bound(
        points.begin(), points.end(), std::pair(series, index),
        [](const Point& p, const auto& place) { return std::pair(p.series, p.index) < place; });
    if (found == points.end() || found->series != series || found->index != index) return "";
    if (field.empty()) return "present";
    for (const auto& f : cache.fields(*found))
      if (f.name == field) return text_of_value(f.value);
    return "";
  }

  FirstDifference describe(const bus::TopicEntry& topic, const Candidate& candidate,
                           const std::vector<Point>& a, const std::vector<Point>& b) {
    FirstDifference first;
    first.topic = topic.handle;
    first.field = candidate.field;
    if (topic.handle == "feedback") first.meaning = meaning_of(candidate.field);
    first.cyclic = is_cyclic(topic);
    first.index = candidate.a.index;
    if (first.cyclic)
      first.series = topic.handle == "feedback" ? "" : "channel " + std::to_string(candidate.a.series);
    for (int i = -options_.around; i <= options_.around; ++i) {
      if (i < 0 && first.index < static_cast<std::uint64_t>(-i)) continue;
      Neighbour n{first.index + static_cast<std::uint64_t>(static_cast<std::int64_t>(i)), "", ""};
      n.a = value_at(cache_a_, a, candidate.a.series, n.index, candidate.field);
      n.b = value_at(cache_b_, b, candidate.a.series, n.index, candidate.field);
      if (!n.a.empty() || !n.b.empty()) first.around.push_back(std::move(n));
    }
    return first;
  }

  const Messages &a_, &b_;
  const DiffOptions& options_;
  RowCache cache_a_{options_.spindles}, cache_b_{options_.spindles};
  Difference out_;
};

}  // namespace

Difference difference(const Messages& a, const Messages& b, const DiffOptions& options) {
  return Comparison(a, b, options).run();
}

void add_tolerance(DiffOptions& options, const std::string& text) {
  const auto at = text.find('=');
  const auto number = at == std::string::npos ? text : text.substr(at + 1);
  std::size_t used = 0;
  double value = -1;
  try {
    value = std::stod(number, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != number.size() || !(value >= 0))
    throw std::runtime_error("tolerance '" + text + "': a number from 0 on, or FIELD=NUMBER");
  options.tolerances[at == std::string::npos ? "" : text.substr(0, at)] = value;
}

std::string text_of(const Difference& d, const std::string& a, const std::string& b) {
  std::string text;
  for (const auto& t : d.topics) {
    text += fmt::format("{:<20} {:10} {} compared", t.topic, t.compared, t.cyclic ? "cycles" : "messages");
    if (t.equal()) text += ", equal";
    if (t.only_a != 0) text += ", " + std::to_string(t.only_a) + " only in " + a;
    if (t.only_b != 0) text += ", " + std::to_string(t.only_b) + " only in " + b;
    text += "\n";
    for (const auto& [name, field] : t.fields)
      text += fmt::format("    {:<24} differs {} times, first at {}, largest {:.3g} at {}\n", name,
                          field.count, field.first_index, field.largest, field.largest_index);
  }
  if (!d.first) return text + (d.topics.empty() ? "nothing to compare\n" : "equal\n");
  const auto& f = *d.first;
  text += "first difference: " + f.topic + (f.series.empty() ? "" : ", " + f.series) +
          (f.cyclic ? ", cycle " : ", message ") + std::to_string(f.index) +
          (f.field.empty() ? ", only in one of them" : ", " + f.field) +
          (f.meaning.empty() ? "" : " (" + f.meaning + ")") + "\n";
  text += fmt::format("    {:>12}  {:<26} {:<26}\n", f.cyclic ? "cycle" : "message", a, b);
  for (const auto& n : f.around) {
    if (n.index + shown_rows < f.index || n.index > f.index + shown_rows) continue;
    text += fmt::format("  {} {:12}  {:<26} {:<26}\n", n.index == f.index ? '>' : ' ', n.index,
                        n.a.empty() ? "-" : n.a, n.b.empty() ? "-" : n.b);
  }
  return text;
}

bus::Json json_of(const Difference& d) {
  bus::Json topics = bus::Json::array();
  for (const auto& t : d.topics) {
    bus::Json fields = bus::Json::object();
    for (const auto& [name, field] : t.fields)
      fields[name] = {{"count", field.count},
                      {"first", field.first_index},
                      {"largest", field.largest},
                      {"largest_at", field.largest_index}};
    topics.push_back({{"topic", t.topic},
                      {"compared", t.compared},
                      {"only_a", t.only_a},
                      {"only_b", t.only_b},
                      {"fields", fields}});
  }
  bus::Json out = {{"equal", d.equal()}, {"topics", topics}};
  if (d.first) {
    bus::Json around = bus::Json::array();
    for (const auto& n : d.first->around) around.push_back({{"index", n.index}, {"a", n.a}, {"b", n.b}});
    out["first"] = {{"topic", d.first->topic},
                    {"series", d.first->series},
                    {d.first->cyclic ? "cycle" : "message", d.first->index},
                    {"field", d.first->field},
                    {"meaning", d.first->meaning},
                    {"around", around}};
  }
  return out;
}

}  // namespace trunnion::verification
