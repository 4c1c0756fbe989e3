// Wrong arguments of nook-web: node arguments_test.mjs SOURCES FOLDER
// Each call must throw a NookError that names the function, the argument, what came and what is wanted, and must write nothing to the
// module's memory before.
import assert from "node:assert/strict";
import { addLayouts, copySources, makeModule } from "./stand_in.mjs";

const [sources, folder] = process.argv.slice(2);
const take = copySources(sources, folder);
const [{ Library }, { NookError }, { Context }, { Probe }, { Material }, { CharacterModel }] = await Promise.all(
  ["library", "error", "context", "probe", "material", "character"].map((name) => take(`${name}.js`)));

const module = makeModule();
const library = addLayouts(new Library(module));
const write = (struct, values) => (_, address) => {
  library.layouts.write(library.layouts.struct(struct), address, values);
  return 0;
};
const bones = 2, vertices = 5;
module._nook_model_describe = write("nook_model_info", { boneCount: bones, fileVertexCount: vertices, checkVertexCount: 2 });
module._nook_probe_describe = write("nook_probe_info", { functionCount: 12 });
const made = (name) => {
  module[`_${name}`] = (...values) => {
    module.HEAPU32[values.at(-1) >> 2] = 8;
    module.calls.push([name, ...values]);
    return 0;
  };
};
["nook_context_create", "nook_model_load", "nook_scene_create", "nook_scene_add_instance", "nook_scene_add_occluder", "nook_probe_fit_create",
  "nook_model_remap", "nook_material_load", "nook_probe_load", "nook_gl_create", "nook_nnao_create", "nook_gl_upload_probe"].forEach(made);

const nook = Context.make(library);
const bytes = new Uint8Array(8);
const model = nook.loadCharacter(bytes), probe = new Probe(library, 9), material = new Material(library, 10);
const scene = nook.createScene(), fit = nook.createProbeFit();
const id = scene.addInstance(model);
const webgl = { createTransformFeedback() {}, isContextLost: () => false };
const gl = nook.createGl(webgl), nnao = gl.createNnao({ maxWidth: 8, maxHeight: 8 });
const other = addLayouts(new Library(makeModule()));
const strange = new CharacterModel(Object.assign(other, { info: () => ({}) }), 4);

// What engines hand over where a list of numbers belongs. None of them has the right numbers under their indices.
class Vector3 { isVector3 = true; x = 0; y = 1; z = 0; toArray() { return [0, 1, 0]; } }
class Plane { isPlane = true; normal = new Vector3(); constant = 0; }
class Matrix4 { isMatrix4 = true; elements = Array(16).fill(0); }
class Skeleton { isSkeleton = true; boneMatrices = new Float32Array(32); }
const wrongLists = [undefined, new Vector3(), new Plane(), new Matrix4(), new Skeleton(), { x: 1, y: 2, z: 3 }, {}, "raw", "1234", 7, true, NaN,
  () => {}, new ArrayBuffer(64), new DataView(new ArrayBuffer(64)), new BigInt64Array(4), new Set([1, 2, 3, 4]), Promise.resolve([1, 2, 3]),
  Symbol("x"), 4n];
// Lists of `count` numbers that are wrong by number or value.
const wrongCounts = (count, { anyValue } = {}) => {
  const whole = Array(count).fill(0.5);
  const withOne = (value) => whole.map((each, i) => (i === count - 1 ? value : each));
  return [whole.slice(1), [...whole, 0], [], new Float32Array(count + 1), new Float64Array(count - 1), new Float32Array(4 * count + 1),
    withOne(undefined), withOne(null), withOne("1"), withOne([1]), withOne({}), withOne(1n), Array(count),
    ...(anyValue ? [] : [withOne(NaN), withOne(Infinity), new Float32Array(withOne(NaN))])];
};

