import { checkIndex, checkList, checkNumbers, checkNumber, checkObject, checkOut, described, refuse } from "./arguments.js";
import { Owned } from "./library.js";

const floatsOfLayout = { "rows-3x4": 12, "rows-4x4": 16, "columns-4x4": 16, "columns-4x3": 12, "dual-quaternion": 8, trs: 10 };

// Checks a pose such as { kind: "skinning", layout: "columns-4x4", transforms, skin, transformOfBone, place3x4, partial, strict,
// surplus }, and returns a function that makes a nook_pose_desc of it.
export function preparedPose(library, pose) {
  const call = library.name;
  checkObject(call, "pose", pose, "an object such as { transforms }");
  const { transforms, transformOfBone, place3x4, partial, strict, surplus, ...others } = pose;
  const { layout = "columns-4x4", stride, transformCount } = pose;
  const floats = floatsOfLayout[layout] ?? 16;
  // Transforms that no bone uses may contain any values.
  const anyValue = Boolean(transformOfBone || surplus || stride || transformCount !== undefined);
  const why = `(${floats} for each transform of the layout "${layout}")`;
  checkNumber(call, "stride", stride, { whole: true, least: 0, optional: true });
  checkNumber(call, "transformCount", transformCount, { whole: true, least: 0, optional: true });
  checkNumbers(call, "transforms", transforms, { anyValue, why, least: floats, ...(stride || transformCount !== undefined ? {} : { groupsOf: floats }) });
  const step = stride ? stride / 4 : floats;
  const count = transformCount ?? (transforms.length < floats ? 0 : Math.floor((transforms.length - floats) / step) + 1);
  checkNumbers(call, "transforms", transforms, { anyValue: true, least: count > 0 ? Math.ceil((count - 1) * step) + floats : 0,
    why: `for ${count} transforms` });
  checkNumbers(call, "transformOfBone", transformOfBone, { whole: true, optional: true });
  checkNumbers(call, "place3x4", place3x4, { count: 12, why: "(3 rows of 4)", optional: true });
  const flags = library.layouts.bits("NOOK_POSE_FLAG_PARTIAL",
    Object.entries({ partial, strict, surplus }).filter(([, isSet]) => isSet).map(([word]) => word));
  return library.prepared("nook_pose_desc", {
    ...others,
    transformCount: count,
    flags,
    transforms: () => library.floats(transforms),
    transformOfBone: () => library.integers(transformOfBone),
    boneCount: transformOfBone ? transformOfBone.length : 0,
    place3x4: () => library.floats(place3x4),
  });
}

// A baked character; see nook_character.h.
export class CharacterModel extends Owned {
  #info;
  constructor(library, handle) {
    super(library, handle, "nook_model_destroy");
    this.#info = library.info("nook_model_describe", "nook_model_info", (info) => library.module._nook_model_describe(handle, info));
  }

  // Counts and sizes: boneCount, fileVertexCount, ...
  get info() {
    return this.#info;
  }

