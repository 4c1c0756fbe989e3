import { checkIndex, checkList, checkNumbers, checkObject } from "./arguments.js";
import { Owned } from "./library.js";

// A compressed material; see nook_material.h.
export class Material extends Owned {
  constructor(library, handle) {
    super(library, handle, "nook_material_destroy");
  }
  get info() {
    return this.library.info("nook_material_describe", "nook_material_info", (info) => this.library.module._nook_material_describe(this.handle, info));
  }
  // Decodes pixels, each { uv, dx, dy, view, light }, with `fetches` fetches along each pixel. Returns { radiance, occlusion,
  // visibility }. Without dx and dy, a pixel has no size and reads the finest level.
  evaluate(pixels, fetches = 1) {
    const { library } = this;
    return library.call("nook_material_evaluate", () => {
      const input = library.layouts.struct("nook_material_pixel"), output = library.layouts.struct("nook_material_value");
      checkIndex(library.name, "fetches", fetches);
      const checked = [];
      checkList(library.name, "pixels", pixels, "{ uv, view, light }", (pixel, argument) => {
        checkObject(library.name, argument, pixel, "an object { uv, view, light }");
        for (const [member, count] of [["uv", 2], ["view", 3], ["light", 3]])
          checkNumbers(library.name, `${argument}.${member}`, pixel[member], { count });
        const { dx = [0, 0], dy = [0, 0] } = pixel;
        checked.push(library.layouts.check(input, { ...pixel, dx, dy }, library.name));
      });
      const from = library.room.take(input.size * pixels.length), to = library.room.take(output.size * pixels.length);
      library.module.HEAPU8.fill(0, from, from + input.size * pixels.length);
      checked.forEach((pixel, i) => library.layouts.store(from + i * input.size, pixel));
      library.check(library.module._nook_material_evaluate(this.handle, from, pixels.length, fetches, to));
      return pixels.map((_, i) => library.layouts.read(output, to + i * output.size));
    });
  }
}
