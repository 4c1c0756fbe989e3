import { Owned } from "./library.js";

// The address of an array of nook_lobe.
export function lobeStruct(library, lobes) {
  const { layouts } = library;
  const struct = layouts.struct("nook_lobe");
  const address = library.room.take(struct.size * lobes.length);
  library.module.HEAPU8.fill(0, address, address + struct.size * lobes.length);
  lobes.forEach((lobe, i) => layouts.write(struct, address + i * struct.size, lobe));
  return address;
}

// A position for each direction, of one that is for all; undefined stays so.
function forEach(position, directions) {
  if (position?.length !== 3) return position;
  return Float32Array.from(directions, (_, i) => position[i % 3]);
}

// A light probe or a grid of them; see nook_probe.h.
export class Probe extends Owned {
  constructor(library, handle) {
    super(library, handle, "nook_probe_destroy");
  }
  get info() {
    return this.library.info("nook_probe_describe", "nook_probe_info", (info) => this.library.module._nook_probe_describe(this.handle, info));
  }

  // The lobes at a point, or those of the first probe: { axis, sharpness, amplitude } each.
  lobes(position) {
    const { library } = this;
    const count = this.info.functionCount;
    return library.call("nook_probe_read_lobes", () => {
      const { size } = library.layouts.struct("nook_lobe");
      const address = library.room.take(size * count);
      library.check(library.module._nook_probe_read_lobes(this.handle, library.floats(position), address, count));
      return Array.from({ length: count }, (_, i) => library.read("nook_lobe", address + i * size));
    });
  }

  // Three floats for each function of a probe of the grid.
  coefficients(index = 0) {
    const { library } = this;
    const count = this.info.functionCount;
    return library.call("nook_probe_read_coefficients", () => library.readFloats("nook_probe_read_coefficients", 3 * count, undefined, (address) =>
      library.module._nook_probe_read_coefficients(this.handle, index, address, count)));
  }

  // Three floats for each direction or normal. The position is one for all, or one for each.
  radiance(directions, position) {
    const { library } = this;
    return library.call("nook_probe_radiance", () => library.readFloats("nook_probe_radiance", directions.length, undefined, (address) => library.module._nook_probe_radiance(
      this.handle, library.floats(forEach(position, directions)), library.floats(directions), address, directions.length / 3)));
  }
  irradiance(normals, position) {
    const { library } = this;
    return library.call("nook_probe_irradiance", () => library.readFloats("nook_probe_irradiance", normals.length, undefined, (address) => library.module._nook_probe_irradiance(
      this.handle, library.floats(forEach(position, normals)), library.floats(normals), address, normals.length / 3)));
  }
}

// Least squares of lobes, while samples of radiance arrive.
export class ProbeFit extends Owned {
  constructor(library, handle) {
    super(library, handle, "nook_probe_fit_destroy");
  }
  addSamples(directions, radiance, weights) {
    const { library } = this;
    library.call("nook_probe_fit_add_samples", () => library.check(library.module._nook_probe_fit_add_samples(this.handle, library.floats(directions),
      library.floats(radiance), library.floats(weights), directions.length / 3)));
  }
  // Adds the samples of another fit with the same options.
  merge(other) {
    this.library.check(this.library.module._nook_probe_fit_merge(this.handle, other.handle));
  }
  reset() {
    this.library.check(this.library.module._nook_probe_fit_reset(this.handle));
  }
  get info() {
    return this.library.info("nook_probe_fit_describe", "nook_probe_fit_info", (info) => this.library.module._nook_probe_fit_describe(this.handle, info));
  }
  // The probe of the samples so far.
  solve() {
    const { library } = this;
    return new Probe(library, library.call("nook_probe_fit_solve", () =>
      library.made((out) => library.module._nook_probe_fit_solve(this.handle, out))));
  }
}
