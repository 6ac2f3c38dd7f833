// Reads a recording with the stock readers and compares every field with what was written.
// Usage: node readback.mjs RECORDING EXPECTED
import { crc32 } from "@foxglove/crc";
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";

const [recordingPath, expectedPath] = process.argv.slice(2);
const file = readFileSync(recordingPath);
const expected = JSON.parse(readFileSync(expectedPath, "utf8"));
const decompressHandlers = {
  zstd: (data, size) => decompress(new Uint8Array(data), new Uint8Array(Number(size))),
};
let fields = 0;

/** Walks value and expectation along the type's definition, so that a field either side lacks is noticed. */
function compare(value, wanted, typeName, definitions, path) {
  const definition = definitions.get(typeName);
  assert.ok(definition, `${path}: no definition of ${typeName}`);
  const names = definition.definitions.map((field) => field.name);
  assert.deepEqual(Object.keys(value), names, path);
  assert.deepEqual(Object.keys(wanted), names, path);
  for (const field of definition.definitions) {
    const here = `${path}.${field.name}`;
    if (!field.isArray) {
      compareOne(value[field.name], wanted[field.name], field, definitions, here);
      continue;
    }
    const elements = Array.from(value[field.name]);
    assert.equal(elements.length, wanted[field.name].length, here);
    elements.forEach((element, i) =>
      compareOne(element, wanted[field.name][i], field, definitions, `${here}[${i}]`));
  }
}

function compareOne(value, wanted, field, definitions, path) {
  if (field.enumType) {
    const constants = definitions.get(field.enumType).definitions;
    assert.equal(constants.find((constant) => constant.value === value)?.name, wanted, path);
  } else if (field.isComplex) {
    compare(value, wanted, field.type, definitions, path);
    return;
  } else if (typeof value === "bigint") {
    assert.equal(value, BigInt(wanted), path);
  } else {
    assert.equal(value, wanted, path);
  }
  fields++;
}

const reader = await McapIndexedReader.Initialize({
  readable: {
    size: async () => BigInt(file.byteLength),
    read: async (offset, size) => new Uint8Array(file.subarray(Number(offset), Number(offset + size))),
  },
  decompressHandlers,
});

const seen = new Map();
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  const schema = reader.schemasById.get(channel.schemaId);
  assert.equal(channel.messageEncoding, "cdr");
  assert.equal(schema.encoding, "omgidl");
  const wanted = expected.topics[channel.topic];
  assert.ok(wanted, `unexpected topic ${channel.topic}`);
  assert.equal(schema.name, wanted.type);
  assert.equal(message.sequence, wanted.sequence);
  assert.equal(message.logTime, BigInt(wanted.time));
  assert.equal(message.publishTime, message.logTime);
  const parsed = parseIDL(new TextDecoder().decode(schema.data));
  const definitions = new Map(parsed.map((definition) => [definition.name, definition]));
  const value = new MessageReader(schema.name, parsed).readMessage(message.data);
  compare(value, wanted.value, schema.name, definitions, channel.topic);
  seen.set(channel.topic, (seen.get(channel.topic) ?? 0) + 1);
}
assert.deepEqual([...seen.keys()].sort(), Object.keys(expected.topics).sort(), "topics");
for (const [topic, count] of seen) assert.equal(count, 1, topic);

// The summary: counts, metadata and every chunk's index.
assert.equal(reader.statistics.messageCount, BigInt(seen.size));
assert.equal(reader.statistics.channelCount, seen.size);
assert.equal(reader.statistics.chunkCount, reader.chunkIndexes.length);
assert.ok(reader.chunkIndexes.length > 1, "several chunks");
assert.equal(reader.metadataIndexes.length, 1);
for await (const metadata of reader.readMetadata())
  assert.deepEqual(Object.fromEntries(metadata.metadata), expected.metadata);

// The same file as a stream, which checks the chunks' checksums; and the data section's by hand.
const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
stream.append(new Uint8Array(file));
let streamed = 0;
let dataEnd;
for (let record; (record = stream.nextRecord()); ) {
  if (record.type === "Message") streamed++;
  if (record.type === "DataEnd") dataEnd = record;
}
assert.equal(streamed, seen.size);
assert.ok(stream.done());
const dataEndBytes = 13;
assert.equal(crc32(file.subarray(0, Number(reader.footer.summaryStart) - dataEndBytes)), dataEnd.dataSectionCrc);

console.log(`${seen.size} topics, ${fields} fields as written`);
