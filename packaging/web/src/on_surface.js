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

// Makes an object of the library by call(out) on a surface.
export function makeOnSurface(library, surface, call) {
  surface.addUser();
  try {
    return surface.current(() => library.call(() => library.made(call)));
  } finally {
    surface.removeUser();
  }
}
