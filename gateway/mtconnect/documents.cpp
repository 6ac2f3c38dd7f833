// SPDX-License-Identifier: Apache-2.0
#include "mtconnect/documents.hpp"

#include <algorithm>
#include <cstdio>
#include <pugixml.hpp>
#include <sstream>

namespace trunnion::gateway::mtconnect {
namespace {

constexpr const char* version = "2.4";
constexpr const char* categories[] = {"SAMPLE", "EVENT", "CONDITION"};
constexpr const char* groups[] = {"Samples", "Events", "Condition"};
constexpr const char* levels[] = {"Normal", "Warning", "Fault", "Unavailable"};

/// Characters that XML 1.0 does not permit become '?'.
std::string permitted(std::string text) {
  for (auto& c : text)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') c = '?';
  return text;
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(permitted(value).c_str());
}
void set(pugi::xml_node node, const char* name, std::uint64_t value) {
  node.append_attribute(name).set_value(static_cast<unsigned long long>(value));
}

void set_text(pugi::xml_node node, const std::string& text) {
  node.append_child(pugi::node_pcdata).set_value(permitted(text).c_str());
}

/// The document's element with its header.
pugi::xml_node begin(pugi::xml_document& document, const std::string& kind, const AgentHeader& header,
                     pugi::xml_node& head) {
  auto declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  auto root = document.append_child(("MTConnect" + kind).c_str());
  const auto space = "urn:mtconnect.org:MTConnect" + kind + ":" + version;
  set(root, "xmlns", space);
  set(root, "xmlns:m", space);
  set(root, "xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance");
  set(root, "xsi:schemaLocation",
      space + " http://schemas.mtconnect.org/schemas/MTConnect" + kind + "_" + version + ".xsd");
  head = root.append_child("Header");
  set(head, "creationTime", header.now);
  set(head, "sender", header.sender);
  set(head, "instanceId", header.instance);
  set(head, "version", version);
  if (kind != "Error") set(head, "deviceModelChangeTime", header.model_changed);
  if (kind != "Assets") set(head, "bufferSize", header.buffer_size);
  if (kind == "Assets" || kind == "Devices") {
    set(head, "assetBufferSize", most_assets);
    set(head, "assetCount", header.assets);
  }
  return root;
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, "", pugi::format_raw, pugi::encoding_utf8);
  return out.str();
}

/// Puts the device below `parent`; `nodes` are the components'.
void add_device(pugi::xml_node parent, const Device& device, std::vector<pugi::xml_node>& nodes) {
  for (std::size_t i = 0; i < device.components.size(); ++i) {
    const auto& component = device.components[i];
    auto above = parent;
    if (component.parent >= 0) {
      auto& owner = nodes[static_cast<std::size_t>(component.parent)];
      above = owner.child("Components");
      if (!above) above = owner.append_child("Components");
    }
    auto node = above.append_child(component.kind.c_str());
    nodes.push_back(node);
    set(node, "id", component.id);
    set(node, "name", component.name);
    if (component.parent < 0) {
      set(node, "uuid", device.uuid);
      set(node, "mtconnectVersion", version);
      set_text(node.append_child("Description"), device.description);
    }
    if (component.items.empty()) continue;
    auto items = node.append_child("DataItems");
    for (const auto& item : component.items) {
      const auto& type = type_of(item.quantity);
      auto one = items.append_child("DataItem");
      set(one, "id", item.id);
      set(one, "category", categories[static_cast<int>(type.category)]);
      set(one, "type", type.type);
      if (*type.sub_type != 0) set(one, "subType", type.sub_type);
      if (*type.units != 0) set(one, "units", type.units);
      if (item.quantity == Quantity::position || item.quantity == Quantity::position_commanded ||
          item.quantity == Quantity::angle || item.quantity == Quantity::angle_commanded)
        set(one, "coordinateSystem", "MACHINE");
      if (item.quantity == Quantity::path_position) set(one, "coordinateSystem", "WORK");
      if (item.quantity == Quantity::asset_changed) set(one, "discrete", "true");
    }
  }
}

std::string number_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

std::vector<const DataItem*> items_of(const Device& device) {
  std::vector<const DataItem*> items;
  for (const auto& component : device.components)
    for (const auto& item : component.items) items.push_back(&item);
  return items;
}

std::string error_document(const AgentHeader& header, const RequestError& error) {
  pugi::xml_document document;
  pugi::xml_node head;
  auto root = begin(document, "Error", header, head);
  auto one = root.append_child("Errors").append_child("Error");
  set(one, "errorCode", error.code);
  set_text(one, error.what());
  return text_of(document);
}

std::string devices_document(const AgentHeader& header, const Device& device) {
  pugi::xml_document document;
  pugi::xml_node head;
  auto root = begin(document, "Devices", header, head);
  auto count = head.append_child("AssetCounts").append_child("AssetCount");
  set(count, "assetType", "CuttingTool");
  set_text(count, std::to_string(header.assets));
  std::vector<pugi::xml_node> nodes;
  add_device(root.append_child("Devices"), device, nodes);
  return text_of(document);
}

std::string streams_document(const AgentHeader& header, const Device& device,
                             const std::vector<const Observation*>& observations, std::uint64_t first,
                             std::uint64_t last, std::uint64_t next) {
  pugi::xml_document document;
  pugi::xml_node head;
  auto root = begin(document, "Streams", header, head);
  set(head, "firstSequence", first);
  set(head, "lastSequence", last);
  set(head, "nextSequence", next);
  auto stream = root.append_child("Streams").append_child("DeviceStream");
  set(stream, "name", device.name);
  set(stream, "uuid", device.uuid);
  std::map<std::uint32_t, std::vector<const Observation*>> of_item;
  for (const auto* one : observations) of_item[one->item].push_back(one);
  std::uint32_t index = 0;
  for (const auto& component : device.components) {
    pugi::xml_node node;
    const auto begins = index;
    for (int category = 0; category < 3; ++category) {
      pugi::xml_node group;
      index = begins;
      for (const auto& item : component.items) {
        const auto found = of_item.find(index++);
        const auto& type = type_of(item.quantity);
        if (found == of_item.end() || static_cast<int>(type.category) != category) continue;
        if (!node) {
          node = stream.append_child("ComponentStream");
          set(node, "component", component.kind);
          set(node, "name", component.name);
          set(node, "componentId", component.id);
        }
        if (!group) group = node.append_child(groups[category]);
        for (const auto* one : found->second) {
          const bool is_condition = type.category == Category::condition;
          auto element = group.append_child(
              (is_condition ? levels[static_cast<int>(one->level)] : element_name(type.type)).c_str());
          set(element, "dataItemId", item.id);
          set(element, "timestamp", one->time);
          set(element, "sequence", one->sequence);
          if (*type.sub_type != 0) set(element, "subType", type.sub_type);
          if (is_condition) set(element, "type", type.type);
          if (is_condition && (one->level == Level::warning || one->level == Level::fault))
            set(element, "conditionId", one->code);
          if (!one->code.empty()) set(element, "nativeCode", one->code);
          if (!one->severity.empty()) set(element, "nativeSeverity", one->severity);
          if (item.quantity == Quantity::asset_changed || item.quantity == Quantity::asset_removed)
            set(element, "assetType", "CuttingTool");
          if (!one->value.empty()) set_text(element, one->value);
        }
      }
    }
  }
  return text_of(document);
}

std::string assets_document(const AgentHeader& header, const Device& device,
                            const std::vector<ToolAsset>& assets) {
  pugi::xml_document document;
  pugi::xml_node head;
  auto root = begin(document, "Assets", header, head);
  auto list = root.append_child("Assets");
  for (const auto& tool : assets) {
    auto asset = list.append_child("CuttingTool");
    set(asset, "assetId", tool.id());
    set(asset, "timestamp", tool.time);
    set(asset, "deviceUuid", device.uuid);
    if (tool.removed) set(asset, "removed", "true");
    set(asset, "serialNumber", std::to_string(tool.number));
    set(asset, "toolId", std::to_string(tool.number));
    if (!tool.name.empty()) set_text(asset.append_child("Description"), tool.name);
    auto life = asset.append_child("CuttingToolLifeCycle");
    set_text(life.append_child("CutterStatus").append_child("Status"), "UNKNOWN");
    set_text(life.append_child("ProgramToolNumber"), std::to_string(tool.number));
    auto measurements = life.append_child("Measurements");
    const auto measure = [&](const char* name, const char* code, double value) {
      auto one = measurements.append_child(name);
      set(one, "code", code);
      set(one, "units", "MILLIMETER");
      set_text(one, number_text(value));
    };
    measure("CuttingDiameterMax", "DC", tool.diameter);
    measure("FunctionalLength", "LF", tool.length);
  }
  return text_of(document);
}

std::set<std::uint32_t> items_at(const Device& device, const std::string& path) {
  const auto invalid = [&](const std::string& why) {
    return RequestError(400, "INVALID_PATH", "the path '" + path + "' " + why);
  };
  pugi::xml_document document;
  std::vector<pugi::xml_node> nodes;
  add_device(document.append_child("MTConnectDevices").append_child("Devices"), device, nodes);
  std::map<std::string, std::uint32_t> index;
  for (const auto* item : items_of(device)) index.emplace(item->id, static_cast<std::uint32_t>(index.size()));
  std::set<std::uint32_t> found;
  const auto add_below = [&](const auto& self, const pugi::xml_node& node) -> void {
    if (std::string_view(node.name()) == "DataItem") {
      found.insert(index.at(node.attribute("id").value()));
      return;
    }
    for (const auto& child : node.children()) self(self, child);
  };
  try {
    for (const auto& one : document.select_nodes(path.c_str())) add_below(add_below, one.node());
  } catch (const pugi::xpath_exception& error) {
    throw invalid(std::string("is no XPath: ") + error.what());
  }
  if (found.empty()) throw invalid("finds no data item of this device");
  return found;
}

}  // namespace trunnion::gateway::mtconnect
