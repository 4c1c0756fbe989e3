// What nook-web/three gives to the match of vertices, without three.js and WebGL: node three_test.mjs NOOK_THREE.JS FOLDER
import assert from "node:assert/strict";
import { copyFileSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [source, folder] = process.argv.slice(2);
// What nook_three.js takes of three.js.
const standIns = {
  "index.js": `export class BufferGeometry {}
export class GLBufferAttribute {
  constructor(buffer, type, itemSize, elementSize, count) { Object.assign(this, { buffer, count }); }
  setBuffer(buffer) { return Object.assign(this, { buffer }); }
}
export class Matrix4 {}
export const ShaderChunk = { aomap_fragment: "" };\n`,
  "addons/postprocessing/Pass.js": "export class Pass {}\n",
  "package.json": JSON.stringify({ type: "module", exports: { ".": "./index.js", "./addons/*": "./addons/*" } }),
};
for (const [name, text] of Object.entries(standIns)) {
  const path = join(folder, "node_modules/three", name);
  mkdirSync(join(path, ".."), { recursive: true });
  writeFileSync(path, text);
}
writeFileSync(join(folder, "package.json"), "{\"type\": \"module\"}\n");
copyFileSync(source, join(folder, "nook_three.js"));
const { NookThree } = await import(pathToFileURL(join(folder, "nook_three.js")));

class Attribute {
  constructor(array, itemSize) {
    Object.assign(this, { array, itemSize, count: array.length / itemSize });
  }
  // Like three.js, whose normalized integers are fractions.
  getComponent(i, component) {
    return this.array[i * this.itemSize + component] / (this.isNormalized ? 255 : 1);
  }
}
const webgl = { isContextLost: () => false, createBuffer: () => ({}), bindBuffer() {}, bufferData() {} };
const renderer = { getContext: () => webgl, resetState() {}, domElement: { addEventListener() {} } };
const nook = { createScene: () => ({ addInstance: () => 5 }), createGl: () => ({}) };

// A model of two primitives, of 4 and 3 vertices; `unmatched` of the answer by the primitive that is asked for.
function makeModel(unmatchedOf = () => 0, ambiguous = 0) {
  const calls = [], remaps = [];
  return {
    calls, remaps, info: { primitiveCount: 2, skinCount: 2 },
    skin: (index) => [{ fileIndex: 3, jointCount: 9 }, { fileIndex: 4, jointCount: 2 }][index],
    primitive: (index) => [{ first: 0, count: 4 }, { first: 4, count: 3 }][index],
    matchVertices(match) {
      calls.push(match);
      const count = match.positions.length / 3;
      return { vertices: Uint32Array.from({ length: count }, (_, i) => 4 + i), unmatched: unmatchedOf(match.primitive), ambiguous, text: "two fit" };
    },
    remap(vertices) {
      remaps.push(vertices);
      return { destroy() {} };
    },
  };
}
function makeMesh(attributes, index) {
  return { geometry: { attributes, index: index && { array: index } }, material: { clone: () => ({ dispose() {} }) }, skeleton: { bones: [{}, {}] } };
}
const position = new Attribute([0, 0, 0, 1, 0, 0, 0, 1, 0], 3), normal = new Attribute([0, 0, 1, 0, 0, 1, 0, 0, 1], 3);
const skinIndex = new Attribute(Uint16Array.from([0, 1, 1, 0, 0, 1]), 2), skinWeight = new Attribute([255, 0, 51, 204, 255, 0], 2);
skinWeight.isNormalized = true;

const all = makeModel();
const character = new NookThree(nook, renderer).add(all, makeMesh({ position, normal, skinIndex, skinWeight }, [0, 2, 1]));
// The primitive with as many vertices is tried, by all that the mesh has, in the skin with as many joints.
assert.deepEqual(all.calls, [{ positions: position.array, normals: normal.array, joints: [0, 1, 1, 0, 0, 1], weights: [1, 0, 0.2, 0.8, 1, 0], skin: 4,
  indices: [0, 2, 1], primitive: 1 }]);
assert.deepEqual(all.remaps, [[4, 5, 6]]);
assert.equal(character.instance, 5);

// A mesh without normals and index, where the primitive does not fit: the whole model is asked, and the vertices are the triangles.
const whole = makeModel((primitive) => Number(primitive === 1));
new NookThree(nook, renderer).add(whole, makeMesh({ position }));
assert.deepEqual(whole.calls.map(({ primitive }) => primitive), [1, undefined]);
for (const { normals, indices } of whole.calls) assert.deepEqual([normals, indices], [undefined, [0, 1, 2]]);

assert.throws(() => new NookThree(nook, renderer).add(makeModel(() => 2), makeMesh({ position })), /2 of 3 vertices are not in the model/);
const says = [], { warn } = console;
console.warn = (text) => says.push(text);
new NookThree(nook, renderer).add(makeModel(() => 0, 1), makeMesh({ position }));
console.warn = warn;
assert.deepEqual(says, ["NookThree.add: two fit"]);
console.log("nook-web/three gives positions, normals, weights and triangles to the match");
