// The light: a sky with a soft lamp as a function of direction, and a probe of twelve lobes that Nook fits to it.
import { dot, normalise } from "./matrix.js";

const samples = 4000;

export function lampDirection(azimuth, height) {
  return normalise([Math.cos(azimuth) * Math.cos(height), Math.sin(height), Math.sin(azimuth) * Math.cos(height)]);
}

// Linear radiance. The lamp is a lobe as wide as a window.
function radiance(direction, lamp, strength) {
  const up = direction[1];
  const sky = [0.42 + 0.26 * Math.max(up, 0), 0.5 + 0.32 * Math.max(up, 0), 0.62 + 0.42 * Math.max(up, 0)];
  const floor = [0.26, 0.23, 0.2];
  const blend = Math.min(1, Math.max(0, 0.5 + 4 * up));
  const lobe = strength * 9 * Math.exp(14 * (dot(direction, lamp) - 1));
  const warm = [1, 0.86, 0.66];
  return [0, 1, 2].map((i) => 0.55 * (floor[i] + (sky[i] - floor[i]) * blend) + lobe * warm[i]);
}

// Fits a probe of lobes to the sky. The caller destroys the probe.
export function fitProbe(nook, lamp, strength) {
  const directions = new Float32Array(3 * samples), colours = new Float32Array(3 * samples);
  for (let i = 0; i < samples; ++i) {
    const y = 1 - (2 * i + 1) / samples, r = Math.sqrt(1 - y * y), angle = i * 2.39996323;
    const direction = [r * Math.cos(angle), y, r * Math.sin(angle)];
    directions.set(direction, 3 * i);
    colours.set(radiance(direction, lamp, strength), 3 * i);
  }
  const fit = nook.createProbeFit({ lobeCount: 12, method: "least-squares-non-negative" });
  try {
    fit.addSamples(directions, colours);
    return fit.solve();
  } finally {
    fit.destroy();
  }
}
