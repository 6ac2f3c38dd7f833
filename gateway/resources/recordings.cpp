// SPDX-License-Identifier: Apache-2.0
#include "resources/recordings.hpp"

#include <chrono>
#include <ctime>
#include <sstream>
#include <thread>

#include "bus/registry.hpp"
#include "core/recording_table.hpp"
#include "core/requests.hpp"
#include "recording/disk_space.hpp"
#include "recording/file_stream.hpp"

namespace trunnion::gateway {
namespace fs = std::filesystem;
namespace {

using bus::Json;

constexpr double longest = 7 * 24 * 3600;  // s of a recording
constexpr std::size_t most_topics = 64;
constexpr auto time_to_begin = std::chrono::seconds(3);
constexpr double time_to_finish = 20;  // s for what still waits for the disk

std::string time_text(std::int64_t nanoseconds, const char* format) {
  const std::time_t seconds = nanoseconds / 1000000000;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[40];
  return {text, std::strftime(text, sizeof text, format, &parts)};
}

std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

struct StartRequest {
  std::string name;
  std::vector<std::string> arguments;
};

StartRequest start_request(const Json& body) {
  StartRequest request;
  for (const auto& [key, value] : body.items()) {
    if (key == "name") {
      if (!value.is_string() || !is_recording_name(value.get<std::string>()))
        throw BadRequest(
            "name", "name must be letters, digits, '.', '-' and '_', at most 100, with .mcap at the end");
      request.name = value;
    } else if (key == "duration") {
      if (!value.is_number() || !(value.get<double>() > 0) || value.get<double>() > longest)
        throw BadRequest("duration", "duration must be above 0 s, at most 604800 s");
      request.arguments.insert(request.arguments.end(), {"--duration", std::to_string(value.get<double>())});
    } else if (key == "topics") {
      if (!value.is_array() || value.empty() || value.size() > most_topics)
        throw BadRequest("topics", "topics must be a list of 1 to 64 handles");
      std::string list;
      for (const auto& one : value) {
        if (!one.is_string() || bus::find_topic(one.get<std::string>()) == nullptr)
          throw BadRequest("topics", "no topic is called " + one.dump());
        list += (list.empty() ? "" : ",") + one.get<std::string>();
      }
      request.arguments.insert(request.arguments.end(), {"--topics", list});
    } else {
      throw BadRequest(key, "unknown field '" + key + "'");
    }
  }
  if (request.name.empty()) request.name = time_text(now(), "%Y%m%d-%H%M%S.mcap");
  return request;
}

// Of a recorder that has ended. Its log may be on the full disk, so its summary is read from a pipe.
Json summary_of(cluster::ChildProcess& recorder) {
  auto newest = Json::object();
  std::istringstream lines(recorder.read_all());
  for (std::string line; std::getline(lines, line);)
    if (auto summary = Json::parse(line, nullptr, false); summary.is_object()) newest = std::move(summary);
  return newest;
}

}  // namespace

void Recordings::handle(const Match& match, const RequestText& request, const Respond& respond) {
  const bool taken = worker_.offer([this, match, request, respond] {
    try {
      respond(answer(match, request));
    } catch (const BadRequest& bad) {
      respond(error_answer(400, bad.what(), bad.field));
    } catch (const std::exception& error) {
      respond(refused_answer(0, error.what()));
    }
  });
  if (!taken) respond(busy_answer());
}

void Recordings::stop() {
  worker_.stop();
  recorder_.stop(time_to_finish);
}

std::string Recordings::running() {
  if (recorder_.pid() != 0 && !recorder_.status()) return name_;
  notice_end();
  return {};
}

void Recordings::notice_end() {
  const auto status = recorder_.status();
  if (noticed_ || !status) return;
  noticed_ = true;
  if (*status == 0) return;
  const auto summary = summary_of(recorder_);
  const auto missing = summary.value("dropped_messages", 0ULL) + summary.value("overwritten_messages", 0ULL);
  problem_ = summary.value("problem", "");
  is_broken_ = missing == 0 || !problem_.empty();
  if (is_broken_ && problem_.empty()) problem_ = recorder_.ended();
  if (!is_broken_)
    problem_ = std::to_string(missing) + " messages are missing: the computer or its disk was too slow";
}

Answer Recordings::answer(const Match& match, const RequestText& request) {
  if (match.operation == Operation::recordings) return list(request.query);
  if (match.operation == Operation::start_recording) return start(request.body);
  const auto& name = match.parts.at(0);
  const auto file = recording_file(settings_.directory, name);
  if (!file) return error_answer(404, "no recording " + name);
  if (match.operation == Operation::stop_recording) return end(name);
  if (match.operation == Operation::remove_recording) return remove(*file, request.if_match);
  if (match.operation == Operation::recording_table) return table(*file);
  return read(*file, request);
}

Answer Recordings::list(const std::string& query) {
  const auto current = running();
  auto files = Json::array();
  for (const auto& file : recording_files(settings_.directory))
    files.push_back({{"name", file.name},
                     {"size", file.size},
                     {"modified", time_text(file.modified, "%Y-%m-%dT%H:%M:%SZ")},
                     {"etag", file.etag()},
                     {"recording", file.name == current}});
  std::error_code error;
  const auto place =
      fs::exists(settings_.directory, error) ? settings_.directory : settings_.directory.parent_path();
  const auto space = fs::space(place, error);
  return list_answer({{"recordings", std::move(files)},
                      {"recording", current},
                      {"problem", problem_.empty() ? "" : name_ + ": " + problem_},
                      {"free", error ? std::uintmax_t{0} : space.available}},
                     "recordings", query);
}

Answer Recordings::start(const std::string& body) {
  auto request = start_request(parse_body(body));
  if (const auto current = running(); !current.empty())
    return refused_answer(0, current + " is being recorded; stop it first");
  if (settings_.recorder.empty()) return refused_answer(0, "this gateway has no recorder");
  const auto path = settings_.directory / request.name;
  if (fs::exists(fs::symlink_status(path))) return refused_answer(0, request.name + " exists already");
  std::error_code error;
  const auto& place =
      fs::exists(settings_.directory, error) ? settings_.directory : settings_.directory.parent_path();
  if (const auto free = recording::free_space((place / request.name).string()))
    if (const auto refusal = recording::space_refusal(path.string(), *free, settings_.free_space);
        !refusal.empty())
      return refused_answer(0, refusal);
  fs::create_directories(settings_.directory);
  cluster::ChildOptions child;
  child.arguments = settings_.recorder;
  child.arguments.insert(child.arguments.end(), {"--output", path.string()});
  child.arguments.insert(child.arguments.end(), request.arguments.begin(), request.arguments.end());
  child.log = (settings_.directory / "recorder.log").string();
  child.read_from = 1;
  child.ends_with_parent = true;
  recorder_ = cluster::ChildProcess(child);
  name_ = request.name;
  problem_.clear();
  is_broken_ = noticed_ = false;
  const auto until = std::chrono::steady_clock::now() + time_to_begin;
  while (!fs::exists(path) && std::chrono::steady_clock::now() < until) {
    if (recorder_.status()) return refused_answer(0, "the recorder ended: " + recorder_.ended());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (!fs::exists(path)) {
    recorder_.stop();
    return refused_answer(0, "the recorder did not start within 3 s");
  }
  return json_answer(200, {{"accepted", true}, {"name", name_}});
}

Answer Recordings::end(const std::string& name) {
  if (running() != name)
    return refused_answer(0, name == name_ && is_broken_
                                 ? name + " has ended before it was stopped: " + problem_
                                 : name + " is not being recorded");
  recorder_.stop(time_to_finish);
  notice_end();
  if (is_broken_) return refused_answer(0, name + " is stopped, and not complete: " + problem_);
  return json_answer(200, {{"accepted", true}, {"name", name}});
}

Answer Recordings::remove(const RecordingFile& file, const std::string& if_match) {
  if (file.name == running()) return refused_answer(0, file.name + " is being recorded; stop it first");
  if (if_match.empty())
    return error_answer(428, "to delete " + file.name + " send its ETag, " + file.etag() + ", in If-Match");
  if (if_match != file.etag())
    return error_answer(
        412, file.name + " has the ETag " + file.etag() + ", and " + if_match + " was to be deleted");
  fs::remove(settings_.directory / file.name);
  return json_answer(200, {{"accepted", true}});
}

Answer Recordings::read(const RecordingFile& file, const RequestText& request) const {
  const bool same = request.if_range.empty() || request.if_range == file.etag();
  const auto range = byte_range(same ? request.range : "", file.size);
  Answer made;
  made.type = "application/octet-stream";
  made.headers = {{"ETag", file.etag()}, {"Accept-Ranges", "bytes"}};
  if (range.kind == ByteRange::Kind::outside) {
    made = error_answer(416, file.name + " has " + std::to_string(file.size) + " bytes");
    made.headers = {{"Content-Range", "bytes */" + std::to_string(file.size)}};
    return made;
  }
  if (range.kind == ByteRange::Kind::part) {
    made.status = 206;
    made.headers.push_back({"Content-Range", "bytes " + std::to_string(range.first) + "-" +
                                                 std::to_string(range.first + range.count - 1) + "/" +
                                                 std::to_string(file.size)});
  }
  made.headers.push_back({"Content-Disposition", "attachment; filename=\"" + file.name + "\""});
  made.source = file_part(settings_.directory / file.name, range);
  made.length = range.count;
  if (!made.source) return error_answer(404, "no recording " + file.name);
  return made;
}

Answer Recordings::table(const RecordingFile& file) const {
  auto source = std::make_unique<recording::FileSource>((settings_.directory / file.name).string());
  const auto made = std::make_shared<RecordingTable>(std::move(source));
  if (!made->begin())
    return refused_answer(0, file.name + " has no executed cycle that this version can read" +
                                 (made->problem().empty() ? "" : ": " + made->problem()));
  Answer answer;
  answer.type = "text/csv; charset=utf-8";
  answer.headers = {{"ETag", file.etag()}};
  answer.source = made;
  return answer;
}

}  // namespace trunnion::gateway
