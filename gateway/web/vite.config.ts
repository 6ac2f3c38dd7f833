// SPDX-License-Identifier: Apache-2.0
import { defineConfig } from "vite";

export default defineConfig({
  esbuild: { jsx: "automatic", jsxImportSource: "preact" },
  build: { target: "es2021", modulePreload: { polyfill: false } },
  server: {
    proxy: { "/api": { target: process.env.TRUNNION_URL ?? "http://127.0.0.1:8080", ws: true } },
  },
});
