// SPDX-License-Identifier: Apache-2.0
#include "plc/devices/message_file.hpp"

#include <algorithm>

#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"
#include "text/utf8.hpp"

namespace trunnion::st {
namespace {

// With the number behind it the text fits into plc::ChannelControl.
constexpr std::size_t longest_text = 140;
constexpr const char* message_keys = "text, german, chinese, reaction, inhibits, channel";

class MessageReader {
 public:
  explicit MessageReader(const std::string& file) : reader_(file) {}

  MessageFile read(const YAML::Node& root) {
    MessageFile messages;
    if (!root.IsMap()) reader_.fail(root, "expected messages by their numbers");
    for (const auto& entry : root) {
      const auto number = whole(entry.first, most_messages - 1);
      if (messages.contains(number))
        reader_.fail(entry.first, "message " + std::to_string(number) + " is there twice");
      messages[number] = message(entry.second);
    }
    return messages;
  }

 private:
  Message message(const YAML::Node& node) {
    Message result;
    reader_.each(node, message_keys, [&](const std::string& key, const YAML::Node& value) {
      if (key == "text") return result.text = words(value), true;
      if (key == "german") return result.german = words(value), true;
      if (key == "chinese") return result.chinese = words(value), true;
      if (key == "channel") return result.channel = whole(value, 7), true;
      if (key == "inhibits") return inhibits(value, result), true;
      return key == "reaction" && (result.reaction = reader_.choice<MessageReaction>(
                                       value, {{"show", MessageReaction::show},
                                               {"feed_hold", MessageReaction::feed_hold},
                                               {"axis_stop", MessageReaction::axis_stop}}),
                                   true);
    });
    if (result.text.empty()) reader_.fail(node, "'text' is missing");
    if (result.channel && !result.inhibits_start && !result.inhibits_manual)
      reader_.fail(node, "'channel' is of 'inhibits', which is missing");
    return result;
  }

  void inhibits(const YAML::Node& node, Message& message) {
    if (!node.IsSequence() || node.size() == 0) reader_.fail(node, "expected a list of start and manual");
    for (const auto& one : node)
      reader_.choice<bool*>(
          one, {{"start", &message.inhibits_start}, {"manual", &message.inhibits_manual}})[0] = true;
  }

  std::string words(const YAML::Node& node) const {
    auto text = reader_.text(node);
    if (text.empty() || text.size() > longest_text ||
        ::trunnion::text::valid_utf8_prefix(text) != text.size() ||
        std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }))
      reader_.fail(node,
                   "expected one line of text, at most " + std::to_string(longest_text) + " bytes of UTF-8");
    return text;
  }

  std::uint16_t whole(const YAML::Node& node, std::size_t most) const {
    return static_cast<std::uint16_t>(reader_.whole(node, {0, static_cast<double>(most)}));
  }

  machine::YamlReader reader_;
};

}  // namespace

MessageFile read_messages(const std::string& yaml, const std::string& file) {
  return MessageReader(file).read(machine::parse_yaml(yaml, file));
}

}  // namespace trunnion::st
