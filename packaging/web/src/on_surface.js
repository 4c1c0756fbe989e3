import { Owned } from "./library.js";

// An object of the library that lives in a WebGL context.
export class OnSurface extends Owned {
  constructor(library, handle, destroy, surface) {
    super(library, handle, destroy);
    this.surface = surface;
    surface.addUser();
  }
  destroy() {
    if (!this.address) return;
    this.surface.leave(() => super.destroy());
    this.surface.removeUser();
  }
}

// Makes an object of class Kind on a surface. prepare() checks the arguments, and returns call(out), which calls the function
// `name`.
export function makeOnSurface(Kind, library, surface, name, prepare) {
  surface.addUser();
  try {
    surface.alive(name);
    const make = () => {
      const call = prepare();
      return library.made(call);
    };
    return new Kind(library, surface.current(name, () => library.call(name, make)), surface);
  } finally {
    surface.removeUser();
  }
}
