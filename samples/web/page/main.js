// The page: loads the data, holds the state that the panel changes, and draws frames. Read it first, then crowd.js (a scene of
// Nook) and renderer.js (Nook beside a host's own WebGL).
import { load } from "nook-web";
import { fetchBytes, fetchCharacter } from "./character.js";
import { makeChecks } from "./checks.js";
import { Crowd } from "./crowd.js";
import { makePanel } from "./panel.js";
import { Renderer } from "./renderer.js";
import { fitProbe, lampDirection } from "./sky.js";

const state = {
  view: "lit", count: 12, neighbours: 4, ground: true, characterAo: true, screenAo: true, radius: 0.45, light: "lobes", azimuth: 40,
  height: 48, lamp: 0.8, exposure: 1.3, material: false, moving: true, turn: 28, tilt: 15, distance: 7.8,
};
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
for (const [name, text] of query) {
  if (!(name in state)) continue;
  state[name] = typeof state[name] === "number" ? Number(text) : typeof state[name] === "boolean" ? text === "true" : text;
}
const fixedTime = query.has("time") ? Number(query.get("time")) : null;

function report(error) {
  const message = document.getElementById("message");
  message.textContent = error.message ?? String(error);
  message.hidden = false;
  console.error(error);
}

class Page {
  constructor(nook, character, model, material, webgl) {
    Object.assign(this, { nook, character, model, material, webgl, state });
    this.probe = null;
    this.ball = null;
    this.ballOccluder = 0;
    this.crowd = new Crowd(nook, model, character);
    this.makeLight();
    this.makeRenderer();
    this.arrange();
    this.seconds = 0;
    this.frames = 0;
  }

  makeRenderer() {
    this.renderer = new Renderer(this.webgl, this.nook, this.character, this.probe, this.material);
  }

  // The probe of the sky, its lobes for the characters, and its mean irradiance for comparison.
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
    this.renderer?.probe.update(this.probe);
  }

  // The crowd and its links, after a change of the state.
  arrange() {
    const error = state.view === "error";
    if (error) this.crowd.lineUp();
    else this.crowd.scatter(state.count);
    this.crowd.configure({ neighbours: error ? 0 : state.neighbours, ground: error || state.ground });
    this.crowd.light(this.lobes, state.light === "lobes" && !error);
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
  }

  draw(seconds) {
    const scale = Math.min(devicePixelRatio, 2);
    const width = Math.round(canvas.clientWidth * scale), height = Math.round(canvas.clientHeight * scale);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const error = state.view === "error";
    this.crowd.animate(seconds, error);
    const turn = (error ? 0 : state.turn) * degrees, tilt = (error ? 4 : state.tilt) * degrees, away = error ? 11 : state.distance;
    const target = error ? [1.45, 0.8, 0] : [0.45, 0.82, 0];
    const eye = [target[0] + away * Math.sin(turn) * Math.cos(tilt), target[1] + away * Math.sin(tilt), target[2] + away * Math.cos(turn) * Math.cos(tilt)];
    this.renderer.draw(this.crowd, {
      ...state, light: error ? "probe" : state.light, lampDirection: this.lamp, irradiance: this.irradiance, irradianceUp: this.irradianceUp, eye, target, ball: this.ball,
      screenAo: state.screenAo && !error,
    });
    ++this.frames;
  }

  // The mean squared error of what the error picture shows.
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

function steer(page) {
  let from = null;
  canvas.addEventListener("pointerdown", (event) => {
    from = event;
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointerup", () => (from = null));
  canvas.addEventListener("pointermove", (event) => {
    if (!from) return;
    state.turn -= (event.clientX - from.clientX) * 0.35;
    state.tilt = Math.min(80, Math.max(2, state.tilt + (event.clientY - from.clientY) * 0.25));
    from = event;
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    state.distance = Math.min(20, Math.max(1.5, state.distance * Math.exp(event.deltaY * 0.001)));
  }, { passive: false });
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    page.renderer.ao.contextLost();
    page.renderer.destroy();
    page.renderer = null;
  });
  canvas.addEventListener("webglcontextrestored", () => {
    page.makeRenderer();
    page.arrange();
  });
}

function run(page) {
  const status = document.getElementById("status");
  let last = performance.now(), shown = last, frames = 0;
  const frame = (now) => {
    requestAnimationFrame(frame);
    if (!page.renderer || page.paused) return;
    if (state.moving) page.seconds += Math.min(0.1, (now - last) / 1000);
    last = now;
    try {
      page.draw(fixedTime ?? page.seconds);
    } catch (error) {
      page.paused = true;
      report(error);
      return;
    }
    ++frames;
    if (now - shown < 1000) return;
    status.textContent = `${((frames * 1000) / (now - shown)).toFixed(0)} frames/s · ${page.crowd.count} characters · ${(page.crowd.count * page.character.vertices).toLocaleString("en")} vertices`;
    if (state.view === "error") document.getElementById("error").textContent = `Mean squared error ${page.meanSquaredError().toExponential(2)}`;
    shown = now;
    frames = 0;
  };
  requestAnimationFrame(frame);
}

async function start() {
  const webgl = canvas.getContext("webgl2", { antialias: true, alpha: false, preserveDrawingBuffer: query.has("check") });
  if (!webgl) throw new Error("This browser gives no WebGL 2; switch hardware acceleration on, or take another browser.");
  const [nook, character, materialBytes] = await Promise.all([
    load({ log: (severity, text) => severity !== "info" && console.warn(text) }), fetchCharacter("data"), fetchBytes("data/material.nook")]);
  const page = new Page(nook, character, nook.loadCharacter(character.nook), nook.loadMaterial(materialBytes), webgl);
  character.nook = null;
  page.showPanel = () => makePanel(document.getElementById("rows"), state, entries, (member) => page.changed(member));
  page.showPanel();
  steer(page);
  page.paused = query.has("check");
  run(page);
  window.nookPage = { page, checks: makeChecks(page) };
}

start().catch(report);