let count = 0;
function refused(name, argument, call) {
  const { calls } = module;
  calls.length = 0;
  module.HEAPU8.fill(0xaa, library.room.block, library.room.block + library.room.capacity);
  const before = module.HEAPU8.slice();
  assert.throws(call, (error) => {
    assert.ok(error instanceof NookError, `${name}: ${error.stack}`);
    assert.equal(error.code, "NOOK_ERROR_INVALID_ARGUMENT");
    assert.ok(error.message.startsWith(`${name}: `), error.message);
    assert.ok(error.message.includes(argument), `${argument}: ${error.message}`);
    assert.match(error.message, /\(got .*need |needs .*\(got |it has |was made by/);
    return true;
  }, `${name} took a wrong ${argument}`);
  assert.deepEqual(module.HEAPU8, before, `${name} wrote before it refused ${argument}`);
  assert.deepEqual(calls.filter(([called]) => called === name), [], `${name} was called`);
  ++count;
}
function refusedLists(name, argument, length, call, { optional, anyValue } = {}) {
  for (const value of wrongLists) if (!(optional && value === undefined)) refused(name, argument, () => call(value));
  if (!optional) refused(name, argument, () => call(name === "nook_scene_set_ground" || name === "nook_scene_set_camera" ? 0 : null));
  for (const value of wrongCounts(length, { anyValue })) refused(name, argument, () => call(value));
}
const wrongNumbers = [undefined, null, NaN, "3", [3], {}, 3n];
const wrongIndices = [...wrongNumbers, -1, 1.5, 2 ** 32, Infinity];

const transforms = new Float32Array(16 * bones), positions = Array(9).fill(0);
refusedLists("nook_scene_set_ground", "plane", 4, (plane) => scene.setGround(id, plane));
refusedLists("nook_scene_set_camera", "position", 3, (position) => scene.setCamera(position));
refusedLists("nook_scene_add_occluder", "centre", 3, (centre) => scene.addOccluder({ centre, radius: 1 }));
refusedLists("nook_scene_set_occluder", "centre", 3, (centre) => scene.setOccluder(1, { centre, radius: 1 }));
for (const value of [undefined, null, 3, [], "x"]) refused("nook_scene_add_occluder", "occluder", () => scene.addOccluder(value));
for (const value of wrongNumbers) refused("nook_scene_add_occluder", "radius", () => scene.addOccluder({ centre: [0, 0, 0], radius: value }));
refused("nook_scene_add_occluder", "center", () => scene.addOccluder({ centre: [0, 0, 0], radius: 1, center: 1 }));
for (const value of wrongIndices) {
  refused("nook_scene_set_ground", "instance", () => scene.setGround(value, [0, 1, 0, 0]));
  refused("nook_scene_set_pose", "instance", () => scene.setPose(value, { transforms }));
  refused("nook_scene_link", "receiver", () => scene.link(value, id));
  refused("nook_scene_unlink", "caster", () => scene.unlink(id, value));
  refused("nook_scene_remove_instance", "instance", () => scene.removeInstance(value));
  refused("nook_scene_remove_occluder", "occluder", () => scene.removeOccluder(value));
  refused("nook_scene_read", "instance", () => scene.readAo(value));
  refused("nook_scene_link_nearest", "count", () => scene.linkNearest(value, 2));
  refused("nook_model_describe_primitive", "index", () => model.primitive(value));
  refused("nook_model_bone_name", "bone", () => model.boneName(value));
}
for (const value of [...wrongNumbers, -1]) refused("nook_scene_link_nearest", "maxDistance", () => scene.linkNearest(2, value));
refused("nook_scene_link_nearest", "count", () => scene.linkNearest());
for (const value of [undefined, null, {}, scene, 8, "m", strange]) refused("nook_scene_add_instance", "model", () => scene.addInstance(value));
refused("nook_scene_set_model", "model", () => scene.setModel(id, probe));
for (const value of [undefined, "self", { self: true }]) refused("nook_scene_set_terms", "terms", () => scene.setTerms(value));
refused("nook_scene_set_terms", "unknown", () => scene.setTerms(["sel"]));

// Poses.
refusedLists("nook_scene_set_pose", "transforms", 16 * bones, (value) => scene.setPose(id, { transforms: value }));
for (const layout of ["rows-3x4", "rows-4x4", "columns-4x4", "columns-4x3", "dual-quaternion", "trs"])
  refused("nook_scene_set_pose", "transforms", () => scene.setPose(id, { layout, transforms: new Float32Array(17) }));
for (const value of [undefined, null, transforms, "pose", 3]) refused("nook_scene_set_pose", "pose", () => scene.setPose(id, value));
refusedLists("nook_scene_set_pose", "place3x4", 12, (place3x4) => scene.setPose(id, { transforms, place3x4 }), { optional: true });
refused("nook_scene_set_pose", "transforms", () => scene.setPose(id, { transforms, transformCount: 3 }));
refused("nook_scene_set_pose", "transforms", () => scene.setPose(id, { transforms: transforms.subarray(0, 20), stride: 80, transformCount: 2 }));
refused("nook_scene_set_pose", "transformOfBone", () => scene.setPose(id, { transforms, transformOfBone: [0, 0.5] }));
refused("nook_scene_set_pose", "kind", () => scene.setPose(id, { transforms, kind: "skin" }));
refused("nook_scene_set_pose", "matrices", () => scene.setPose(id, { transforms, matrices: 1 }));
refusedLists("nook_model_convert_pose", "transforms", 16 * bones, (value) => model.convertPose({ transforms: value }));
for (const out of [new Float32Array(12 * bones - 1), [], Array(12 * bones), "out", new Int32Array(100)]) {
  refused("nook_model_convert_pose", "out", () => model.convertPose({ transforms }, out));
  if (out.length !== 23 && out.length !== 100) refused("nook_model_read", "out", () => model.staticAo(out));
}
refusedLists("nook_model_check_pose", "positions", 9, (value) => model.checkPose({ transforms }, { positions: value?.length === 0 ? [0] : value }));
refused("nook_model_check_pose", "checkVertices", () => model.checkPose({ transforms }, { positions, checkVertices: [1, 2] }));
refused("nook_model_check_pose", "vertices", () => model.checkPose({ transforms }));
for (const value of wrongLists) refused("nook_model_match_vertices", "positions", () => model.matchVertices({ positions: value }));
refused("nook_model_match_vertices", "match", () => model.matchVertices(positions));
refusedLists("nook_model_match_vertices", "normals", 9, (normals) => model.matchVertices({ positions, normals }), { optional: true });
refused("nook_model_match_vertices", "joints", () => model.matchVertices({ positions, joints: [0, 1], weights: [1, 0] }));
refused("nook_model_match_vertices", "joints", () => model.matchVertices({ positions, joints: [0, 1, 65536], weights: [1, 1, 1] }));
refused("nook_model_match_vertices", "weights", () => model.matchVertices({ positions, joints: [0, 1, 1], weights: [1, 1] }));
for (const indices of [7, "012", [0, 1], [0, 1, 0.5], [0, 1, NaN], [0, 1, -1], [0, 1, 3], { array: [0, 1, 2] }, [0, 1, "2"]])
  refused("nook_model_match_mesh", "indices", () => model.matchVertices({ positions, indices }));
{
  const names = () => module.calls.map(([name]) => name).filter((name) => name.startsWith("nook_model_match"));
  module.calls.length = 0;
  model.matchVertices({ positions });
  assert.deepEqual(names(), ["nook_model_match_vertices"]);
  module.calls.length = 0;
  model.matchVertices({ positions, indices: [2, 0, 1] });
  assert.deepEqual(names(), ["nook_model_match_mesh"]);
  const [, , , address, indexCount] = module.calls.find(([name]) => name === "nook_model_match_mesh");
  assert.deepEqual([...module.HEAPU32.slice(address >> 2, (address >> 2) + indexCount)], [2, 0, 1]);
}
for (const value of [...wrongLists, [0.5], [NaN], [2 ** 32], ["1"]]) refused("nook_model_remap", "vertices", () => model.remap(value));
for (const names of [undefined, "Hips", [1], [undefined], new Set(["a"]), { length: 1, 0: "a" }, [{ name: "Hips" }]])
  refused("nook_model_map_bones", "names", () => model.mapBones(names));

// Light.
const lobe = { axis: [0, 1, 0], sharpness: 2, amplitude: [1, 1, 1] };
for (const member of ["axis", "amplitude"])
  refusedLists("nook_scene_set_light", `lobes[1].${member}`, 3, (value) => scene.setLight(id, [lobe, { ...lobe, [member]: value }]));
for (const value of wrongNumbers) refused("nook_scene_set_light", "lobes[0].sharpness", () => scene.setLight(id, [{ ...lobe, sharpness: value }]));
for (const value of [undefined, {}, "lobes", new Float32Array(7), [1], [null]]) refused("nook_scene_set_light", "lobes", () => scene.setLight(id, value));
refusedLists("nook_probe_read_lobes", "position", 3, (position) => probe.lobes(position), { optional: true });
refusedLists("nook_probe_read_gloss", "position", 3, (position) => probe.glossLobes(position), { optional: true });
for (const value of [...wrongLists, [0, 1], [0, 1, NaN]]) {
  refused("nook_probe_irradiance", "normals", () => probe.irradiance(value));
  refused("nook_probe_radiance", "directions", () => probe.radiance(value));
}
for (const position of [new Vector3(), [0, 0], [0, 0, NaN], Array(9).fill(0), "xyz"])
  refused("nook_probe_irradiance", "position", () => probe.irradiance(Array(6).fill(0), position));
for (const value of wrongLists) refused("nook_probe_fit_add_samples", "directions", () => fit.addSamples(value, positions));
refusedLists("nook_probe_fit_add_samples", "radiance", 9, (value) => fit.addSamples(positions, value), { anyValue: true });
refusedLists("nook_probe_fit_add_samples", "weights", 3, (value) => fit.addSamples(positions, positions, value), { anyValue: true, optional: true });
refused("nook_probe_fit_merge", "other", () => fit.merge(probe));
refused("nook_probe_fit_create", "axes", () => nook.createProbeFit({ lobeCount: 3, axes: [0, 1, 0] }));
refused("nook_probe_fit_create", "sharpnesses", () => nook.createProbeFit({ axes: [0, 1, 0], sharpnesses: [1, 2] }));
refusedLists("nook_probe_fit_create", "up", 3, (up) => nook.createProbeFit({ up }), { optional: true });

// Materials.
const pixel = { uv: [0, 0], view: [0, 0, 1], light: [0, 0, 1] };
for (const [member, length] of [["uv", 2], ["view", 3], ["light", 3]])
  refusedLists("nook_material_evaluate", `pixels[0].${member}`, length, (value) => material.evaluate([{ ...pixel, [member]: value }]));
refusedLists("nook_material_evaluate", "dx", 2, (dx) => material.evaluate([{ ...pixel, dx }]), { optional: true });
for (const value of [undefined, pixel, "p", [3]]) refused("nook_material_evaluate", "pixels", () => material.evaluate(value));

// Files and options.
for (const value of [undefined, null, "hero.nook", [1, 2], 8, {}, Promise.resolve(bytes), new Response(bytes)]) {
  refused("nook_model_load", "bytes", () => nook.loadCharacter(value));
  refused("nook_probe_load", "bytes", () => nook.loadProbe(value));
  refused("nook_material_load", "bytes", () => nook.loadMaterial(value));
}
refused("nook_scene_create", "cutoff", () => nook.createScene({ cutoff: 1 }));
for (const value of [null, "1", NaN, [1], {}, true]) refused("nook_scene_create", "groundRadius", () => nook.createScene({ groundRadius: value }));

// WebGL.
const frame = { depthTexture: { made: "by WebGL" }, width: 8, height: 8, projection: Array(16).fill(0), radius: 1 };
for (const [member, length] of [["projection", 16], ["view", 16], ["normalMatrix", 9]])
  refusedLists("nook_nnao_render", member, length, (value) => nnao.render({ ...frame, [member]: value }), { optional: true });
for (const value of [null, NaN, "1", [1]]) refused("nook_nnao_render", "radius", () => nnao.render({ ...frame, radius: value }));
for (const value of wrongIndices.slice(1)) refused("nook_nnao_render", "width", () => nnao.render({ ...frame, width: value }));
refused("nook_nnao_render", "frame", () => nnao.render());
class DepthTexture { isTexture = true; name = ""; }
for (const value of [new DepthTexture(), 3, "depth", [1]])
  for (const member of ["depthTexture", "normalTexture", "motionVectors", "target"])
    refused("nook_nnao_render", member, () => nnao.render({ ...frame, [member]: value }));
assert.throws(() => nnao.render({ ...frame, depthTexture: new DepthTexture() }),
  /depthTexture needs a WebGLTexture \(got a DepthTexture; with three\.js, pass renderer\.properties/);
refused("nook_nnao_create", "options", () => gl.createNnao());
refused("nook_nnao_create", "maxWidth", () => gl.createNnao({ maxWidth: "8" }));
refused("nook_nnao_create", "network", () => gl.createNnao({ maxWidth: 8, maxHeight: 8, network: "file" }));
for (const value of [undefined, {}, model, 4]) {
  refused("nook_gl_scene_update", "scene", () => gl.update(value));
  refused("nook_gl_scene_view", "scene", () => gl.view(value, id));
  refused("nook_gl_upload_probe", "probe", () => gl.uploadProbe(value));
}
refused("nook_gl_scene_view", "channel", () => gl.view(scene, id, "bent"));
refused("nook_gl_scene_write", "instances", () => gl.writeAo(scene, id, { buffer: {} }));
refused("nook_gl_scene_write", "buffer", () => gl.writeAo(scene, [id], { buffer: new Float32Array(4) }));

// What is right goes through: arrays, typed arrays, array-likes, null where it means none, and bytes in every form.
scene.setGround(id, [0, 1, 0, 0]);
scene.setGround(id, new Float64Array(4));
scene.setGround(id, { length: 4, 0: 0, 1: 1, 2: 0, 3: 0 });
scene.setGround(id, null);
scene.setCamera(null);
scene.setLight(id, null);
scene.setLight(id, [lobe]);
scene.setPose(id, { transforms });
scene.setPose(id, { transforms, surplus: true, transformOfBone: new Int32Array([0, -1]), place3x4: Array(12).fill(0) });
scene.setPose(id, { transforms: new Float32Array(36), stride: 80 });
scene.linkNearest(0, Infinity);
scene.addOccluder({ centre: [0, 0, 0], radius: 1 });
fit.addSamples(new Float32Array(9).fill(NaN), positions);
model.convertPose({ transforms }, new Float32Array(12 * bones));
model.convertPose({ transforms }, new Float32Array(99));
model.remap([0, 0xffffffff]);
model.mapBones(["Hips", null]);
probe.irradiance([0, 1, 0, 1, 0, 0], [0, 0, 0]);
material.evaluate([pixel]);
for (const file of [bytes.buffer, bytes, new DataView(bytes.buffer), new Uint16Array(4), Buffer.alloc(8)]) nook.loadCharacter(file);
nnao.render(frame);
nnao.render({ ...frame, target: null, normalTexture: null });

// A lost context: nothing is called in it, what to do is said, and destroying works in any order.
for (const tell of [true, false]) {
  let isLost = false, listener = null;
  const canvas = { addEventListener: (name, call) => (listener = call) };
  const context = { createTransformFeedback() {}, isContextLost: () => isLost, canvas };
  const lost = nook.createGl(context), pass = lost.createNnao({ maxWidth: 8, maxHeight: 8 }), upload = lost.uploadProbe(probe);
  lost.update(scene);
  const throwsLost = (name, call) => {
    module.calls.length = 0;
    assert.throws(call, (error) => error instanceof NookError && error.code === "NOOK_ERROR_GL" &&
      error.message.startsWith(`${name}: the WebGL context was lost; `) && /destroy the Gl/.test(error.message), name);
    assert.deepEqual(module.calls, []);
  };
  const all = () => {
    throwsLost("nook_gl_scene_update", () => lost.update(scene));
    throwsLost("nook_gl_scene_prepare", () => lost.prepare(scene));
    throwsLost("nook_gl_scene_release", () => lost.release(scene));
    throwsLost("nook_gl_scene_view", () => lost.view(scene, id));
    throwsLost("nook_gl_scene_read", () => lost.read(scene, id));
    throwsLost("nook_gl_scene_write", () => lost.writeAo(scene, [id], { buffer: {} }));
    throwsLost("nook_nnao_render", () => pass.render(frame));
    throwsLost("nook_nnao_describe", () => pass.texture);
    throwsLost("nook_nnao_create", () => lost.createNnao({ maxWidth: 8, maxHeight: 8 }));
    throwsLost("nook_gl_upload_probe", () => lost.uploadProbe(probe));
    throwsLost("nook_gl_update_probe", () => upload.update(probe));
    throwsLost("nook_gl_upload_describe", () => upload.info);
    throwsLost("nook_gl_upload_bind", () => upload.bind({}));
  };
  isLost = true;
  all();
  assert.throws(() => nook.createGl(context), /Context\.createGl: the WebGL context is lost; call it after "webglcontextrestored"/);
  // The context is back, and what was made in it before is dead.
  listener();
  isLost = false;
  all();
  if (tell) lost.contextLost();
  const again = nook.createGl(context);
  again.update(scene);
  module.calls.length = 0;
  lost.destroy();
  assert.equal(module.calls.filter(([name]) => name === "nook_gl_context_lost").length, 1);
  pass.destroy();
  upload.destroy();
  again.update(scene);
  again.destroy();
}
console.log(`arguments: ${count} wrong ones are refused by name`);
