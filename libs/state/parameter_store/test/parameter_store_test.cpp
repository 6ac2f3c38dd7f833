// SPDX-License-Identifier: Apache-2.0
// The keeper of parameters on a storage in memory that can fail in every way a disk does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "machine/alarm_constants.hpp"
#include "parameter_store/parameter_store.hpp"

namespace trunnion::parameters {
namespace {

using Pending = std::vector<idl::parameters::Parameter>;

using idl::parameters::Operation;
using testing::HasSubstr;

/// A disk that works.
class MemoryStorage : public Storage {
 public:
  std::optional<std::string> read(const std::string& name) override {
    const auto found = files.find(name);
    return found == files.end() ? std::nullopt : std::optional(found->second);
  }
  void replace(const std::vector<NamedText>& texts) override {
    for (const auto& text : texts) files[text.name] = text.text;
  }
  std::uint64_t append(const std::string& name, const std::string& text) override {
    const auto size = files[name].size();
    files[name] += text;
    return size;
  }
  void truncate(const std::string& name, std::uint64_t size) override { files[name].resize(size); }
  std::map<std::string, std::string> files;
};

/// The journal cannot be written.
class JournalFullStorage : public MemoryStorage {
 public:
  std::uint64_t append(const std::string&, const std::string&) override {
    throw StorageError("journal: no space");
  }
};

/// The journal is a directory.
class JournalUnreadableStorage : public JournalFullStorage {
 public:
  std::optional<std::string> read(const std::string& name) override {
    if (name == journal_file) throw StorageError("journal.jsonl: is a directory");
    return JournalFullStorage::read(name);
  }
};

/// Files cannot be replaced while `full`.
class DiskFullStorage : public MemoryStorage {
 public:
  void replace(const std::vector<NamedText>& texts) override {
    if (full) throw StorageError("disk: no space");
    MemoryStorage::replace(texts);
  }
  bool full = false;
};

/// The process dies after the first file of a change is in place.
class CrashBetweenFilesStorage : public MemoryStorage {
 public:
  struct Crash {};
  void replace(const std::vector<NamedText>& texts) override {
    if (!armed) return MemoryStorage::replace(texts);
    files[texts.front().name] = texts.front().text;
    throw Crash();
  }
  bool armed = false;
};

// 100007 negative_limit (reset), 100000 axis_name (save), 000001 interpolation_cycle (restart, 250 .. 10000).
constexpr std::uint32_t limit = 100007, name = 100000, cycle = 1;
constexpr const char* time_text = "2026-01-02T03:04:05Z";

idl::parameters::ParameterRequest set(std::vector<idl::parameters::Parameter> values,
                                      Operation operation = Operation::SET) {
  idl::parameters::ParameterRequest request;
  request.role = 2;  // a builder's
  request.operation = operation;
  request.who = "test";
  request.values = std::move(values);
  return request;
}

MachineDefaults defaults() {
  MachineDefaults d;
  d.values[limit] = {-300, ""};
  d.values[name] = {0, "X"};
  return d;
}

double value_of(const ParameterStore& store, std::uint32_t number) {
  for (const auto& p : store.set().values)
    if (p.number == number) return p.value;
  return machine::Catalogue::instance().default_of(number);
}

TEST(ParameterStore, StartsWithTheMachinesDefaults) {
  MemoryStorage storage;
  ParameterStore store(storage, defaults(), "boot");
  const auto published = store.set();
  EXPECT_EQ(published.revision, 1u);
  ASSERT_EQ(published.values.size(), 2u);
  EXPECT_EQ(published.values[0].text, "X");
  EXPECT_EQ(published.values[1].number, limit);
  EXPECT_EQ(published.values[1].value, -300);
}

// By HTTP, by a line of MDI and by a program the same: the store is where every change goes through. 100007
// is the builder's, 100034 the user's.
TEST(ParameterStore, ChangesWhatTheRoleOfWhoAsksPermits) {
  MemoryStorage storage;
  ParameterStore store(storage, defaults(), "boot");
  const auto refusal = [&](idl::parameters::ParameterRequest request, std::uint8_t role) {
    request.role = role;
    return store.apply(request, time_text).reason;
  };
  const auto limits = set({{limit, -5000, ""}}), both = set({{limit, -299, ""}, {40030, 2000, ""}});
  auto tool = set({}, Operation::SET_TOOL), offset = set({}, Operation::SET_WORK_OFFSET);
  tool.tools = {{1}};
  offset.offsets = {{0, 0, {1}}};
  const auto before = storage.files;
  EXPECT_EQ(refusal(limits, 0),
            "parameter 100007 needs the role builder, and this is changed for the role operator");
  EXPECT_EQ(refusal(limits, 1),
            "parameter 100007 needs the role builder, and this is changed for the role setter");
  EXPECT_NE(refusal(set({{limit, 0, ""}}, Operation::RESET_TO_DEFAULT), 1), "");
  EXPECT_EQ(refusal(both, 1),
            "parameter 100007 needs the role builder, and this is changed for the role setter");
  EXPECT_EQ(refusal(tool, 0),
            "the tool table needs the role setter, and this is changed for the role operator");
  EXPECT_EQ(refusal(offset, 0),
            "work offsets need the role setter, and this is changed for the role operator");
  EXPECT_EQ(storage.files, before) << "half of a change";
  EXPECT_EQ(refusal(tool, 1), "");
  EXPECT_EQ(refusal(offset, 1), "");
  EXPECT_EQ(refusal(limits, 2), "");
}

TEST(ParameterStore, StartsOnAFullDiskWhenNoValueChangesAndWritesTheStartWithTheNextChange) {
  DiskFullStorage storage;
  ParameterStore(storage, defaults(), "first");
  storage.full = true;
  ParameterStore store(storage, defaults(), "second");
  EXPECT_EQ(store.problem(), "disk: no space");
  EXPECT_EQ(store.set().revision, 1u);
  EXPECT_FALSE(store.apply(set({{name, 0, "Y"}}), time_text).accepted);
  storage.full = false;
  EXPECT_TRUE(store.apply(set({{name, 0, "Y"}}), time_text).accepted);
  EXPECT_THAT(storage.files.at(active_file), HasSubstr("boot: second"));
}

TEST(ParameterStore, StartsWithoutAJournalAndRefusesChangesUntilThereIsOne) {
  JournalUnreadableStorage storage;
  ParameterStore store(storage, defaults(), "first");
  EXPECT_THAT(store.problem(), HasSubstr("journal.jsonl: is a directory"));
  EXPECT_EQ(store.set().revision, 1u);
  EXPECT_FALSE(store.apply(set({{name, 0, "Y"}}), time_text).accepted);
  EXPECT_TRUE(store.set().pending.empty());
}

TEST(ParameterStore, DoesNotStartOnAFullDiskWhenAValueBecomesActiveOrNothingIsStored) {
  DiskFullStorage storage;
  storage.full = true;
  EXPECT_THROW(ParameterStore(storage, defaults(), "first"), StorageError) << "a new machine";
  storage.full = false;
  EXPECT_TRUE(
      ParameterStore(storage, defaults(), "first").apply(set({{cycle, 2000, ""}}), time_text).accepted);
  storage.full = true;
  EXPECT_THROW(ParameterStore(storage, defaults(), "second"), StorageError);
}

// X travels -300 .. 99999 mm (100007, 100006), its reference point is 0 (100012).
TEST(ParameterStore, RefusesWhatDoesNotFitTogether) {
  MemoryStorage storage;
  ParameterStore store(storage, defaults(), "boot");
  EXPECT_EQ(
      store.apply(set({{100006, -400, ""}}), time_text).reason,
      "parameter 100007 (negative_limit): axis 0 (X) has its negative travel limit at -300 mm, which is "
      "not below the positive one at -400 mm (parameter 100006)");
  EXPECT_THAT(store.apply(set({{40001, 0, ""}, {40002, 0, ""}}), time_text).reason,
              HasSubstr("which is X of channel 0 already"));
  EXPECT_TRUE(store.set().pending.empty());
  EXPECT_TRUE(store.faults().empty());
  EXPECT_TRUE(
      store.apply(set({{100006, -400, ""}, {limit, -500, ""}, {100012, -450, ""}}), time_text).accepted);
}

// A state of before, or a machine whose files have changed: two faults, corrected one after the other.
TEST(ParameterStore, WhatDoesNotFitAlreadyCanBeCorrectedStepByStep) {
  MemoryStorage storage;
  storage.files["parameters.yaml"] = "\"100006\": -400\n\"040001\": 0\n\"040002\": 0\n";
  ParameterStore store(storage, defaults(), "boot");
  EXPECT_EQ(store.faults().size(), 2u);
  EXPECT_THAT(store.apply(set({{40003, 0, ""}}), time_text).reason, HasSubstr("Z of channel 0 is axis 0"));
  EXPECT_TRUE(store.apply(set({{100006, -100, ""}}), time_text).accepted)
      << "its reference point is outside yet";
  EXPECT_TRUE(store.apply(set({{100006, 100, ""}}), time_text).accepted);
  EXPECT_EQ(store.faults().size(), 1u);
  EXPECT_TRUE(store.apply(set({{40002, -1, ""}}), time_text).accepted);
  EXPECT_TRUE(store.faults().empty());
}

TEST(ParameterStore, SaveIsActiveAtOnceResetAtTheResetRestartAtTheNextStart) {
  MemoryStorage storage;
  {
    ParameterStore store(storage, defaults(), "one");
    store.channel_reset_count(0, 3);
    const auto reply = store.apply(set({{name, 0, "Y"}, {limit, -250, ""}, {cycle, 2000, ""}}), time_text);
    EXPECT_TRUE(reply.accepted) << reply.reason;
    EXPECT_EQ(reply.revision, 2u);  // the name
    EXPECT_EQ(reply.pending, 2u);
    EXPECT_EQ(store.set().values[0].text, "Y");
    EXPECT_EQ(store.set().pending, (Pending{{cycle, 2000, ""}, {limit, -250, ""}}));
    EXPECT_EQ(value_of(store, limit), -300);

    store.channel_reset_count(0, 3);
    EXPECT_EQ(store.revision(), 2u);
    store.channel_reset_count(0, 4);
    EXPECT_EQ(store.revision(), 3u);
    EXPECT_EQ(store.set().previous, 2u);
    EXPECT_EQ(value_of(store, limit), -250);
    EXPECT_EQ(store.set().pending, (Pending{{cycle, 2000, ""}}));
    EXPECT_EQ(value_of(store, cycle), 1000);
  }
  {
    ParameterStore same_cluster(storage, defaults(), "one");
    EXPECT_EQ(same_cluster.revision(), 3u);
    EXPECT_EQ(value_of(same_cluster, cycle), 1000) << "a restart value sneaked in";
    EXPECT_EQ(same_cluster.set().pending, (Pending{{cycle, 2000, ""}}));
  }
  ParameterStore next_start(storage, defaults(), "two");
  EXPECT_EQ(next_start.revision(), 4u);
  EXPECT_EQ(value_of(next_start, cycle), 2000);
  EXPECT_TRUE(next_start.set().pending.empty());
}

TEST(ParameterStore, AResetWhileTheServiceWasAwayCounts) {
  MemoryStorage storage;
  {
    ParameterStore store(storage, defaults(), "one");
    store.channel_reset_count(1, 7);
    store.apply(set({{limit, -250, ""}}), time_text);
  }
  ParameterStore store(storage, defaults(), "one");
  EXPECT_EQ(value_of(store, limit), -300);
  store.channel_reset_count(1, 8);
  EXPECT_EQ(value_of(store, limit), -250);
}

TEST(ParameterStore, AChannelThatStartsAgainIsNoReset) {
  MemoryStorage storage;
  ParameterStore store(storage, defaults(), "one");
  store.channel_reset_count(0, 7);
  store.apply(set({{limit, -250, ""}}), time_text);
  store.channel_reset_count(0, 0);
  EXPECT_EQ(value_of(store, limit), -300);
  store.channel_reset_count(0, 1);
  EXPECT_EQ(value_of(store, limit), -250);
}

TEST(ParameterStore, StartsWithoutABootNameAreStartsOfTheCluster) {
  MemoryStorage storage;
  {
    ParameterStore store(storage, defaults(), "");
    store.apply(set({{cycle, 2000, ""}}), time_text);
    EXPECT_EQ(value_of(store, cycle), 1000);
  }
  EXPECT_EQ(value_of(ParameterStore(storage, defaults(), ""), cycle), 2000);
}

TEST(ParameterStore, SeveralValuesAreAllOrNothing) {
  MemoryStorage storage;
  ParameterStore store(storage, defaults(), "one");
  const auto before = storage.files;
  const auto reply = store.apply(set({{name, 0, "Z"}, {cycle, 100, ""}}), time_text);
  EXPECT_FALSE(reply.accepted);
  EXPECT_EQ(reply.alarm, alarm::request_invalid.number);
  EXPECT_THAT(reply.reason, HasSubstr("000001 (interpolation_cycle): 100 is outside 250 .. 10000"));
  EXPECT_EQ(store.set().values[0].text, "X");
  EXPECT_EQ(storage.files, before);
  EXPECT_THAT(store.apply(set({{999999, 1, ""}}), time_text).reason, HasSubstr("999999 does not exist"));
  EXPECT_FALSE(store.apply(set({}), time_text).accepted);
}

TEST(ParameterStore, ResetToDefaultIsTheMachinesDefault) {
  MemoryStorage storage;
  ParameterStore store(storage, defaults(), "one");
  store.apply(set({{name, 0, ""}}), time_text);  // the catalogue's default, an exception from the machine's
  EXPECT_EQ(store.set().values[0].number, limit);
  ParameterStore again(storage, defaults(), "two");
  EXPECT_EQ(again.set().values[0].number, limit) << "an empty name must survive a restart";
  EXPECT_TRUE(again.apply(set({{name, 0, ""}}, Operation::RESET_TO_DEFAULT), time_text).accepted);
  EXPECT_EQ(again.set().values[0].text, "X");
}

TEST(ParameterStore, ATextThatIsNotUtf8IsRefused) {
  MemoryStorage storage;
  ParameterStore store(storage, defaults(), "one");
  const auto reply = store.apply(set({{name, 0, "A\xff"}}), time_text);
  EXPECT_FALSE(reply.accepted);
  EXPECT_THAT(reply.reason, HasSubstr("not UTF-8"));
}

// The lines of a journal that are whole: a crash may leave a torn last one.
std::vector<std::string> read_journal(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t at = 0;
  for (auto end = text.find('\n'); end != std::string::npos; at = end + 1, end = text.find('\n', at))
    if (nlohmann::json::accept(text.substr(at, end - at))) lines.push_back(text.substr(at, end - at));
  return lines;
}

TEST(ParameterStore, TheJournalTellsWhoChangedWhatFromWhatToWhat) {
  MemoryStorage storage;
  ParameterStore store(storage, defaults(), "one");
  store.apply(set({{limit, -250, ""}, {name, 0, "A\"\\"}}), time_text);
  store.apply(set({{limit, -250, ""}}), time_text);  // no change, no entry
  storage.files[journal_file] += "{\"time\": \"torn";
  const auto lines = read_journal(storage.files[journal_file]);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(
      lines[0],
      R"({"time":"2026-01-02T03:04:05Z","who":"test","part":1,"what":"parameter","number":100007,"old":-300.0,"new":-250.0})");
  EXPECT_THAT(lines[1], HasSubstr("\"part\":2"));
  EXPECT_THAT(lines[1], HasSubstr("\"old\":\"X\""));
  ParameterStore again(storage, defaults(), "two");  // cuts the torn line off
  again.apply(set({{limit, -200, ""}}), time_text);
  EXPECT_EQ(read_journal(storage.files[journal_file]).size(), 3u);
  EXPECT_THAT(storage.files[journal_file], testing::Not(HasSubstr("torn")));
}

TEST(ParameterStore, AFullJournalRefusesTheChange) {
  JournalFullStorage storage;
  ParameterStore store(storage, defaults(), "one");
  const auto before = store.set();
  const auto reply = store.apply(set({{name, 0, "Y"}}), time_text);
  EXPECT_FALSE(reply.accepted);
  EXPECT_EQ(reply.alarm, alarm::storage_failed.number);
  EXPECT_EQ(store.set(), before);
}

TEST(ParameterStore, AFullDiskRefusesTheChangeAndTakesTheJournalBack) {
  DiskFullStorage storage;
  ParameterStore store(storage, defaults(), "one");
  const auto before = store.set();
  storage.full = true;
  EXPECT_EQ(store.apply(set({{name, 0, "Y"}}), time_text).alarm, alarm::storage_failed.number);
  EXPECT_EQ(store.set(), before);
  EXPECT_TRUE(storage.files[journal_file].empty());
  EXPECT_THROW(store.channel_reset_count(0, 1), StorageError);
  storage.full = false;
  EXPECT_TRUE(store.apply(set({{name, 0, "Y"}}), time_text).accepted);
}

TEST(ParameterStore, ACrashBetweenTheFilesOfAChangeIsCompletedAtTheNextStart) {
  CrashBetweenFilesStorage storage;
  {
    ParameterStore store(storage, defaults(), "one");
    storage.armed = true;
    EXPECT_THROW(store.apply(set({{name, 0, "Y"}, {limit, -250, ""}}), time_text),
                 CrashBetweenFilesStorage::Crash);
  }
  storage.armed = false;
  ParameterStore store(storage, defaults(), "one");
  EXPECT_EQ(store.set().values[0].text, "Y");
  EXPECT_EQ(store.revision(), 2u);
  EXPECT_EQ(store.set().pending, (Pending{{limit, -250, ""}}));
}

TEST(ParameterStore, ToolsAreCheckedKeptAndRemoved) {
  MemoryStorage storage;
  idl::parameters::ParameterRequest request;
  request.role = 2;  // a builder's
  request.operation = Operation::SET_TOOL;
  request.tools = {{7, 120.5, 0.01, 5, -0.02, "mill: \"10\""}, {3, 80, 0, 2, 0, ""}};
  {
    ParameterStore store(storage, defaults(), "one");
    EXPECT_TRUE(store.apply(request, time_text).accepted);
    request.tools = {{8, 1, 0, -1, 0, ""}};
    EXPECT_THAT(store.apply(request, time_text).reason,
                HasSubstr("tool 8 (radius): -1 is outside 0 .. 100000"));
  }
  ParameterStore store(storage, defaults(), "one");
  ASSERT_EQ(store.tool_table().tools.size(), 2u);
  EXPECT_EQ(store.tool_table().tools[0].number, 3u);
  EXPECT_EQ(store.tool_table().tools[1], (idl::parameters::Tool{7, 120.5, 0.01, 5, -0.02, "mill: \"10\""}));
  EXPECT_EQ(store.tool_table().revision, 2u);
  request.operation = Operation::REMOVE_TOOL;
  request.tools = {{7, 0, 0, 0, 0, ""}};
  EXPECT_TRUE(store.apply(request, time_text).accepted);
  EXPECT_FALSE(store.apply(request, time_text).accepted);
  EXPECT_EQ(store.tool_table().tools.size(), 1u);
}

TEST(ParameterStore, AnImportChangesValuesToolsAndOffsetsTogetherOrNothing) {
  MemoryStorage storage;
  ParameterStore store(storage, defaults(), "one");
  auto request = set({{name, 0, "Y"}}, Operation::IMPORT);
  request.tools = {{1, 10, 0, 1, 0, ""}};
  request.offsets = {{0, 62, {1, 2, 3}}};
  EXPECT_FALSE(store.apply(request, time_text).accepted);
  EXPECT_EQ(store.set().values[0].text, "X");
  EXPECT_TRUE(store.tool_table().tools.empty());
  request.offsets = {{0, 5, {1, 2, 3}}};
  EXPECT_TRUE(store.apply(request, time_text).accepted);
  EXPECT_EQ(store.work_offsets().offsets[0].values, (std::vector<double>{1, 2, 3, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(store.tool_table().tools.size(), 1u);
}

TEST(Tables, TheExternalOffsetIsARowOfItsOwn) {
  std::uint64_t revision = 0;
  const auto offsets = tool_tables::read_offsets("- {channel: 1, offset: EXT, Z: 5}\n", "f.yaml", revision);
  ASSERT_EQ(offsets.count({1, 54}), 1u);
  EXPECT_EQ(offsets.at({1, 54}).values[2], 5);
  EXPECT_THAT(tool_tables::write_offsets(offsets, 3), HasSubstr("channel: 1, offset: EXT,"));
  const auto errors =
      tool_tables::read_offsets("- {channel: 0, offset: G54.4P7, C: 0.5}\n", "f.yaml", revision);
  EXPECT_EQ(errors.count({0, 61}), 1u);
  EXPECT_EQ(tool_tables::work_offset_code(55), "G54.4P1");
}

TEST(Tables, ErrorsSayFileLineColumn) {
  std::uint64_t revision = 0;
  const auto message = [&](auto read, const char* text) {
    try {
      read(text, "f.yaml", revision);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(tool_tables::read_tools, "- {number: 1, length: long}\n"),
              HasSubstr("f.yaml:1:23: error: 'length'"));
  EXPECT_THAT(message(tool_tables::read_tools, "- {number: 0}\n"), HasSubstr("f.yaml:1:3: error: tool 0"));
  EXPECT_THAT(message(tool_tables::read_offsets, "- {channel: 0, offset: G60}\n"),
              HasSubstr("f.yaml:1:24: error: 'G60' is not"));
  EXPECT_THAT(message(tool_tables::read_offsets, "- {channel: 0, offset: G54, Q: 1}\n"),
              HasSubstr("f.yaml:1:29: error: unknown"));
}

}  // namespace
}  // namespace trunnion::parameters
