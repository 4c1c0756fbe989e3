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
    const evaluate = (from, count, to) => this.library.module._nook_material_evaluate(this.handle, from, count, to);
    return this.#values("nook_material_sample", samples.map((sample) => ({ level: 0, ...sample })), evaluate);
  }
  // Decodes { uv, dx, dy, view, light } each, with that many fetches along the pixel.
  evaluateAnisotropic(pixels, fetches = 2) {
    const evaluate = (from, count, to) =>
      this.library.module._nook_material_evaluate_anisotropic(this.handle, from, count, fetches, to);
    return this.#values("nook_material_pixel", pixels, evaluate);
  }
  #values(struct, samples, evaluate) {
    const { library } = this;
    return library.call(() => {
      const input = library.layouts.struct(struct), output = library.layouts.struct("nook_material_value");
      const from = library.room.take(input.size * samples.length), to = library.room.take(output.size * samples.length);
      samples.forEach((sample, i) => library.layouts.write(input, from + i * input.size, sample));
      library.check(evaluate(from, samples.length, to));
      return samples.map((_, i) => library.layouts.read(output, to + i * output.size));
    });
  }
}
