// SPDX-License-Identifier: Apache-2.0
import type { Recording, Source } from "./recording";

export type Opened = { recording: Recording } | { line: number; what: string };

/** Reads a CSV file in a worker; `cancel` ends it. */
export function openFile(source: Source, period: number): { result: Promise<Opened>; cancel: () => void } {
  const worker = new Worker(new URL("./csv_worker.ts", import.meta.url), { type: "module" });
  const result = new Promise<Opened>((resolve) => {
    worker.onmessage = (event: MessageEvent<Opened>) => {
      worker.terminate();
      resolve(event.data);
    };
    worker.onerror = (event) => {
      worker.terminate();
      resolve({ line: 0, what: event.message || "worker" });
    };
    worker.postMessage({ source, period });
  });
  return { result, cancel: () => worker.terminate() };
}
