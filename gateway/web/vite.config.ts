// SPDX-License-Identifier: Apache-2.0
import { defineConfig } from "vite";

export default defineConfig({
  esbuild: { jsx: "automatic", jsxImportSource: "preact" },
  // three.js is larger than the usual limit of a chunk; it is loaded with the 3D view only.
  build: { target: "es2021", modulePreload: { polyfill: false }, chunkSizeWarningLimit: 700 },
  server: {
    proxy: { "/api": { target: process.env.TRUNNION_URL ?? "http://127.0.0.1:8080", ws: true } },
  },
});
