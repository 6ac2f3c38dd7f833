// SPDX-License-Identifier: Apache-2.0
// Changed byte code is refused, or it runs within its budget and its memory. The bytes of the input are
// written over those of a real program: each three give a place and a value. An input that begins with the
// mark is byte code itself.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "plc/compile.hpp"
#include "plc/library/register_names.hpp"
#include "plc/machine/machine.hpp"
#include "plc/machine/verify.hpp"

namespace {

using namespace trunnion::st;

constexpr const char* source =
    "TYPE P : STRUCT x : INT; s : STRING[9]; END_STRUCT; END_TYPE\n"
    "FUNCTION f : INT VAR_INPUT v : INT; END_VAR VAR_IN_OUT q : INT; END_VAR q := q + v; f := q / 3; "
    "END_FUNCTION\n"
    "PROGRAM main VAR i, n : INT; a : ARRAY[0..9] OF P; t : TON; s : STRING := 'abc'; r : REAL; w : WORD; "
    "u : WSTRING[5] := \"x$20AC\"; b : POINTER TO BYTE; d : POINTER TO DWORD; all : POINTER TO ARRAY[0..99] "
    "OF P; "
    "END_VAR\n"
    "FOR i := 0 TO 9 DO a[i].x := i; n := n + f(i, a[i].x); END_FOR;\n"
    "s := CONCAT(LEFT(s, 2), INT_TO_STRING(n)); a[n MOD 10].s := s; t(IN := n > 3, PT := T#5ms);\n"
    "WHILE n > 10 DO n := n / 2; r := SQRT(r + n); w.%X3 := NOT w.%X3; END_WHILE; %Y3 := "
    "INT_TO_USINT(LEN(s));\n"
    "u := REPLACE(CONCAT(LEFT(u, n), STRING_TO_WSTRING(s)), u, 1, n); n := FIND(u, u) + LEN(u); "
    "a[1] := a[2]; CASE n OF 1..3: n := 4; ELSE n := 5; END_CASE;\n"
    "b := ADR(s) + n; b^ := b^ XOR 1; d := ADR(r); d^ := d^ OR 1; all := ADR(a[1]); all^[n].x := all^[0].x; "
    "IF b > ADR(s) THEN d := ADR(w); END_IF;\nEND_PROGRAM\n";

const std::vector<std::uint8_t>& original() {
  static const auto bytes = [] {
    const auto result = compile({{"f.st", source}}, interface_registers());
    if (!result.good()) std::abort();
    return encode(*result.code);
  }();
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto bytes = original();
  if (size > 4 && std::equal(data, data + 4, bytes.begin()))
    bytes.assign(data, data + size);
  else
    for (std::size_t i = 0; i + 3 <= size; i += 3)
      bytes[(data[i] | data[i + 1] << 8) % bytes.size()] = data[i + 2];
  auto code = decode(bytes);
  if (!code || !verify(*code).empty()) return 0;
  Machine machine(std::make_shared<ByteCode>(std::move(*code)));
  for (std::size_t entry = 0; entry < machine.code().entries.size() && entry < 4; ++entry)
    for (int scan = 0; scan < 3; ++scan) machine.run(entry, scan * 10000000, 2000);
  machine.next_timer_end(0), machine.timer_due(0);
  return 0;
}
