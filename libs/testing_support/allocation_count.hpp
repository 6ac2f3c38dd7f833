// SPDX-License-Identifier: Apache-2.0
// Counts what a test program allocates. To be included in one source of a program only: it replaces operator
// new.
#pragma once

#include <cstdlib>
#include <new>

namespace trunnion::testing_support {
inline std::size_t allocations = 0;  ///< calls of operator new since the program began
}

// Kept out of line: inlined, malloc and delete look mismatched to the compiler.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++trunnion::testing_support::allocations;
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
