// SPDX-License-Identifier: Apache-2.0
// Reads a file beside the page, so that the keys that stop always answer.
import { BadCsv, parseCsv, type Source } from "./recording";

async function bytesOf({ file, url }: Source): Promise<ArrayBuffer> {
  if (file) return file.arrayBuffer();
  const response = await fetch(url!);
  if (response.ok) return response.arrayBuffer();
  const refusal = (await response.json().catch(() => ({}))) as { reason?: string; error?: string };
  throw new Error(refusal.reason ?? refusal.error ?? String(response.status));
}

self.onmessage = async (event: MessageEvent<{ source: Source; period: number }>) => {
  const { source, period } = event.data;
  try {
    const recording = parseCsv(new Uint8Array(await bytesOf(source)), source.name, period);
    const buffers = new Set([recording.cycles.buffer, ...recording.columns.map(({ values }) => values.buffer)]);
    (self as unknown as Worker).postMessage({ recording }, [...buffers] as ArrayBuffer[]);
  } catch (error) {
    const what = error instanceof BadCsv ? { line: error.line, what: error.what } : { line: 0, what: error instanceof Error ? error.message : String(error) };
    (self as unknown as Worker).postMessage(what);
  }
};
