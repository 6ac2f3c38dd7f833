// SPDX-License-Identifier: Apache-2.0
#include "language/num_parameters.hpp"

namespace trunnion::language {
namespace {

constexpr std::size_t external_spindles = 4, longest_name = 20;

struct ParameterName {
  std::array<char, longest_name> text{};  // ends with a zero
  std::uint8_t mnemonic = 0;              // bytes of it
};

constexpr ParameterName external_name(const ExternalParameter& row, std::uint32_t index) {
  ParameterName name;
  std::size_t size = 0;
  for (const char c : std::string_view(row.mnemonic)) name.text[size++] = c;
  if (row.count > 1 && size != 0) name.text[size++] = static_cast<char>('1' + index);
  name.mnemonic = static_cast<std::uint8_t>(size);
  for (const char c : std::string_view(" (E")) name.text[size++] = c;
  for (std::uint32_t unit = 10000; unit != 0; unit /= 10)
    name.text[size++] = static_cast<char>('0' + (row.first + index) / unit % 10);
  name.text[size] = ')';
  return name;
}

constexpr auto external_names = [] {
  std::array<std::array<ParameterName, external_spindles>, external_parameters.size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ExternalParameter& row = external_parameters[i];
    for (std::uint32_t k = 0; k < row.count && row.count <= external_spindles; ++k)
      all[i][k] = external_name(row, k);
  }
  return all;
}();

}  // namespace

const char* ExternalPlace::name() const {
  if (row->count > external_spindles || row->mnemonic[0] == '\0') return "";
  return external_names[static_cast<std::size_t>(row - external_parameters.data())][index].text.data();
}

std::optional<ExternalPlace> external_parameter(std::uint32_t number) {
  for (const ExternalParameter& row : external_parameters) {
    if (number >= row.first && number - row.first < row.count) return ExternalPlace{&row, number - row.first};
  }
  return std::nullopt;
}

std::optional<ExternalPlace> external_parameter(std::string_view mnemonic) {
  if (mnemonic.empty()) return std::nullopt;
  for (std::size_t i = 0; i < external_parameters.size(); ++i) {
    for (std::uint32_t k = 0; k < external_spindles; ++k) {
      const ParameterName& name = external_names[i][k];
      if (mnemonic == std::string_view(name.text.data(), name.mnemonic))
        return ExternalPlace{&external_parameters[i], k};
    }
  }
  return std::nullopt;
}

}  // namespace trunnion::language
