// SPDX-License-Identifier: Apache-2.0
#include "core/paging.hpp"

#include <algorithm>

#include "core/requests.hpp"
#include "core/router.hpp"

namespace trunnion::gateway {

std::size_t count_in_query(const std::string& query, const char* name, std::size_t fallback) {
  const auto text = query_value(query, name);
  if (text.empty()) return fallback;
  const auto number = path_number(text, 100000);
  if (!number) throw BadRequest(name, std::string(name) + " must be a whole number up to 100000");
  return *number;
}

std::size_t cut_to_page(bus::Json& list, const std::string& query) {
  const auto total = list.size();
  const auto first = std::min(total, count_in_query(query, "offset", 0));
  const auto count = std::min(total - first, count_in_query(query, "limit", total));
  auto& rows = list.get_ref<bus::Json::array_t&>();
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(first + count), rows.end());
  rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(first));
  return total;
}

}  // namespace trunnion::gateway
