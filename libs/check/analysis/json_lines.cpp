// SPDX-License-Identifier: Apache-2.0
#include "analysis/json_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <ostream>

#include "analysis/foreign_text.hpp"

namespace trunnion::analysis {
namespace {

using language::CommandKind;

std::string_view kind_name(CommandKind kind) {
  if (kind == CommandKind::rapid) return "rapid";
  return kind == CommandKind::arc ? "arc" : "line";
}

std::string_view plane_name(language::Plane plane) {
  if (plane == language::Plane::zx) return "ZX";
  return plane == language::Plane::yz ? "YZ" : "XY";
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      result += escape;
    } else {
      result += c;
    }
  }
  return result + '"';
}

void JsonLines::flush() {
  out_.write(buffer_.data(), static_cast<std::streamsize>(size_));
  out_.flush();
  size_ = 0;
}

void JsonLines::make_room() {
  if (buffer_.size() - size_ >= room) return;
  out_.write(buffer_.data(), static_cast<std::streamsize>(size_));
  size_ = 0;
}

void JsonLines::put(std::string_view text) {
  std::copy(text.begin(), text.end(), buffer_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += text.size();
}

void JsonLines::number(double value) {
  char* const begin = buffer_.data() + size_;
  size_ += static_cast<std::size_t>(std::to_chars(begin, begin + 32, value + 0.0).ptr - begin);
}

void JsonLines::whole(std::uint64_t value) {
  char* const begin = buffer_.data() + size_;
  size_ += static_cast<std::size_t>(std::to_chars(begin, begin + 32, value).ptr - begin);
}

void JsonLines::position(std::string_view key, const language::AxisValues& values) {
  put(key);
  char separator = '{';
  for (std::size_t axis = 0; axis < language::axis_count; ++axis) {
    if (((axes_ >> axis) & 1u) == 0) continue;
    const char name[] = {separator, '"', language::axis_letters[axis], '"', ':'};
    put({name, sizeof name});
    number(values[axis]);
    separator = ',';
  }
  put(separator == '{' ? "{}" : "}");
}

void JsonLines::vector(std::string_view key, const language::Vector3& values) {
  put(key);
  char separator = '[';
  for (const double value : values) {
    put({&separator, 1});
    number(value);
    separator = ',';
  }
  put("]");
}

void JsonLines::motion(const Motion& motion) {
  make_room();
  put("{\"n\":");
  whole(motion.line);
  put(",\"kind\":\"");
  put(kind_name(motion.kind));
  position("\",\"mcs\":", motion.mcs);
  position(",\"wcs\":", motion.wcs);
  put(",\"feed\":");
  if (motion.feed) {
    number(*motion.feed);
  } else {
    put("null");
  }
  if (motion.kind == CommandKind::arc) {
    vector(",\"center\":", motion.arc.centre);
    put(",\"plane\":\"");
    put(plane_name(motion.arc.plane));
    put(motion.arc.clockwise ? "\",\"cw\":true" : "\",\"cw\":false");
    put(",\"turns\":");
    whole(motion.turns);
    if (motion.arc.normal != language::Vector3{}) vector(",\"normal\":", motion.arc.normal);
  }
  put("}\n");
}

void JsonLines::end(const language::AxisValues& mcs) {
  make_room();
  put("{\"end\":true");
  position(",\"mcs\":", mcs);
  put("}\n");
  flush();
}

void JsonLines::error(const language::Alarm& alarm) {
  flush();
  const auto name = [](std::uint32_t program, const language::FileName& file) {
    return json_string(file.front() != '\0' ? std::string_view(file.data())
                                            : language::ProgramName(program).view());
  };
  out_ << "{\"error\":{\"line\":" << alarm.line << ",\"column\":" << alarm.column
       << ",\"number\":" << static_cast<unsigned>(alarm.number)
       << ",\"text\":" << json_string(alarm.text.data());
  if (alarm.foreign != nullptr) out_ << ",\"remedy\":" << json_string(foreign_text(*alarm.foreign));
  if (alarm.program != 0) out_ << ",\"program\":" << name(alarm.program, alarm.file_name);
  if (alarm.calls != 0) {
    out_ << ",\"called_from\":[";
    for (std::size_t i = alarm.calls; i-- > 0;) {
      out_ << "{\"line\":" << alarm.chain[i].line;
      if (alarm.chain[i].program != 0)
        out_ << ",\"program\":" << name(alarm.chain[i].program, alarm.chain[i].file);
      out_ << (i == 0 ? "}" : "},");
    }
    out_ << "]";
  }
  out_ << "}}\n" << std::flush;
}

}  // namespace trunnion::analysis
