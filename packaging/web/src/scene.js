import { poseDescriptor } from "./character.js";
import { Owned } from "./library.js";
import { lobeStruct } from "./probe.js";

// NOOK_CHANNEL_AO, NOOK_CHANNEL_DIRECTIONAL_AO and NOOK_FORMAT_FLOAT.
const channelAo = 0, channelDirectionalAo = 1, formatFloat = 0;

// Instances of characters with poses, links, ground, occluders and lights; see nook_character.h. Instances and occluders are
// numbers.
export class Scene extends Owned {
  #vertices = new Map();  // of each instance
  constructor(library, handle) {
    super(library, handle, "nook_scene_destroy");
  }

  #check(result) {
    return this.library.check(result);
  }

  addInstance(model) {
    const { library } = this;
    const id = library.call("nook_scene_add_instance", () =>
      library.made((out) => library.module._nook_scene_add_instance(this.handle, model.handle, out)));
    this.#vertices.set(id, model.info.fileVertexCount);
    return id;
  }
  removeInstance(instance) {
    this.#check(this.library.module._nook_scene_remove_instance(this.handle, instance));
    this.#vertices.delete(instance);
  }
  setModel(instance, model) {
    this.#check(this.library.module._nook_scene_set_model(this.handle, instance, model.handle));
    this.#vertices.set(instance, model.info.fileVertexCount);
  }
  // The number of AO values of an instance.
  vertexCount(instance) {
    return this.#vertices.get(instance) ?? 0;
  }

  // The transforms that the host has, such as skinning matrices of glTF: { kind: "skinning", layout: "columns-4x4", transforms }.
  setPose(instance, pose) {
    const { library } = this;
    library.call("nook_scene_set_pose", () => this.#check(
      library.module._nook_scene_set_pose(this.handle, instance, poseDescriptor(library, pose))));
  }

  link(receiver, caster) {
    this.#check(this.library.module._nook_scene_link(this.handle, receiver, caster));
  }
  unlink(receiver, caster) {
    this.#check(this.library.module._nook_scene_unlink(this.handle, receiver, caster));
  }
  linkNearest(count, maxDistance) {
    this.#check(this.library.module._nook_scene_link_nearest(this.handle, count, maxDistance));
  }

  // plane: normal and offset, or null for none.
  setGround(instance, plane) {
    const { library } = this;
    library.call("nook_scene_set_ground", () => this.#check(library.module._nook_scene_set_ground(this.handle, instance, library.floats(plane))));
  }

  // receiver: the only instance that the sphere darkens; 0: every instance.
  addOccluder({ centre, radius, receiver = 0 }) {
    const { library } = this;
    return library.call("nook_scene_add_occluder", () => library.made((out) => library.module._nook_scene_add_occluder(this.handle,
      library.struct("nook_occluder", { centreWs: centre, radius, receiver }), out)));
  }
  setOccluder(occluder, { centre, radius, receiver = 0 }) {
    const { library } = this;
    library.call("nook_scene_set_occluder", () => this.#check(library.module._nook_scene_set_occluder(this.handle, occluder,
      library.struct("nook_occluder", { centreWs: centre, radius, receiver }))));
  }
  removeOccluder(occluder) {
    this.#check(this.library.module._nook_scene_remove_occluder(this.handle, occluder));
  }

  // lobes: { axis, sharpness, amplitude } each, such as those of Probe.lobes(); null for no light.
  setLight(instance, lobes) {
    const { library } = this;
    library.call("nook_scene_set_light", () => this.#check(library.module._nook_scene_set_light(this.handle, instance,
      lobes ? lobeStruct(library, lobes) : 0, lobes ? lobes.length : 0)));
  }

  setCamera(position) {
    const { library } = this;
    library.call("nook_scene_set_camera", () => this.#check(library.module._nook_scene_set_camera(this.handle, library.floats(position))));
  }
  // terms: a list of "self", "links", "ground", "occluders", "all".
  setTerms(terms) {
    const { library } = this;
    this.#check(library.module._nook_scene_set_terms(this.handle, library.layouts.bits("NOOK_TERM_SELF", terms)));
  }

  // Evaluates everything on the CPU; Gl.update does it on the GPU instead.
  update() {
    this.#check(this.library.module._nook_scene_update(this.handle));
  }
  readAo(instance, out) {
    const count = this.vertexCount(instance);
    return this.library.readFloats("nook_scene_read", count, out, (address) =>
      this.library.module._nook_scene_read(this.handle, instance, channelAo, formatFloat, address, count, 0));
  }
  readDirectionalAo(instance, out) {
    const count = this.vertexCount(instance);
    return this.library.readFloats("nook_scene_read", 3 * count, out, (address) =>
      this.library.module._nook_scene_read(this.handle, instance, channelDirectionalAo, formatFloat, address, count, 0));
  }
  get info() {
    return this.library.info("nook_scene_describe", "nook_scene_info", (info) => this.library.module._nook_scene_describe(this.handle, info));
  }
}
