// The page loads the data, holds the state that the panel changes, and draws frames. Read this file first, then crowd.js (a
// scene of Nook) and renderer.js (Nook beside a host's own WebGL).
// Imports by path. An import map would be an inline script in the page, which strict content security policies forbid.
import { load } from "./node_modules/nook-web/index.js";
import { readAddress, readTime, writeAddress } from "./address.js";
import { fetchBytes, fetchCharacter, fetchShowcase } from "./character.js";
import { Crowd } from "./crowd.js";
import { makePanel } from "./panel.js";
import { Renderer } from "./renderer.js";
import { fitProbe, lampDirection } from "./sky.js";

const initial = {
  on: true, view: "lit", count: 12, neighbours: 4, ground: true, characterAo: true, screenAo: true, radius: 0.45, light: "lobes", azimuth: 40,
  height: 48, lamp: 0.8, exposure: 1.3, material: false, moving: true, turn: 28, tilt: 15, distance: 7.8,
};
const first = [["check", "on", "Ambient occlusion off / on"]];
const entries = [
  ["choice", "view", "Picture", { choices: [["lit", "light and occlusion"], ["ao", "occlusion alone"], ["screen", "screen-space pass alone"], ["error", "error against ray tracing"]] }],
  "Crowd",
  ["range", "count", "Characters", { min: 1, max: 100, step: 1 }],
  ["range", "neighbours", "Neighbours", { min: 0, max: 8, step: 1 }],
  ["check", "ground", "Ground darkens characters"],
  ["check", "moving", "Moving"],
  "Occlusion",
  ["check", "characterAo", "Of characters"],
  ["check", "screenAo", "Of the screen"],
  ["range", "radius", "Radius", { min: 0.1, max: 1.5, step: 0.05, unit: " m" }],
  "Light",
  ["choice", "light", "Ambient", { choices: [["constant", "constant × AO"], ["probe", "probe × AO"], ["lobes", "each lobe occluded"]] }],
  ["range", "azimuth", "Sun side", { min: 0, max: 360, step: 1, unit: "°" }],
  ["range", "height", "Sun height", { min: 8, max: 85, step: 1, unit: "°" }],
  ["range", "lamp", "Sun", { min: 0, max: 1.5, step: 0.05 }],
  ["range", "exposure", "Exposure", { min: 0.3, max: 3, step: 0.05 }],
  "Material",
  ["check", "material", "Ball of a compressed material"],
];

const ballRadius = 0.62;
const degrees = Math.PI / 180;
const canvas = document.getElementById("canvas");
const query = new URLSearchParams(location.search);
const fixedTime = readTime(location.search);
const limits = { turn: { min: 0, max: 360, wraps: true }, tilt: { min: 2, max: 80 }, distance: { min: 1.5, max: 20 } };
for (const entry of entries) if (Array.isArray(entry) && entry[3]) limits[entry[1]] = entry[3];
const stillness = matchMedia("(prefers-reduced-motion: reduce)");
initial.moving = !stillness.matches;
const state = { ...initial };
readAddress(location.search, state, limits);
const { report, progress, clear } = globalThis.nookMessage;

// Browsers limit how often a page may write its address.
let writing = 0;
function keepAddress() {
  clearTimeout(writing);
  writing = setTimeout(() => history.replaceState(null, "", location.pathname + writeAddress(location.search, state, initial) + location.hash), 300);
}

class Page {
  constructor(nook, character, model, material, webgl) {
    Object.assign(this, { nook, character, model, material, webgl, state });
    this.probe = null;
    this.ball = null;
    this.ballOccluder = 0;
    this.renderer = null;
    this.crowd = new Crowd(nook, model, character);
    this.makeLight();
    this.makeRenderer();
    this.arrange();
    this.seconds = 0;
    this.frames = 0;
    this.paused = false;
    this.failed = false;  // true until the context is restored
  }

  // Does nothing in a lost context. The renderer is made when the context is restored.
  makeRenderer() {
    if (this.webgl.isContextLost()) return;
    try {
      this.renderer = new Renderer(this.webgl, this.nook, this.character, this.probe, this.material);
      this.failed = false;
    } catch (error) {
      if (!this.webgl.isContextLost()) throw error;
    }
  }
  loseRenderer() {
    this.renderer?.ao.contextLost();
    this.renderer?.destroy();
    this.renderer = null;
  }
  // The error is shown as soon as its reference has arrived.
  get showsError() {
    return state.view === "error" && this.character.isComplete;
  }
  addShowcase() {
    if (this.renderer && !this.webgl.isContextLost()) this.renderer.addReferences();
    this.arrange();
  }
  addMaterial(material) {
    this.material = material;
    if (this.renderer && !this.webgl.isContextLost()) this.renderer.addMaterial(material);
    this.arrange();
  }

