import { Owned } from "./library.js";

// A compressed material; see nook_material.h.
export class Material extends Owned {
  constructor(library, handle) {
    super(library, handle, "nook_material_destroy");
  }
  get info() {
    return this.library.info("nook_material_info", (info) => this.library.module._nook_material_describe(this.handle, info));
  }
  // Decodes { uv, level, view, light } each: { radiance, occlusion, visibility }.
  evaluate(samples) {
    const { library } = this;
    return library.call(() => {
      const input = library.layouts.struct("nook_material_sample"), output = library.layouts.struct("nook_material_value");
      const from = library.room.take(input.size * samples.length), to = library.room.take(output.size * samples.length);
      samples.forEach((sample, i) => library.layouts.write(input, from + i * input.size, { level: 0, ...sample }));
      library.check(library.module._nook_material_evaluate(this.handle, from, samples.length, to));
      return samples.map((_, i) => library.layouts.read(output, to + i * output.size));
    });
  }
}
