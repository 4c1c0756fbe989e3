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
    this.surface.current(() => super.destroy());
    this.surface.removeUser();
  }
}

// Makes an object of class Kind on a surface by call(out), which calls the function `name`.
export function makeOnSurface(Kind, library, surface, name, call) {
  surface.addUser();
  try {
    return new Kind(library, surface.current(() => library.call(name, () => library.made(call))), surface);
  } finally {
    surface.removeUser();
  }
}
