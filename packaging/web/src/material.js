import { Owned } from "./library.js";

// A compressed material; see nook_material.h.
export class Material extends Owned {
  constructor(library, handle) {
    super(library, handle, "nook_material_destroy");
  }
  get info() {
    return this.library.info("nook_material_describe", "nook_material_info", (info) => this.library.module._nook_material_describe(this.handle, info));
  }
  // Decodes { uv, dx, dy, view, light } each, with that many fetches along the pixel: { radiance, occlusion, visibility }. Without dx
  // and dy, a pixel has no size and sees the finest level.
  evaluate(pixels, fetches = 1) {
    const { library } = this;
    return library.call("nook_material_evaluate", () => {
      const input = library.layouts.struct("nook_material_pixel"), output = library.layouts.struct("nook_material_value");
      const from = library.room.take(input.size * pixels.length), to = library.room.take(output.size * pixels.length);
      pixels.forEach((pixel, i) => library.layouts.write(input, from + i * input.size, { dx: [0, 0], dy: [0, 0], ...pixel }));
      library.check(library.module._nook_material_evaluate(this.handle, from, pixels.length, fetches, to));
      return pixels.map((_, i) => library.layouts.read(output, to + i * output.size));
    });
  }
}
