import { Owned } from "./library.js";

const floatsOfLayout = { "rows-3x4": 12, "rows-4x4": 16, "columns-4x4": 16, "columns-4x3": 12, "dual-quaternion": 8, trs: 10 };

// The address of a nook_pose_desc for an object such as
//   { kind: "skinning", layout: "columns-4x4", transforms, skin, transformOfBone, place3x4, partial, strict }.
export function poseDescriptor(library, pose) {
  const { transforms, transformOfBone, place3x4, partial, strict, ...others } = pose;
  const floats = floatsOfLayout[pose.layout ?? "columns-4x4"] ?? 16;
  const flags = library.layouts.bits("NOOK_POSE_FLAG_PARTIAL", [...(partial ? ["partial"] : []), ...(strict ? ["strict"] : [])]);
  return library.descriptor("nook_pose_desc", {
    transformCount: Math.floor(transforms.length / floats),
    ...others,
    flags,
    transforms: library.floats(transforms),
    transformOfBone: library.integers(transformOfBone),
    boneCount: transformOfBone ? transformOfBone.length : 0,
    place3x4: library.floats(place3x4),
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
    const text = this.library.module._nook_model_bone_name(this.handle, bone);
    return text ? this.library.module.UTF8ToString(text) : null;
  }
  get boneNames() {
    return Array.from({ length: this.#info.boneCount }, (_, bone) => this.boneName(bone));
  }

  // The first AO value and the number of AO values of a primitive of the file.
  primitive(index) {
    const { library } = this;
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

  // The joint count and rest space of skin number `index`, one of info.skinCount.
  skin(index) {
    return this.library.info("nook_model_describe_skin", "nook_skin_info", (info) => this.library.module._nook_model_describe_skin(this.handle, index, info));
  }
  // Vertex number `index` of checkPose, one of info.checkVertexCount.
  checkVertex(index) {
    return this.library.info("nook_model_describe_check_vertex", "nook_check_vertex_info", (info) =>
      this.library.module._nook_model_describe_check_vertex(this.handle, index, info));
  }

  // Finds the host's transform of each bone by name: { transformOfBone, unmatched }.
  mapBones(names, { loose, dropSharedPrefix } = {}) {
    const { library } = this;
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
      const description = poseDescriptor(library, pose);
      return library.readFloats("nook_model_convert_pose", 12 * this.#info.boneCount, out, (address) => {
        if (out) library.module.HEAPF32.set(out, address >> 2);
        return library.module._nook_model_convert_pose(this.handle, description, address, this.#info.boneCount);
      });
    });
  }

  // Compares a pose with vertices that the host skinned itself: { fault, maxError, rmsError, worstBone, text, ... }.
  checkPose(pose, { positions, checkVertices, place3x4, tolerance }) {
    const { library } = this;
    return library.call("nook_model_check_pose", () => {
      const description = poseDescriptor(library, pose);
      const check = library.descriptor("nook_pose_check_desc", {
        vertexCount: positions.length / 3,
        positions: library.floats(positions),
        checkVertices: library.integers(checkVertices),
        place3x4: library.floats(place3x4),
        tolerance,
      });
      return library.info("nook_model_check_pose", "nook_pose_check_info",
        (info) => library.module._nook_model_check_pose(this.handle, description, check, info));
    });
  }

  // Finds the model's vertex for each vertex of a host's mesh by rest position: { vertices, unmatched }.
  matchVertices({ positions, normals, primitive, inRestSpace, tolerance }) {
    const { library } = this;
    return library.call("nook_model_match_vertices", () => {
      const count = positions.length / 3;
      const match = library.descriptor("nook_vertex_match_desc", {
        vertexCount: count, positions: library.floats(positions), normals: library.floats(normals),
        primitive, inRestSpace: inRestSpace ? 1 : 0, tolerance,
      });
      const vertices = library.room32(count), unmatched = library.room32(1);
      library.check(library.module._nook_model_match_vertices(this.handle, match, vertices, unmatched));
      return {
        vertices: library.module.HEAPU32.slice(vertices >> 2, (vertices >> 2) + count),
        unmatched: library.module.HEAPU32[unmatched >> 2],
      };
    });
  }

  // A model whose vertices are those of a host's mesh, by the answer of matchVertices.
  remap(vertices) {
    const { library } = this;
    const handle = library.call("nook_model_remap", () => library.made((out) =>
      library.module._nook_model_remap(this.handle, library.integers(vertices), vertices.length, out)));
    return new CharacterModel(library, handle);
  }
}
