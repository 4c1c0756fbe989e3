// Tests the installed package in node, on the CPU only: node package_test.mjs DATA_FOLDER
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { NookError, load } from "nook-web";

const data = process.argv[2];
const folder = dirname(createRequire(import.meta.url).resolve("nook-web/package.json"));
const wasm = readFileSync(join(folder, "nook.wasm"));
// Loads the module without a server, from its own folder and from bytes, and checks the message if this fails.
assert.equal((await load()).version, (await load({ wasm })).version);
await assert.rejects(load({ wasm: new URL("missing.wasm", import.meta.url) }), /nook-web: .*missing\.wasm .*load\(\{ wasm \}\)/);
await assert.rejects(load({ wasm: wasm.subarray(0, 1000) }), /nook-web: the WebAssembly module cannot be loaded \(/);
// The glue must name the .wasm file that the package contains, so that bundlers find it.
for (const [, name] of readFileSync(join(folder, "nook.mjs"), "utf8").matchAll(/["'`]([\w.]+\.wasm)["'`]/g)) assert.equal(name, "nook.wasm");
const nook = await load({ wasm });
const { version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
assert.equal(nook.version, version);

// Errors must be exceptions with the library's message, and must name what is wrong.
assert.throws(() => nook.loadCharacter(new Uint8Array(10)), (error) => error instanceof NookError &&
  error.code === "NOOK_ERROR_BAD_FILE" && error.message.startsWith("nook_model_load: "));
assert.throws(() => nook.createScene({ cutoff: 1 }), /nook_scene_desc has no cutoff; it has .*cutoffError/);
assert.throws(() => nook.createScene({ form: "both" }), /form is unknown \(got "both", need default, paper\)/);
assert.throws(() => nook.createScene({ groundRadius: -1 }), /nook_scene_create: .*ground_radius/);
assert.throws(() => nook.createGl({}), /not a WebGL2RenderingContext/);

// Rest-to-world matrices and skinning matrices of one pose must give the same AO.
const model = nook.loadCharacter(readFileSync(join(data, "character.nook")));
const { boneCount, fileVertexCount, skinCount, checkVertexCount } = model.info;
const bones = new Float32Array(12 * boneCount), skinning = new Float32Array(16 * boneCount);
// In the rest pose, the skinning matrices map the space of the mesh to rest space. They are stored by columns.
const rows = model.skin(0).restFromMesh3x4;
const columns = [0, 1, 2, 3].flatMap((c) => [rows[c], rows[4 + c], rows[8 + c], c === 3 ? 1 : 0]);
for (let b = 0; b < boneCount; ++b) {
  bones.set([1, 0, 0, 0.25, 0, 1, 0, 0, 0, 0, 1, 0], 12 * b);
  skinning.set(columns, 16 * b);
}
const scene = nook.createScene();
const [first, second] = [scene.addInstance(model), scene.addInstance(model)];
const own = { kind: "rest-to-world", layout: "rows-3x4", transforms: bones };
scene.setPose(first, own);
scene.setPose(second, { kind: "skinning", layout: "columns-4x4", transforms: skinning, place3x4: [1, 0, 0, 0.25, 0, 1, 0, 0, 0, 0, 1, 0] });
for (const instance of [first, second]) scene.setGround(instance, [0, 1, 0, 0]);
scene.update();
const ao = scene.readAo(first), other = scene.readAo(second);
assert.equal(ao.length, fileVertexCount);
// Only rounding errors may remain.
assert.ok(ao.every((value, i) => Math.abs(value - other[i]) < 1e-5));
assert.deepEqual([...model.mapBones(model.boneNames).transformOfBone], [...Array(boneCount).keys()]);
const check = model.checkPose(own, {
  positions: Array.from({ length: checkVertexCount }, (_, i) => model.checkVertex(i).position).flatMap((p) => [p[0] + 0.25, p[1], p[2]]) });
assert.equal(check.fault, "none", check.text);
assert.throws(() => model.checkVertex(checkVertexCount), /nook_model_describe_check_vertex: index is out of range/);
assert.equal(skinCount, 1);
assert.throws(() => model.skin(skinCount), /nook_model_describe_skin: skin is out of range/);
// Passes the vertices of the mannequin in reverse order, first with positions only, then with triangles, too. Equal vertices
// have equal AO.
const { positions: places, indices: triangles } = JSON.parse(readFileSync(join(data, "character.json"), "utf8")).arrays;
const { buffer } = Uint8Array.from(readFileSync(join(data, "character.bin")));
const rest = new Float32Array(buffer, places.offset, places.length), index = new Uint32Array(buffer, triangles.offset, triangles.length);
const positions = Float32Array.from(rest, (_, i) => rest[3 * (fileVertexCount - 1 - Math.floor(i / 3)) + (i % 3)]);
const indices = index.map((vertex) => fileVertexCount - 1 - vertex);
const staticAo = model.staticAo();
for (const given of [{}, { indices }]) {
  const { vertices, unmatched, ambiguous, text } = model.matchVertices({ positions, inRestSpace: true, ...given });
  assert.deepEqual([unmatched, ambiguous, text], [0, 0, ""]);
  vertices.forEach((vertex, i) => assert.equal(staticAo[vertex], staticAo[fileVertexCount - 1 - i]));
}
assert.throws(() => model.matchVertices({ positions, indices: [0, 1, fileVertexCount] }), /nook_model_match_mesh: indices needs numbers below .* in place 2\)/);
bones.fill(NaN, 0, 12);
assert.throws(() => scene.setPose(first, own), /nook_scene_set_pose: /);
scene.destroy();
scene.destroy();
assert.throws(() => scene.update(), /the Scene is destroyed/);
model.destroy();

// A probe of constant light must have the irradiance of this light, which is pi times the radiance.
const fit = nook.createProbeFit({ lobeCount: 12 });
const directions = Array.from({ length: 500 }, (_, i) => {
  const y = 1 - (2 * i + 1) / 500, r = Math.sqrt(1 - y * y);
  return [r * Math.cos(2.39996 * i), y, r * Math.sin(2.39996 * i)];
}).flat();
fit.addSamples(directions, directions.map(() => 2));
const probe = fit.solve();
// Spherical harmonics up to band 4 are within 0.2 % at this sharpness, and the lobes themselves within 1 %.
for (const value of probe.irradiance([0, 1, 0, 1, 0, 0])) assert.ok(Math.abs(value / (2 * Math.PI) - 1) < 0.012);
// One position for all normals must give the same result as one position for each normal.
assert.deepEqual(probe.irradiance([0, 1, 0, 1, 0, 0], [0, 0, 0]), probe.irradiance([0, 1, 0, 1, 0, 0], [0, 0, 0, 0, 0, 0]));
assert.equal(probe.lobes().length, 12);
const half = nook.createProbeFit();
half.addSamples(directions, directions.map(() => 2));
half.merge(fit);
assert.equal(half.info.samples, 1000);
half.solve().coefficients().forEach((value, i) => assert.ok(Math.abs(value - probe.coefficients()[i]) < 1e-4));
half.destroy();
assert.equal(fit.info.samples, 500);

// Without memory, a call must throw, and nothing may be written at address 0, which malloc returns.
{
  const { module } = nook.library, malloc = module._malloc, before = module.HEAPU8.slice(0, 1024);
  const large = new Float32Array(9000000);
  module._malloc = () => 0;
  assert.throws(() => nook.loadCharacter(new Uint8Array(40000000)), (error) => error instanceof NookError &&
    error.code === "NOOK_ERROR_OUT_OF_MEMORY" && error.message.startsWith("nook_model_load: no memory for 40000000 bytes"));
  assert.throws(() => nook.createProbeFit().addSamples(large, large), /nook_probe_fit_add_samples: no memory for 36000000 bytes/);
  module._malloc = malloc;
  assert.deepEqual(module.HEAPU8.subarray(0, 1024), before);
  nook.createScene().destroy();
}

// Freed memory must be used again. The loop makes more scenes than would fit into memory at once.
const before = nook.memoryBytes;
for (let i = 0; i < 2000; ++i) nook.createScene().destroy();
assert.equal(nook.memoryBytes, before);

// A word in place of numbers, and too few numbers, must be refused with the name of the member.
for (const view of ["raw", [1, 0, 0]])
  assert.throws(() => nook.library.call("nook_nnao_render", () => nook.library.descriptor("nook_gl_frame_desc", { view })), /nook_gl_frame_desc: view needs 16 numbers/);

// The types must contain every struct member and word that an option takes.
const types = readFileSync(join(folder, "index.d.ts"), "utf8");
const { layouts } = nook.library;
// The web API leaves out texture arrays and multisampled depth, because WebGL 2 has no multisampled textures.
const leftOut = ["views", "viewProjections", "viewMatrices", "viewNormalMatrices", "depthSamples",
  "normalSamples"];
for (const name of ["nook_scene_desc", "nook_pose_desc", "nook_gl_frame_desc", "nook_nnao_frame_desc", "nook_nnao_desc", "nook_probe_fit_desc", "nook_gl_ao_target",
  "nook_model_info", "nook_scene_info", "nook_material_info", "nook_probe_info", "nook_gl_info"])
  for (const path of layouts.struct(name).fields.keys())
    for (const member of path.split("."))
      if (!["structSize", "type", "next", "reserved", "flags", "boneCount", "targetName", "networkSize", ...leftOut].includes(member))
        assert.match(types, new RegExp(`\\b${member}\\b`), `index.d.ts lacks ${name}.${member}`);
for (const group of ["nook_pose_kind", "nook_transform_layout", "nook_pose_fault", "nook_gbuffer_ao", "nook_nnao_view", "nook_clip_space",
  "nook_probe_method", "nook_probe_basis", "nook_form", "nook_format"])
  for (const word of layouts.constants.get(group).numbers.keys())
    // Signed bytes are only for bent normals, and the web API only reads AO.
    if (word !== "snorm8") assert.ok(types.includes(`"${word}"`), `index.d.ts lacks "${word}"`);
console.log(`nook-web ${version}: the installed package holds its checks in node`);
