import { checkIndex, checkList, checkNumber, checkNumbers, checkObject } from "./arguments.js";
import { Owned } from "./library.js";

// Checks lobes, and returns a function that makes an array of nook_lobe from them.
export function preparedLobes(library, lobes) {
  const { layouts, name: call } = library;
  const struct = layouts.struct("nook_lobe");
  const checked = [];
  checkList(call, "lobes", lobes, "{ axis, sharpness, amplitude }", (lobe, argument) => {
    checkObject(call, argument, lobe, "an object { axis, sharpness, amplitude }");
    for (const member of ["axis", "amplitude"]) checkNumbers(call, `${argument}.${member}`, lobe[member], { count: 3 });
    checkNumber(call, `${argument}.sharpness`, lobe.sharpness);
    checked.push(layouts.check(struct, lobe, call));
  });
  return () => {
    const address = library.room.take(struct.size * checked.length);
    library.module.HEAPU8.fill(0, address, address + struct.size * checked.length);
    checked.forEach((lobe, i) => layouts.store(address + i * struct.size, lobe));
    return address;
  };
}

// Repeats a single position for each direction. Returns other positions unchanged, and undefined if there is none.
function forEach(call, position, argument, directions) {
  checkNumbers(call, argument, directions, { groupsOf: 3 });
  if (position?.length !== 3)
    checkNumbers(call, "position", position, { count: directions.length, why: `(3 for all, or as many as ${argument})`, optional: true });
  else checkNumbers(call, "position", position);
  if (position?.length !== 3) return position;
  return Float32Array.from(directions, (_, i) => position[i % 3]);
}

// A light probe, or a grid of light probes; see nook_probe.h.
export class Probe extends Owned {
  constructor(library, handle) {
    super(library, handle, "nook_probe_destroy");
  }
  get info() {
    return this.library.info("nook_probe_describe", "nook_probe_info", (info) => this.library.module._nook_probe_describe(this.handle, info));
  }

  // Returns the lobes at a point, or the lobes of the first probe, each as { axis, sharpness, amplitude }.
  lobes(position) {
    return this.#readLobes("nook_probe_read_lobes", position);
  }
  // Like lobes(), but for glossy reflection: amplitudes are never negative.
  glossLobes(position) {
    return this.#readLobes("nook_probe_read_gloss", position);
  }
  #readLobes(name, position) {
    const { library } = this;
    checkNumbers(name, "position", position, { count: 3, optional: true });
    const count = this.info.functionCount;
    return library.call(name, () => {
      const { size } = library.layouts.struct("nook_lobe");
      const address = library.room.take(size * count);
      library.check(library.module[`_${name}`](this.handle, library.floats(position), address, count));
      return Array.from({ length: count }, (_, i) => library.read("nook_lobe", address + i * size));
    });
  }

  // Returns three floats for each function of a probe of the grid.
  coefficients(index = 0) {
    checkIndex("nook_probe_read_coefficients", "index", index);
    const { library } = this;
    const count = this.info.functionCount;
    return library.call("nook_probe_read_coefficients", () => library.readFloats("nook_probe_read_coefficients", 3 * count, undefined, (address) =>
      library.module._nook_probe_read_coefficients(this.handle, index, address, count)));
  }

  // These functions return three floats for each direction or normal. Pass one position for all of them, or one for each.
  radiance(directions, position) {
    return this.#evaluate("nook_probe_radiance", "directions", directions, position);
  }
  irradiance(normals, position) {
    return this.#evaluate("nook_probe_irradiance", "normals", normals, position);
  }
  #evaluate(name, argument, directions, position) {
    const { library } = this;
    return library.call(name, () => {
      const positions = forEach(name, position, argument, directions);
      return library.readFloats(name, directions.length, undefined, (address) => library.module[`_${name}`](
        this.handle, library.floats(positions), library.floats(directions), address, directions.length / 3));
    });
  }
}

// Fits lobes by least squares while samples of radiance arrive.
export class ProbeFit extends Owned {
  constructor(library, handle) {
    super(library, handle, "nook_probe_fit_destroy");
  }
  addSamples(directions, radiance, weights) {
    const { library } = this;
    library.call("nook_probe_fit_add_samples", () => {
      // The fit skips samples that are not finite, and counts them.
      checkNumbers(library.name, "directions", directions, { groupsOf: 3, anyValue: true });
      checkNumbers(library.name, "radiance", radiance, { count: directions.length, why: "(as many as directions)", anyValue: true });
      checkNumbers(library.name, "weights", weights,
        { count: directions.length / 3, why: "(one for each direction)", anyValue: true, optional: true });
      library.check(library.module._nook_probe_fit_add_samples(this.handle, library.floats(directions), library.floats(radiance),
        library.floats(weights), directions.length / 3));
    });
  }
  // Adds the samples of another fit with the same options.
  merge(other) {
    const { library } = this;
    library.call("nook_probe_fit_merge", () => library.check(
      library.module._nook_probe_fit_merge(this.handle, library.handleOf(other, "other", ProbeFit, "ProbeFit"))));
  }
  reset() {
    this.library.check(this.library.module._nook_probe_fit_reset(this.handle));
  }
  get info() {
    return this.library.info("nook_probe_fit_describe", "nook_probe_fit_info", (info) => this.library.module._nook_probe_fit_describe(this.handle, info));
  }
  // Returns a probe from the samples so far.
  solve() {
    const { library } = this;
    return new Probe(library, library.call("nook_probe_fit_solve", () =>
      library.made((out) => library.module._nook_probe_fit_solve(this.handle, out))));
  }
}
