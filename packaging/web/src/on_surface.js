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

// Makes an object of class Kind by call(out) on a surface.
export function makeOnSurface(Kind, library, surface, call) {
  surface.addUser();
  try {
    return new Kind(library, surface.current(() => library.call(() => library.made(call))), surface);
  } finally {
    surface.removeUser();
  }
}
