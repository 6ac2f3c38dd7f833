// SPDX-License-Identifier: Apache-2.0
// Counts what a test program allocates and what it has not given back. To be included in one source of a
// program only: it replaces operator new.
#pragma once

#include <malloc.h>

#include <cstdlib>
#include <new>

namespace trunnion::testing_support {
inline std::size_t allocations = 0;  ///< calls of operator new since the program began
inline std::size_t live_bytes = 0;   ///< of what operator new has given out and nobody has deleted
}  // namespace trunnion::testing_support

// Kept out of line: inlined, malloc and delete look mismatched to the compiler.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++trunnion::testing_support::allocations;
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  trunnion::testing_support::live_bytes += malloc_usable_size(memory);
  return memory;
}
// The library's own would not be paired with the delete below: std::stable_sort takes its buffer with it.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++trunnion::testing_support::allocations;
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory != nullptr) trunnion::testing_support::live_bytes += malloc_usable_size(memory);
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  trunnion::testing_support::live_bytes -= malloc_usable_size(memory);
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
