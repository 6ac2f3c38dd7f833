// SPDX-License-Identifier: Apache-2.0
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { defineConfig, type Plugin } from "vite";

/** Beside every text of the built page the same as gzip, which the gateway sends to browsers that permit it. */
function compressed(): Plugin {
  let directory = "";
  return {
    name: "compressed",
    apply: "build",
    configResolved: (config) => void (directory = config.build.outDir),
    closeBundle() {
      for (const name of readdirSync(directory, { recursive: true, encoding: "utf8" })) {
        if (!/\.(js|css|html|svg|json)$/.test(name)) continue;
        const path = join(directory, name);
        writeFileSync(`${path}.gz`, gzipSync(readFileSync(path), { level: 9 }));
      }
    },
  };
}

export default defineConfig({
  plugins: [compressed()],
  esbuild: { jsx: "automatic", jsxImportSource: "preact" },
  // three.js is larger than the usual limit of a chunk; it is loaded with the 3D view only.
  build: { target: "es2021", modulePreload: { polyfill: false }, chunkSizeWarningLimit: 700 },
  server: {
    proxy: { "/api": { target: process.env.TRUNNION_URL ?? "http://127.0.0.1:8080", ws: true } },
  },
});
