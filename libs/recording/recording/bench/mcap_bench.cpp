// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>

#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"
#include "storage/crc32.hpp"

namespace trunnion::recording {
namespace {

// What a batch of 8 setpoints of 9 axes looks like to the compressor: doubles that change slowly.
Bytes batch(int number) {
  Bytes bytes(64 + 72 * sizeof(double));
  for (int i = 0; i < 72; ++i) {
    const double value = 100 * std::sin(1e-3 * (number * 8 + i / 9) + i % 9);
    std::memcpy(bytes.data() + 64 + i * sizeof(double), &value, sizeof(double));
  }
  return bytes;
}

void write_batches(benchmark::State& state) {
  std::vector<Bytes> batches;
  for (int i = 0; i < 4096; ++i) batches.push_back(batch(i));
  struct Nowhere : Sink {
    bool write(std::span<const std::uint8_t>) override { return true; }
  } sink;
  Writer writer(sink, {.compression_level = static_cast<int>(state.range(0))});
  const auto channel = writer.add_channel("batches", "Batch", "");
  std::uint32_t sequence = 0;
  for (auto _ : state) {
    writer.write(channel, sequence, sequence, batches[sequence % batches.size()]);
    ++sequence;
  }
  state.SetItemsProcessed(sequence);
  state.SetBytesProcessed(static_cast<std::int64_t>(sequence) * static_cast<std::int64_t>(batches[0].size()));
  state.counters["compressed"] = static_cast<double>(writer.bytes()) /
                                 (static_cast<double>(sequence) * static_cast<double>(batches[0].size()));
}
BENCHMARK(write_batches)->Arg(1)->Arg(3);

void read_batches(benchmark::State& state) {
  MemorySink sink;
  Writer writer(sink);
  const auto channel = writer.add_channel("batches", "Batch", "");
  for (std::uint32_t i = 0; i < 50000; ++i) writer.write(channel, i, i, batch(static_cast<int>(i)));
  writer.finish();
  for (auto _ : state) {
    MemorySource source(sink.data);
    Reader reader(source);
    MessageView message;
    while (reader.next(message)) benchmark::DoNotOptimize(message.data.data());
  }
  state.SetItemsProcessed(state.iterations() * 50000);
}
BENCHMARK(read_batches);

void checksum(benchmark::State& state) {
  const Bytes bytes(1 << 20, 0x5a);
  for (auto _ : state) benchmark::DoNotOptimize(storage::crc32(0, bytes));
  state.SetBytesProcessed(state.iterations() << 20);
}
BENCHMARK(checksum);

}  // namespace
}  // namespace trunnion::recording