  boneName(bone) {
    checkIndex("nook_model_bone_name", "bone", bone);
    const text = this.library.module._nook_model_bone_name(this.handle, bone);
    return text ? this.library.module.UTF8ToString(text) : null;
  }
  get boneNames() {
    return Array.from({ length: this.#info.boneCount }, (_, bone) => this.boneName(bone));
  }

  // The first AO value and the number of AO values of a primitive of the file.
  primitive(index) {
    const { library } = this;
    checkIndex("nook_model_describe_primitive", "index", index);
    return library.call("nook_model_describe_primitive", () => {
      const range = library.struct("nook_range");
      library.check(library.module._nook_model_describe_primitive(this.handle, index, range));
      return library.read("nook_range", range);
    });
  }

  staticAo(out) {
    const count = this.#info.fileVertexCount;
    return this.library.readFloats("nook_model_read", count, out, (address) =>
      this.library.module._nook_model_read(this.handle, 0 /* NOOK_MODEL_STATIC_AO */, address, count, 0));
  }

  // Returns the joint count and the rest space of the skin `index`, from 0 to info.skinCount - 1.
  skin(index) {
    checkIndex("nook_model_describe_skin", "index", index);
    return this.library.info("nook_model_describe_skin", "nook_skin_info", (info) => this.library.module._nook_model_describe_skin(this.handle, index, info));
  }
  // Returns the vertex `index` for checkPose, from 0 to info.checkVertexCount - 1.
  checkVertex(index) {
    checkIndex("nook_model_describe_check_vertex", "index", index);
    return this.library.info("nook_model_describe_check_vertex", "nook_check_vertex_info", (info) =>
      this.library.module._nook_model_describe_check_vertex(this.handle, index, info));
  }

  // Finds the host's transform of each bone by name: { transformOfBone, unmatched }.
  mapBones(names, { loose, dropSharedPrefix } = {}) {
    const { library } = this;
    checkList("nook_model_map_bones", "names", names, "texts", (name, argument) => name === null || typeof name === "string" ||
      refuse("nook_model_map_bones", `${argument} needs a text or null (got ${described(name)})`));
    return library.call("nook_model_map_bones", () => {
      const flags = library.layouts.bits("NOOK_BONE_MAP_LOOSE",
        [...(loose ? ["loose"] : []), ...(dropSharedPrefix ? ["drop-shared-prefix"] : [])]);
      const description = library.descriptor("nook_bone_map_desc", { flags, names: library.texts(names), nameCount: names.length });
      const count = this.#info.boneCount;
      const map = library.room32(count), unmatched = library.room32(1);
      library.check(library.module._nook_model_map_bones(this.handle, description, map, count, unmatched));
      return {
        transformOfBone: library.module.HEAP32.slice(map >> 2, (map >> 2) + count),
        unmatched: library.module.HEAPU32[unmatched >> 2],
      };
    });
  }

  // Converts a host's transforms to rest-to-world matrices, 12 floats for each bone in rows.
  convertPose(pose, out) {
    const { library } = this;
    return library.call("nook_model_convert_pose", () => {
      const count = 12 * this.#info.boneCount;
      checkOut(library.name, out, count);
      const description = preparedPose(library, pose);
      return library.readFloats("nook_model_convert_pose", count, out, (address) => {
        if (out) library.module.HEAPF32.set(out.subarray(0, count), address >> 2);
        return library.module._nook_model_convert_pose(this.handle, description(), address, this.#info.boneCount);
      });
    });
  }

  // Compares a pose with vertices that the host skinned itself: { fault, maxError, rmsError, worstBone, text, ... }.
  checkPose(pose, vertices) {
    const { library } = this;
    return library.call("nook_model_check_pose", () => {
      checkObject(library.name, "vertices", vertices, "an object such as { positions }");
      const { positions, checkVertices, place3x4, tolerance } = vertices;
      checkNumbers(library.name, "positions", positions, { groupsOf: 3 });
      const count = positions.length / 3;
      checkNumbers(library.name, "checkVertices", checkVertices, { count, why: "(one for each position)", whole: true, optional: true });
      checkNumbers(library.name, "place3x4", place3x4, { count: 12, why: "(3 rows of 4)", optional: true });
      const description = preparedPose(library, pose);
      const check = library.prepared("nook_pose_check_desc", {
        vertexCount: count,
        positions: () => library.floats(positions),
        checkVertices: () => library.integers(checkVertices),
        place3x4: () => library.floats(place3x4),
        tolerance,
      });
      return library.info("nook_model_check_pose", "nook_pose_check_info",
        (info) => library.module._nook_model_check_pose(this.handle, description(), check(), info));
    });
  }

  // Finds the model's vertex for each vertex of a host's mesh: { vertices, unmatched, ambiguous, text }. If you pass `indices`,
  // three for each triangle, the sides of triangles also distinguish vertices.
  matchVertices(match) {
    const { library } = this;
    const isMesh = match?.indices !== undefined && match?.indices !== null;
    return library.call(isMesh ? "nook_model_match_mesh" : "nook_model_match_vertices", () => {
      checkObject(library.name, "match", match, "an object such as { positions, normals }");
      const { positions, normals, joints, weights, indices, inRestSpace, ...others } = match;
      checkNumbers(library.name, "positions", positions, { groupsOf: 3 });
      checkNumbers(library.name, "normals", normals, { count: positions.length, why: "(as many as positions)", optional: true });
      const count = positions.length / 3;
      checkNumbers(library.name, "joints", joints, { groupsOf: count || 1, why: "(as many for each position)", whole: true, optional: true });
      checkNumbers(library.name, "weights", weights, { count: joints?.length ?? 0, why: "(as many as joints)", optional: true });
      for (let i = 0; i < (joints?.length ?? 0); ++i)
        if (joints[i] < 0 || joints[i] > 65535) refuse(library.name, `joints needs numbers from 0 to 65535 (got ${joints[i]} in place ${i})`);
      checkNumbers(library.name, "indices", indices, { groupsOf: 3, why: "(three for each triangle)", whole: true, optional: true });
      for (let i = 0; isMesh && i < indices.length; ++i)
        if (indices[i] < 0 || indices[i] >= count)
          refuse(library.name, `indices needs numbers below ${count}, the count of the vertices (got ${indices[i]} in place ${i})`);
      const description = library.descriptor("nook_vertex_match_desc", {
        ...others, vertexCount: count, positions: () => library.floats(positions), normals: () => library.floats(normals),
        inRestSpace: inRestSpace ? 1 : 0, weights: () => library.floats(weights),
        joints: () => (joints ? library.bytes(Uint16Array.from(joints)).address : 0),
        ...(joints && { influences: joints.length / (count || 1) }),
      });
      const vertices = library.room32(count);
      const { unmatched, ambiguous, text } = library.info(library.name, "nook_vertex_match_info", (info) => isMesh
        ? library.module._nook_model_match_mesh(this.handle, description, library.integers(indices), indices.length, vertices, info)
        : library.module._nook_model_match_vertices(this.handle, description, vertices, info));
      return { vertices: library.module.HEAPU32.slice(vertices >> 2, (vertices >> 2) + count), unmatched, ambiguous, text };
    });
  }

  // Returns a model with its vertices in the order of a host's mesh. Pass the result of matchVertices.
  remap(vertices) {
    const { library } = this;
    const handle = library.call("nook_model_remap", () => {
      checkNumbers(library.name, "vertices", vertices, { whole: true });
      return library.made((out) => library.module._nook_model_remap(this.handle, library.integers(vertices), vertices.length, out));
    });
    return new CharacterModel(library, handle);
  }
}
