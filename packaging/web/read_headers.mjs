// Reads the library's headers and writes the files from which the WebAssembly module is built:
//   layouts.inc   rows for the tables of glue.cpp: members of structs, and constants; the compiler fills in the numbers
//   exports.json  the names of all functions
// node read_headers.mjs INCLUDE_FOLDER OUTPUT_FOLDER
import { readFileSync, writeFileSync } from "node:fs";

const headers = ["nook", "nook_character", "nook_gl", "nook_nnao", "nook_probe", "nook_material", "experimental/nook_debug",
  "experimental/nook_recording", "experimental/nook_lod", "experimental/nook_match", "experimental/nook_sg"];
const [include, output] = process.argv.slice(2);
const text = headers.map((name) => readFileSync(`${include}/nook/${name}.h`, "utf8")).join("\n")
  .replace(/\/\*[\s\S]*?\*\//g, "");

// Returns the type and the names of a declaration, such as "float a[3]", "const void* next", "int32_t width, height" or "void*
// (*get_proc)(...)".
function membersOf(body) {
  return body.split(";").map((line) => line.trim().replace(/\s+/g, " ")).filter(Boolean).flatMap((line) => {
    const pointer = /\(\*(\w+)\)/.exec(line);
    if (pointer) return [{ type: "", name: pointer[1] }];
    const [, type, names] = /^(.*?[ *])(\w+(?:\[\d+\])?(?:, ?\w+(?:\[\d+\])?)*)$/.exec(line);
    return names.split(",").map((name) => {
      const [, word, count] = /(\w+)(?:\[(\d+)\])?/.exec(name);
      return { type: type.trim(), name: word, count: Number(count ?? 0) };
    });
  });
}

const structs = new Map();
for (const [, body, name] of text.matchAll(/typedef struct \w+ \{([^}]*)\} (\w+);/g)) structs.set(name, membersOf(body));
const enums = new Map();
for (const [, body, name] of text.matchAll(/enum \{([^}]*)\};\s*(?:typedef int32_t (\w+);)?/g)) {
  const names = [...body.matchAll(/(NOOK_\w+) =/g)].map((match) => match[1]);
  enums.set(name ?? `bits ${names[0]}`, names);
}

const lines = [];
for (const [struct, members] of structs) {
  lines.push(`STRUCT(${struct})`);
  const add = (path, type, count) => {
    if (structs.has(type) && count) for (let i = 0; i < count; ++i) add(`${path}[${i}]`, type, 0);
    else if (structs.has(type)) for (const inner of structs.get(type)) add(`${path}.${inner.name}`, inner.type, inner.count);
    else if (enums.has(type)) lines.push(`CHOICE(${struct}, ${path}, "${type}")`);
    else lines.push(`MEMBER(${struct}, ${path})`);
  };
  for (const { name, type, count } of members) add(name, type, count);
}
for (const [name, names] of enums) for (const constant of names) lines.push(`CONSTANT(${constant}, "${name}")`);
writeFileSync(`${output}/layouts.inc`, `${lines.join("\n")}\n`);

const functions = [...text.matchAll(/NOOK_API [^;(]*?(nook_\w+)\(/g)].map((match) => `_${match[1]}`);
writeFileSync(`${output}/exports.json`, JSON.stringify(["_malloc", "_free", ...functions]));
