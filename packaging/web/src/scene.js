import { checkIndex, checkList, checkNumber, checkNumbers, checkObject } from "./arguments.js";
import { CharacterModel, preparedPose } from "./character.js";
import { Owned } from "./library.js";
import { preparedLobes } from "./probe.js";

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

  #modelOf(model) {
    return this.library.handleOf(model, "model", CharacterModel, "CharacterModel");
  }
  // Calls a function that takes instances or other numbers of the scene. `numbers` are pairs [argument, value].
  #ofNumbers(name, numbers, call) {
    return this.library.call(name, () => {
      for (const [argument, value] of numbers) checkIndex(name, argument, value);
      return this.#check(call(...numbers.map(([, value]) => value)));
    });
  }

  addInstance(model) {
    const { library } = this;
    const id = library.call("nook_scene_add_instance", () => {
      const handle = this.#modelOf(model);
      return library.made((out) => library.module._nook_scene_add_instance(this.handle, handle, out));
    });
    this.#vertices.set(id, model.info.fileVertexCount);
    return id;
  }
  removeInstance(instance) {
    this.#ofNumbers("nook_scene_remove_instance", [["instance", instance]], (id) => this.library.module._nook_scene_remove_instance(this.handle, id));
    this.#vertices.delete(instance);
  }
  setModel(instance, model) {
    this.#ofNumbers("nook_scene_set_model", [["instance", instance]], (id) =>
      this.library.module._nook_scene_set_model(this.handle, id, this.#modelOf(model)));
    this.#vertices.set(instance, model.info.fileVertexCount);
  }
  // The number of AO values of an instance.
  vertexCount(instance) {
    return this.#vertices.get(instance) ?? 0;
  }

  // Pass transforms that the host already has, such as skinning matrices of glTF: { kind: "skinning", layout: "columns-4x4",
  // transforms }.
  setPose(instance, pose) {
    const { library } = this;
    library.call("nook_scene_set_pose", () => {
      checkIndex(library.name, "instance", instance);
      const description = preparedPose(library, pose);
      this.#check(library.module._nook_scene_set_pose(this.handle, instance, description()));
    });
  }

  link(receiver, caster) {
    this.#ofNumbers("nook_scene_link", [["receiver", receiver], ["caster", caster]], (...ids) =>
      this.library.module._nook_scene_link(this.handle, ...ids));
  }
  unlink(receiver, caster) {
    this.#ofNumbers("nook_scene_unlink", [["receiver", receiver], ["caster", caster]], (...ids) =>
      this.library.module._nook_scene_unlink(this.handle, ...ids));
  }
  linkNearest(count, maxDistance) {
    this.#ofNumbers("nook_scene_link_nearest", [["count", count]], () => {
      checkNumber("nook_scene_link_nearest", "maxDistance", maxDistance, { least: 0 });
      return this.library.module._nook_scene_link_nearest(this.handle, count, maxDistance);
    });
  }

  // plane: normal and offset, or null for none.
  setGround(instance, plane) {
    this.#ofNumbers("nook_scene_set_ground", [["instance", instance]], (id) => {
      if (plane !== null) checkNumbers("nook_scene_set_ground", "plane", plane, { count: 4, why: "(normal and offset), or null for none" });
      return this.library.module._nook_scene_set_ground(this.handle, id, this.library.floats(plane));
    });
  }

  #occluder(occluder) {
    const call = this.library.name;
    checkObject(call, "occluder", occluder, "an object { centre, radius, receiver }");
    const { centre, radius, receiver = 0, ...unknown } = occluder;
    checkNumbers(call, "centre", centre, { count: 3 });
    checkNumber(call, "radius", radius);
    checkIndex(call, "receiver", receiver);
    return this.library.struct("nook_occluder", { centreWs: centre, radius, receiver, ...unknown });
  }
  // receiver: the only instance that the sphere darkens; 0: every instance.
  addOccluder(occluder) {
    const { library } = this;
    return library.call("nook_scene_add_occluder", () => {
      const description = this.#occluder(occluder);
      return library.made((out) => library.module._nook_scene_add_occluder(this.handle, description, out));
    });
  }
  setOccluder(occluder, options) {
    this.#ofNumbers("nook_scene_set_occluder", [["occluder", occluder]], (id) =>
      this.library.module._nook_scene_set_occluder(this.handle, id, this.#occluder(options)));
  }
  removeOccluder(occluder) {
    this.#ofNumbers("nook_scene_remove_occluder", [["occluder", occluder]], (id) => this.library.module._nook_scene_remove_occluder(this.handle, id));
  }

  // lobes: an array of { axis, sharpness, amplitude }, such as the result of Probe.lobes(); null for no light.
  setLight(instance, lobes) {
    this.#ofNumbers("nook_scene_set_light", [["instance", instance]], (id) => {
      const array = lobes === null ? () => 0 : preparedLobes(this.library, lobes);
      return this.library.module._nook_scene_set_light(this.handle, id, array(), lobes === null ? 0 : lobes.length);
    });
  }

  // position: three numbers, or null for none.
  setCamera(position) {
    const { library } = this;
    library.call("nook_scene_set_camera", () => {
      if (position !== null) checkNumbers(library.name, "position", position, { count: 3, why: "or null for none" });
      this.#check(library.module._nook_scene_set_camera(this.handle, library.floats(position)));
    });
  }
  // terms: a list of "self", "links", "ground", "occluders", "all".
  setTerms(terms) {
    const { library } = this, name = "nook_scene_set_terms";
    checkList(name, "terms", terms, "words", () => {});
    const bits = library.layouts.bits("NOOK_TERM_SELF", terms, name);
    this.#check(library.module._nook_scene_set_terms(this.handle, bits));
  }

  // Evaluates everything on the CPU. Gl.update does this on the GPU.
  update() {
    this.#check(this.library.module._nook_scene_update(this.handle));
  }
  readAo(instance, out) {
    checkIndex("nook_scene_read", "instance", instance);
    const count = this.vertexCount(instance);
    return this.library.readFloats("nook_scene_read", count, out, (address) =>
      this.library.module._nook_scene_read(this.handle, instance, channelAo, formatFloat, address, count, 0));
  }
  readDirectionalAo(instance, out) {
    checkIndex("nook_scene_read", "instance", instance);
    const count = this.vertexCount(instance);
    return this.library.readFloats("nook_scene_read", 3 * count, out, (address) =>
      this.library.module._nook_scene_read(this.handle, instance, channelDirectionalAo, formatFloat, address, count, 0));
  }
  get info() {
    return this.library.info("nook_scene_describe", "nook_scene_info", (info) => this.library.module._nook_scene_describe(this.handle, info));
  }
}