  // Makes the probe of the sky, its lobes for the characters, and its mean irradiance for comparison.
  makeLight() {
    this.lamp = lampDirection(state.azimuth * degrees, state.height * degrees);
    const before = this.probe;
    this.probe = fitProbe(this.nook, this.lamp, state.lamp);
    this.lobes = this.probe.lobes();
    const axes = [1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1];
    const irradiance = this.probe.irradiance(axes);
    this.irradiance = [0, 1, 2].map((i) => (irradiance[i] + irradiance[3 + i] + irradiance[6 + i] + irradiance[9 + i] + irradiance[12 + i] + irradiance[15 + i]) / 6);
    this.irradianceUp = irradiance.slice(6, 9);
    before?.destroy();
    // A renderer that is made after a loss of the context uses the current probe.
    if (this.renderer && !this.webgl.isContextLost()) this.renderer.probe.update(this.probe);
  }

  // Updates the crowd and its links after a change of the state.
  arrange() {
    const error = this.showsError;
    if (error) this.crowd.lineUp();
    else this.crowd.scatter(state.count);
    this.crowd.configure({ neighbours: error ? 0 : state.neighbours, ground: error || state.ground });
    this.crowd.light(this.lobes, state.on && state.light === "lobes" && !error);
    const ball = state.material && this.material && !error;
    this.ball = ball ? [1.15, ballRadius, 1.75, ballRadius] : null;
    if (ball && !this.ballOccluder) this.ballOccluder = this.crowd.scene.addOccluder({ centre: this.ball.slice(0, 3), radius: ballRadius });
    if (!ball && this.ballOccluder) {
      this.crowd.scene.removeOccluder(this.ballOccluder);
      this.ballOccluder = 0;
    }
    document.getElementById("legend").hidden = !error;
  }

  changed(member) {
    if (["azimuth", "height", "lamp"].includes(member)) this.makeLight();
    this.arrange();
    keepAddress();
  }

  // Draws a frame. Returns false if this is not possible, because the context is lost or the canvas has no size.
  draw(seconds) {
    if (!this.renderer || this.webgl.isContextLost()) return false;
    const scale = Math.min(devicePixelRatio, 2);
    const width = Math.round(canvas.clientWidth * scale), height = Math.round(canvas.clientHeight * scale);
    if (width === 0 || height === 0) return false;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const error = this.showsError;
    this.crowd.animate(seconds, error);
    const turn = (error ? 0 : state.turn) * degrees, tilt = (error ? 4 : state.tilt) * degrees, away = error ? 11 : state.distance;
    const target = error ? [1.45, 0.8, 0] : [0.45, 0.82, 0];
    const eye = [target[0] + away * Math.sin(turn) * Math.cos(tilt), target[1] + away * Math.sin(tilt), target[2] + away * Math.cos(turn) * Math.cos(tilt)];
    this.renderer.draw(this.crowd, {
      ...state, light: error || (!state.on && state.light === "lobes") ? "probe" : state.light, characterAo: state.characterAo && state.on, lampDirection: this.lamp, irradiance: this.irradiance, irradianceUp: this.irradianceUp, eye, target, ball: this.ball,
      screenAo: state.screenAo && state.on && !error,
    });
    ++this.frames;
    return true;
  }

  // Returns the mean squared error of the error picture.
  meanSquaredError() {
    const { references } = this.character.arrays;
    let sum = 0, count = 0;
    for (const body of this.crowd.bodies) {
      const ao = this.renderer.ao.read(this.crowd.scene, body.instance);
      ao.forEach((value, i) => (sum += (value - references[body.clip * ao.length + i] / 255) ** 2));
      count += ao.length;
    }
    return sum / count;
  }
}

// Moves the camera: turn and tilt in degrees, zoom as a factor of the distance.
function moveCamera(turn, tilt, zoom) {
  state.turn = (((state.turn + turn) % 360) + 360) % 360;
  state.tilt = Math.min(limits.tilt.max, Math.max(limits.tilt.min, state.tilt + tilt));
  state.distance = Math.min(limits.distance.max, Math.max(limits.distance.min, state.distance * zoom));
  keepAddress();
}
const keys = {
  ArrowLeft: () => moveCamera(-5, 0, 1), ArrowRight: () => moveCamera(5, 0, 1), ArrowUp: () => moveCamera(0, 3, 1),
  ArrowDown: () => moveCamera(0, -3, 1), "+": () => moveCamera(0, 0, 1 / 1.1), "=": () => moveCamera(0, 0, 1 / 1.1),
  "-": () => moveCamera(0, 0, 1.1), PageUp: () => moveCamera(0, 0, 1 / 1.3), PageDown: () => moveCamera(0, 0, 1.3),
  Home: () => Object.assign(state, { turn: initial.turn, tilt: initial.tilt, distance: initial.distance }) && keepAddress(),
};

