// A file server for the page: node serve.mjs [FOLDER] [PORT]
import { createReadStream, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

export const types = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".css": "text/css", ".json": "application/json",
  ".wasm": "application/wasm" };

// If `port` is 0, the server listens on a free port. The result has its address in `url`. With isCompressed, it sends files
// compressed by gzip, as servers on the internet do.
export async function serve(folder, port = 0, isCompressed = false) {
  const root = resolve(folder), compressed = new Map();
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname));
    const file = join(root, path.endsWith("/") ? `${path}index.html` : path);
    try {
      if (!file.startsWith(root) || !statSync(file).isFile()) throw new Error("no file");
    } catch {
      response.writeHead(404).end();
      return;
    }
    const type = { "Content-Type": types[extname(file)] ?? "application/octet-stream" };
    if (isCompressed) {
      if (!compressed.has(file)) compressed.set(file, gzipSync(readFileSync(file), { level: 9 }));
      return response.writeHead(200, { ...type, "Content-Encoding": "gzip", "Content-Length": compressed.get(file).length }).end(compressed.get(file));
    }
    response.writeHead(200, type);
    return createReadStream(file).pipe(response);
  });
  await new Promise((done) => server.listen(port, "127.0.0.1", done));
  return { server, url: `http://127.0.0.1:${server.address().port}` };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const { url } = await serve(process.argv[2] ?? ".", Number(process.argv[3] ?? 8080));
  console.log(`the page is at ${url}`);
}
