// SPDX-License-Identifier: Apache-2.0
#include "mtconnect/request.hpp"

#include <cctype>
#include <charconv>
#include <map>
#include <set>

#include "core/router.hpp"
#include "mtconnect/documents.hpp"

namespace trunnion::gateway::mtconnect {
namespace {

constexpr std::size_t longest_path = 1024;
constexpr std::int64_t longest_interval = 3600000;  // ms

RequestError invalid(const std::string& text) { return {400, "INVALID_REQUEST", text}; }

std::int64_t whole(const std::string& name, const std::string& text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw invalid(name + " must be a whole number, not '" + text + "'");
  return value;
}

std::int64_t within(const std::string& name, const std::string& text, std::int64_t least, std::int64_t most) {
  const auto value = whole(name, text);
  if (value < least || value > most)
    throw RequestError(
        400, "OUT_OF_RANGE",
        name + " must be " + std::to_string(least) + " .. " + std::to_string(most) + ", not " + text);
  return value;
}

std::vector<std::string> parts_of(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::map<std::string, std::string> parameters_of(std::string_view query) {
  std::map<std::string, std::string> parameters;
  if (query.empty()) return parameters;
  for (const auto& pair : parts_of(query, '&')) {
    const auto equals = pair.find('=');
    std::string value;
    if (equals == std::string::npos || equals == 0 ||
        !percent_decode(std::string_view(pair).substr(equals + 1), value, true))
      throw invalid("'" + pair + "' is no parameter of the form name=value");
    if (!parameters.emplace(pair.substr(0, equals), value).second)
      throw invalid("the parameter " + pair.substr(0, equals) + " is given twice");
  }
  return parameters;
}

// Within predicates, XPath can look at every node for every node for every node: what is left of it here
// takes time in proportion to the square of the device's nodes at most.
void check_path(std::string_view path) {
  const auto refuse = [&](const std::string& why) {
    throw RequestError(400, "INVALID_PATH", "the path '" + std::string(path) + "' " + why);
  };
  if (path.empty() || path.size() > longest_path)
    throw RequestError(400, "INVALID_PATH", "a path has 1 to 1024 bytes");
  // And what may be before a parenthesis besides.
  static const std::set<std::string_view> functions = {"",    "and", "contains", "last",        "node",
                                                       "not", "or",  "position", "starts-with", "text"};
  const auto name_before = [&](std::size_t end) {
    while (end > 0 && path[end - 1] == ' ') --end;
    std::size_t begin = end;
    const auto of_name = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
    };
    while (begin > 0 && of_name(path[begin - 1])) --begin;
    return path.substr(begin, end - begin);
  };
  bool predicate = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const char c = path[i];
    if (c == '"' || c == '\'') {
      i = path.find(c, i + 1);
      if (i == std::string_view::npos) refuse("has a text without an end");
    } else if (c == '[') {
      if (predicate) refuse("has a predicate within a predicate");
      predicate = true;
    } else if (c == ']') {
      predicate = false;
    } else if (predicate && (c == '/' || c == ':' || c == '*' || c == '|')) {
      refuse("looks at other nodes in a predicate: attributes, texts and positions can be compared there");
    } else if (c == '(' && !functions.contains(name_before(i))) {
      refuse("calls " + std::string(name_before(i)) +
             ": contains, last, not, position, starts-with and text can be called");
    } else if (std::isspace(static_cast<unsigned char>(c)) != 0 && c != ' ') {
      refuse("has a line break or tab");
    }
  }
}

}  // namespace

Request parse_request(std::string_view method, std::string_view target, const std::string& device,
                      const std::string& uuid, std::size_t buffer_size) {
  if (method != "GET")
    throw RequestError(405, "UNSUPPORTED", "this agent only answers GET, not " + std::string(method));
  const auto mark = target.find('?');
  const auto given = parts_of(target.substr(0, mark), '/');
  std::vector<std::string> parts;
  for (const auto& one : given) {
    std::string decoded;
    if (!percent_decode(one, decoded))
      throw RequestError(404, "INVALID_URI", "'" + one + "' does not decode");
    if (!decoded.empty()) parts.push_back(std::move(decoded));
  }
  Request request;
  const auto known = [](const std::string& word) {
    return word == "probe" || word == "current" || word == "sample" || word == "assets" || word == "asset";
  };
  if (!parts.empty() && !known(parts.front())) {
    if (parts.front() != device && parts.front() != uuid)
      throw RequestError(404, parts.size() == 1 || known(parts[1]) ? "NO_DEVICE" : "INVALID_URI",
                         "there is no device '" + parts.front() + "'; this agent has " + device);
    parts.erase(parts.begin());
  }
  std::string word = "probe";
  if (!parts.empty()) {
    word = parts.front();
    parts.erase(parts.begin());
  }
  if (word == "asset") word = "assets";
  const bool assets = word == "assets";
  if (!known(word) || parts.size() > (assets ? 1u : 0u))
    throw RequestError(404, "INVALID_URI", "this agent answers probe, current, sample and assets");
  request.kind = word == "probe"     ? Kind::probe
                 : word == "current" ? Kind::current
                 : word == "sample"  ? Kind::sample
                                     : Kind::assets;
  if (!parts.empty())
    for (const auto& id : parts_of(parts.front(), ';'))
      if (!id.empty()) request.assets.push_back(id);
  const auto size = static_cast<std::int64_t>(buffer_size);
  const auto query = mark == std::string_view::npos ? std::string_view() : target.substr(mark + 1);
  for (const auto& [name, value] : parameters_of(query)) {
    const bool streams = request.kind == Kind::current || request.kind == Kind::sample;
    if (name == "path" && streams) {
      check_path(value);
      request.path = value;
    } else if (name == "at" && request.kind == Kind::current) {
      request.at = static_cast<std::uint64_t>(within(name, value, 0, INT64_MAX));
    } else if (name == "from" && request.kind == Kind::sample) {
      request.from = static_cast<std::uint64_t>(within(name, value, 0, INT64_MAX));
    } else if (name == "count" && request.kind == Kind::sample) {
      request.count = within(name, value, -size, size);
      if (request.count == 0) throw RequestError(400, "OUT_OF_RANGE", "count must not be 0");
    } else if (name == "count" && assets) {
      request.count = within(name, value, 1, INT32_MAX);
    } else if (name == "interval" && streams) {
      request.interval = static_cast<std::uint32_t>(within(name, value, 0, longest_interval));
    } else if (name == "heartbeat" && request.kind == Kind::sample) {
      request.heartbeat = static_cast<std::uint32_t>(within(name, value, 10, longest_interval));
    } else if (name == "type" && assets) {
      request.type = value;
    } else if (name == "removed" && assets) {
      request.removed = value == "true";
    } else if (name != "deviceType" && name != "pretty") {
      throw invalid(std::string(word).append(" has no parameter '").append(name).append("'"));
    }
  }
  if (request.at && request.interval) throw invalid("at and interval exclude each other");
  if (request.count < 0 && request.interval)
    throw invalid("a negative count and interval exclude each other");
  return request;
}

}  // namespace trunnion::gateway::mtconnect
