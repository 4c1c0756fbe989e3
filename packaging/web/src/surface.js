// The module's view of a WebGL 2 context of the host. The module identifies WebGL objects by their indices in tables. Each context
// has its own tables here, so nothing remains of a lost context. The host's objects are in the tables only during a call.
import { NookError } from "./error.js";

const tables = ["buffers", "programs", "framebuffers", "renderbuffers", "textures", "shaders", "vaos", "samplers",
  "transformFeedbacks", "syncs", "queries"];

export class Surface {
  #GL;
  #context;
  #own = {};
  #names = new WeakMap();
  #users = 0;
  #handle;
  #isLost = false;

  static of(GL, context) {
    const known = Surface.#known.get(context);
    if (known && known.#GL === GL && known.#users > 0 && !known.isLost) return known;
    const surface = new Surface(GL, context);
    Surface.#known.set(context, surface);
    return surface;
  }
  static #known = new WeakMap();

  constructor(GL, context) {
    this.#GL = GL;
    this.#context = context;
    this.forget();
    const canvas = context.canvas, before = canvas?.GLctxObject;
    this.#handle = GL.registerContext(context, { majorVersion: 2, minorVersion: 0, enableExtensionsByDefault: false });
    if (canvas) canvas.GLctxObject = before;
    // Remembers the loss, because a restored context has lost all its objects, but its isContextLost() returns false again.
    canvas?.addEventListener?.("webglcontextlost", () => (this.#isLost = true), { once: true });
  }

  // Returns whether the context was lost since the surface was made.
  get isLost() {
    this.#isLost ||= this.#context.isContextLost?.() === true;
    return this.#isLost;
  }
  // Throws if the context is lost. WebGL would ignore the calls, and reads would leave the old memory contents. `name` is the
  // function that is called.
  alive(name) {
    if (!this.isLost) return;
    throw new NookError(`${name}: the WebGL context was lost; draw nothing until "webglcontextrestored", then destroy the Gl and ` +
      "everything that it made, and make all of them again, beginning with createGl", "NOOK_ERROR_GL");
  }

  // Call this when the context is lost: it has no objects any more.
  lose() {
    this.#isLost = true;
    this.forget();
  }
  forget() {
    for (const table of tables) if (this.#GL[table]) this.#own[table] = [];
  }

  get context() {
    return this.#context;
  }

  // Counts the objects that use the surface. Each object adds itself once and removes itself once.
  addUser() {
    ++this.#users;
  }
  removeUser() {
    if (--this.#users === 0) this.#GL.contexts[this.#handle] = null;
  }

  // Runs body, which destroys an object. In a lost context there is nothing to delete.
  leave(body) {
    if (this.isLost) this.forget();
    return this.#run(body);
  }
  // Runs body while the module's functions draw to this context. name: the function that body calls.
  current(name, body) {
    this.alive(name);
    return this.#run(body);
  }
  #run(body) {
    const GL = this.#GL;
    const before = {};
    for (const table of Object.keys(this.#own)) {
      before[table] = GL[table];
      GL[table] = this.#own[table];
    }
    GL.makeContextCurrent(this.#handle);
    try {
      return body();
    } finally {
      GL.makeContextCurrent(0);
      for (const table of Object.keys(this.#own)) GL[table] = before[table];
    }
  }

  // Returns the WebGL object with the index `name`.
  object(table, name) {
    return this.#own[table][name] ?? null;
  }
  // Returns the number of objects in the tables.
  get objectCount() {
    return Object.values(this.#own).reduce((sum, table) => sum + table.filter(Boolean).length, 0);
  }

  // Puts the host's objects into the tables, calls body with their indices, and removes them again. An object gets the same index
  // at each call. `objects` are [table, object or null] pairs.
  lend(objects, body) {
    const lent = [];
    const names = objects.map(([table, object]) => {
      if (!object) return 0;
      if (this.#own[table][object.name] === object) return object.name;
      if (!this.#names.has(object)) this.#names.set(object, this.#GL.getNewId(this.#own[table]));
      const name = this.#names.get(object);
      lent.push({ table: this.#own[table], object, name, before: object.name });
      this.#own[table][name] = object;
      object.name = name;
      return name;
    });
    try {
      return body(...names);
    } finally {
      for (const { table, object, name, before } of lent) {
        table[name] = null;
        if (before === undefined) delete object.name;
        else object.name = before;
      }
    }
  }
}
