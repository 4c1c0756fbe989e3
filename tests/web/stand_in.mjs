// A module of JavaScript that stands for WebAssembly in tests of nook-web: its calls succeed and are noted, and its memory is watched.
import { copyFileSync, mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

// The sources in a folder where node takes them for modules; import(name) of one.
export function copySources(sources, folder) {
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, "package.json"), "{\"type\": \"module\"}\n");
  for (const name of readdirSync(sources)) if (name.endsWith(".js")) copyFileSync(join(sources, name), join(folder, name));
  return (name) => import(pathToFileURL(join(folder, name)));
}

// Members as "type name[count]": f float, i and u of 32 bits, p address.
const structs = {
  nook_context_desc: "p log, i isa, f units_per_metre",
  nook_scene_desc: "f ground_radius, f lod_distance, i form",
  nook_probe_fit_desc: "p axes, p sharpnesses, u lobe_count, f sharpness, f up[3]",
  nook_pose_desc: "u flags, i kind, i layout, u stride, u transform_count, u skin, u bone_count, p transforms, p transform_of_bone, p place_3x4",
  nook_bone_map_desc: "u flags, p names, u name_count",
  nook_pose_check_desc: "u vertex_count, p positions, p check_vertices, p place_3x4, f tolerance",
  nook_pose_check_info: "i fault",
  nook_vertex_match_desc: "u vertex_count, p positions, p normals, u primitive, i in_rest_space, f tolerance, p joints, p weights, u influences, u skin",
  nook_vertex_match_info: "u unmatched, u ambiguous",
  nook_model_info: "u bone_count, u file_vertex_count, u check_vertex_count",
  nook_occluder: "f centre_ws[3], f radius, u receiver",
  nook_lobe: "f axis[3], f sharpness, f amplitude[3]",
  nook_probe_info: "u function_count",
  nook_probe_fit_info: "u samples",
  nook_material_pixel: "f uv[2], f dx[2], f dy[2], f view[3], f light[3]",
  nook_material_value: "f radiance[3], f occlusion, f visibility",
  nook_gl_desc: "p get_proc, i state_mode",
  nook_gl_view: "u buffer, u offset, u stride, u count, u texture",
  nook_gl_ao_target: "u buffer, u texture, i format, u offset",
  nook_gl_frame_desc: "u width, u height, u viewport[4], u depth_texture, u normal_texture, u gbuffer_ao_texture, i target, u target_name, " +
    "f projection[16], f view[16], f normal_matrix[9]",
  nook_nnao_frame_desc: "p next, f radius, f intensity, u motion_vectors, f motion_vector_scale[2], i reset, f power, f scene_size, " +
    "f max_radius_px, f min_radius_px, f fade_begin, f fade_end, i radius_kind",
  nook_nnao_desc: "u max_width, u max_height, p network, p network_size",
  nook_nnao_info: "u texture",
  nook_gl_upload_info: "u bytes",
};
const groups = {
  "bits NOOK_DESC_CONTEXT": Object.keys(structs).filter((name) => name.endsWith("_desc")).map((name) => name.slice(5, -5).replaceAll("_", "-")),
  "bits NOOK_POSE_FLAG_PARTIAL": ["partial", "strict", "surplus"],
  "bits NOOK_BONE_MAP_LOOSE": ["loose", "drop-shared-prefix"],
  "bits NOOK_TERM_SELF": ["self", "links", "ground", "occluders", "all"],
  nook_pose_kind: ["rest-to-world", "joint-to-world", "skinning"],
  nook_transform_layout: ["rows-3x4", "rows-4x4", "columns-4x4", "columns-4x3", "dual-quaternion", "trs"],
  nook_channel: ["ao", "directional-ao"],
  nook_gl_probe_form: ["lobes", "sh", "zh3"],
  nook_isa: ["auto", "scalar"],
  nook_gl_state_mode: ["defaults", "preserve", "host"],
  nook_gl_target: ["own", "texture", "framebuffer"],
};
const choices = { kind: "nook_pose_kind", layout: "nook_transform_layout", isa: "nook_isa", stateMode: "nook_gl_state_mode", target: "nook_gl_target" };
const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());

const blockBytes = 1 << 20;
export function makeModule() {
  const buffer = new ArrayBuffer(blockBytes);
  const known = {
    HEAPU8: new Uint8Array(buffer), HEAPU32: new Uint32Array(buffer), HEAP32: new Int32Array(buffer), HEAPF32: new Float32Array(buffer),
    HEAPF64: new Float64Array(buffer), calls: [], next: 1024,
    _malloc(size) {
      known.next += size;
      return known.next - size;
    },
    _free() {}, _nook_version: () => 1, _nook_web_constants: () => 0, _nook_web_fields: () => 0, _nook_desc_init: () => 0,
    UTF8ToString: () => "",
    GL: { contexts: [], buffers: [], textures: [], framebuffers: [], registerContext: () => 1, makeContextCurrent() {}, getNewId: (table) => table.length || 1 },
  };
  // Every other function of the library notes its name and arguments, and succeeds.
  return new Proxy(known, {
    get: (object, name) => object[name] ?? (typeof name === "string" && name.startsWith("_nook_") ? (...values) => {
      known.calls.push([name.slice(1), ...values]);
      return 0;
    } : undefined),
    set: (object, name, value) => {
      object[name] = value;
      return true;
    },
  });
}

// Gives the library the layouts above.
export function addLayouts(library) {
  const { layouts } = library;
  for (const [group, words] of Object.entries(groups))
    layouts.constants.set(group, { numbers: new Map(words.map((word, i) => [word, group.startsWith("bits") ? 1 << i : i])), wordOf: new Map() });
  for (const [name, members] of Object.entries(structs)) {
    const fields = new Map();
    let offset = 4;
    for (const member of members.split(", ")) {
      const [, type, path, count] = /^(\w) (\w+?)(?:\[(\d+)\])?$/.exec(member), field = camel(path);
      fields.set(field, { offset, type, count: Number(count ?? 1), constants: choices[field] ? layouts.constants.get(choices[field]) : null });
      offset += 4 * Number(count ?? 1);
    }
    layouts.structs.set(name, { name, size: offset, fields });
  }
  return library;
}
