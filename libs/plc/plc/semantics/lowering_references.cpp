// SPDX-License-Identifier: Apache-2.0
// Which variables and registers a body reads and writes.
#include <utility>

#include "plc/library/register_names.hpp"
#include "plc/semantics/lowering.hpp"

namespace trunnion::st {
namespace {

std::string members_of(const Expression& e) {
  std::string text;
  for (const auto* part = &e; part->kind == Expression::Kind::member ||
                              part->kind == Expression::Kind::index || part->kind == Expression::Kind::part;
       part = part->parts[0].get())
    if (part->kind == Expression::Kind::member) text.insert(0, text.empty() ? part->name : part->name + ".");
  return text;
}

std::string text_of(const Place& place) {
  auto at = register_at(static_cast<std::uint32_t>(place.offset));
  at.bit = static_cast<std::int8_t>(place.bit);
  return register_text(at);
}

}  // namespace

const Expression& root_of(const Expression& e) {
  const auto* root = &e;
  while (root->kind == Expression::Kind::member || root->kind == Expression::Kind::index ||
         root->kind == Expression::Kind::part)
    root = root->parts[0].get();
  return *root;
}

bool is_in_image(const Place& place) {
  return place.base == Place::Base::absolute && static_cast<std::uint32_t>(place.offset) < image_cells;
}

Value Lowering::access(const Expression& e) {
  const auto* before = accessed_;
  if (before == nullptr || &root_of(*before) != &root_of(e)) accessed_ = &e;
  auto value = e.kind == Expression::Kind::member ? member(e)
               : e.kind == Expression::Kind::part ? part(e)
                                                  : index(e);
  accessed_ = before;
  return value;
}

Value Lowering::target(const Expression& e) {
  const auto* before = std::exchange(target_, &root_of(e));
  auto value = expression(e);
  target_ = before;
  return value;
}

Value Lowering::referred(const Expression& e) {
  auto value = target(e);
  if (value.is_error()) return value;
  auto access = writing();
  access.reads = true;
  note(e, value, access);
  return check_writable(value, e.at) ? value : error();
}

void Lowering::note(const Expression& e, const Value& value, Reference access) {
  if (pou_ == nullptr || value.is_error() || unit_.is_library(pou_->declaration->at)) return;
  const auto& root = root_of(e);
  access.at = root.at;
  access.member = members_of(accessed_ != nullptr && &root_of(*accessed_) == &root ? *accessed_ : e);
  access.pou = pou_;
  auto place = value.place;
  auto cells = value.type->cells;
  if (root.kind == Expression::Kind::name) {
    if (defined_.contains(root.name)) return;
    // Who writes the name of an input with an edge reads the block that detects it.
    if (const auto input = pou_->names.find(root.detected); input != pou_->names.end()) {
      Reference read;
      read.at = root.at;
      read.pou = pou_;
      read.variable = input->second;
      read.reads = true;
      unit_.references.push_back(std::move(read));
    }
    access.variable = own_variable(root);
    if (access.variable == nullptr)
      access.variable = unit_.find_global(root.name);
    else if (access.variable->section == VariableSection::external)
      access.variable = access.variable->external;
  } else if (root.kind != Expression::Kind::direct) {
    return;
  }
  if (const auto* variable = access.variable) {
    if (variable->type->kind == Kind::block &&
        variable->type->block->pou->declaration->kind == PouKind::program)
      return;  // an instance of a CONFIGURATION
    if (is_in_image(variable->place)) access.register_text = text_of(variable->place);
    // What an index decides while it runs may be every element.
    if (place.base != Place::Base::absolute) place = variable->place, cells = variable->type->cells;
  } else if (is_in_image(place)) {
    access.register_text = text_of(place);
  } else {
    return;  // an enumerated value, a function
  }
  if (place.base == Place::Base::absolute) {
    access.first = static_cast<std::uint32_t>(place.offset);
    access.count = cells;
    access.mask = place.bit < 0 ? ~std::uint64_t{0}
                                : ((place.width < 64 ? std::uint64_t{1} << place.width : 0) - 1) << place.bit;
  }
  unit_.references.push_back(std::move(access));
}

void Lowering::note_read(const Expression& root, const Value& value) {
  if (&root == target_) return;
  Reference access;
  access.reads = true;
  note(root, value, access);
}

}  // namespace trunnion::st