function steer(page) {
  // The pointers that are down. One pointer turns the camera, and two pointers change its distance.
  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  };
  canvas.addEventListener("pointerdown", (event) => {
    pointers.set(event.pointerId, event);
    canvas.setPointerCapture(event.pointerId);
  });
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
    canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    const from = pointers.get(event.pointerId);
    if (!from) return;
    const before = pointers.size === 2 ? spread() : 0;
    pointers.set(event.pointerId, event);
    if (pointers.size === 2) moveCamera(0, 0, before / Math.max(1, spread()));
    if (pointers.size === 1) moveCamera(-(event.clientX - from.clientX) * 0.35, (event.clientY - from.clientY) * 0.25, 1);
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    moveCamera(0, 0, Math.exp(event.deltaY * 0.001));
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key.toLowerCase() === "o") {
      state.on = !state.on;
      page.changed("on");
      page.showPanel();
    } else if (keys[event.key]) {
      keys[event.key]();
    } else {
      return;
    }
    event.preventDefault();
  });
  stillness.addEventListener("change", () => {
    if (!stillness.matches) return;
    state.moving = false;
    page.showPanel();
  });
}

// The page may lose its context at any time, even while it loads.
function watchContext(pageOf) {
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    pageOf()?.loseRenderer();
  });
  canvas.addEventListener("webglcontextrestored", () => {
    const page = pageOf();
    if (!page) return;
    try {
      page.loseRenderer();
      page.makeRenderer();
      page.arrange();
      clear();
    } catch (error) {
      report(error);
    }
  });
}

// Draws frames from now on. Resolves after the first frame, or at once if the page waits for its test.
function run(page) {
  let drawn = () => {};
  const first = page.paused ? Promise.resolve() : new Promise((resolve) => (drawn = resolve));
  const status = document.getElementById("status");
  let last = performance.now(), shown = last, frames = 0;
  const frame = (now) => {
    requestAnimationFrame(frame);
    if (page.paused || page.failed) return;
    if (state.moving) page.seconds += Math.min(0.1, (now - last) / 1000);
    last = now;
    try {
      if (!page.draw(fixedTime ?? page.seconds)) return;
    } catch (error) {
      // The context may be lost within a frame. The next frame draws after it is restored.
      if (page.webgl.isContextLost()) return;
      page.failed = true;
      report(error);
      return;
    }
    if (page.frames === 1) performance.mark("first picture");
    ++frames;
    drawn();
    if (now - shown < 1000) return;
    status.textContent = `${((frames * 1000) / (now - shown)).toFixed(0)} frames/s · ${page.crowd.count} characters · ${(page.crowd.count * page.character.vertices).toLocaleString("en")} vertices`;
    if (page.showsError) document.getElementById("error").textContent = `Mean squared error ${page.meanSquaredError().toExponential(2)}`;
    shown = now;
    frames = 0;
  };
  requestAnimationFrame(frame);
  return first;
}

// start.js has already requested the module. If that failed, load() requests it again and reports the reason.
async function loadNook(log) {
  const answer = await globalThis.nookFetch("node_modules/nook-web/nook.wasm").catch(() => null);
  return load(answer?.ok ? { log, wasm: answer } : { log });
}

async function start() {
  const webgl = canvas.getContext("webgl2", { antialias: true, alpha: false, preserveDrawingBuffer: query.has("check") });
  if (!webgl) throw new Error("This browser does not provide WebGL 2; switch on hardware acceleration, or use another browser.");
  let page = null;
  watchContext(() => page);
  const files = new Map();
  const count = (url, received, all) => {
    files.set(url, { received, all });
    const [got, whole] = ["received", "all"].map((member) => [...files.values()].reduce((sum, file) => sum + file[member], 0) / 1e6);
    progress(`Loading the scene: ${got.toFixed(1)}${[...files.values()].every(({ all: known }) => known > 0) ? ` of ${whole.toFixed(1)}` : ""} MB`);
  };
  const log = (severity, text) => severity !== "info" && console.warn(text);
  const [nook, character] = await Promise.all([loadNook(log), fetchCharacter("data", count)]);
  page = new Page(nook, character, named("data/character.nook", () => nook.loadCharacter(character.nook)), null, webgl);
  character.nook = null;
  // The panel is folded on small screens, where it would cover the picture.
  document.getElementById("more").open = !matchMedia("(max-width: 640px), (max-height: 420px)").matches;
  page.showPanel = () => {
    makePanel(document.getElementById("first"), state, first, (member) => page.changed(member));
    makePanel(document.getElementById("rows"), state, entries, (member) => page.changed(member));
  };
  page.showPanel();
  steer(page);
  page.paused = query.has("check");
  clear();
  const firstPicture = run(page);
  // The showcase follows after the first picture, because the clips, the reference and the material are most of the bytes.
  await firstPicture;
  await fetchShowcase("data", character);
  page.addShowcase();
  const material = await fetchBytes("data/material.nook");
  page.addMaterial(named("data/material.nook", () => nook.loadMaterial(material)));
  window.nookPage = { page, checks: query.has("check") ? (await import("./checks.js")).makeChecks(page) : null };
}

// Runs a call that reads a file's contents. Adds the name of the file to errors of the library.
function named(url, call) {
  try {
    return call();
  } catch (error) {
    throw new Error(`${url}: ${error.message}; load the page again, or make the file again with samples/web/build.sh`, { cause: error });
  }
}

start().catch(report);
