// The crowd: a scene of Nook with one instance for each body, their places and poses.
import { referencePose, samplePose } from "./character.js";

// Returns a generator that gives the same numbers in every run.
function randomNumbers(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

const groundPlane = [0, 1, 0, 0];
const spacing = 0.92;  // metres between neighbours

// Returns places in a spiral around the middle, nearest first, each with a clip, a phase and a heading.
function places(count, clips) {
  const random = randomNumbers(7);
  return Array.from({ length: count }, (_, i) => {
    const angle = i * 2.39996, radius = i === 0 ? 0 : spacing * Math.sqrt(i + 0.35);
    return {
      x: radius * Math.cos(angle) + 0.12 * (random() - 0.5),
      z: radius * Math.sin(angle) + 0.12 * (random() - 0.5),
      yaw: i === 0 ? 0.25 : 2 * Math.PI * random(),
      clip: i === 0 ? 1 : Math.floor(random() * clips),
      phase: 4 * random(),
      tint: [random(), random()],
    };
  });
}

export class Crowd {
  constructor(nook, model, character) {
    this.scene = nook.createScene();
    this.model = model;
    this.character = character;
    this.bodies = [];
    this.pose = new Float32Array(12 * character.bones);
    this.places = places(256, character.clips.length);
  }

  get count() {
    return this.bodies.length;
  }

  resize(count) {
    while (this.bodies.length > count) this.scene.removeInstance(this.bodies.pop().instance);
    while (this.bodies.length < count) {
      const place = this.places[this.bodies.length];
      this.bodies.push({ ...place, instance: this.scene.addInstance(this.model), world: new Float32Array(12 * this.character.bones) });
    }
  }

  // Shows one body for each clip, side by side and far enough apart, in the frame of the ray-traced reference.
  lineUp() {
    this.resize(this.character.clips.length);
    this.bodies.forEach((body, i) => Object.assign(body, { x: 0.98 * (i - (this.count - 1) / 2), z: 0, yaw: 0.35, clip: i }));
  }
  scatter(count) {
    this.resize(count);
    this.bodies.forEach((body, i) => Object.assign(body, this.places[i]));
  }

  configure({ neighbours, ground }) {
    this.scene.linkNearest(neighbours, 4);
    for (const { instance } of this.bodies) this.scene.setGround(instance, ground ? groundPlane : null);
  }

  animate(seconds, frozen) {
    for (const body of this.bodies) {
      if (frozen) referencePose(this.character, body.clip, this.pose);
      else samplePose(this.character, body.clip, seconds + body.phase, this.pose);
      const c = Math.cos(body.yaw), s = Math.sin(body.yaw);
      const place3x4 = [c, 0, s, body.x, 0, 1, 0, 0, -s, 0, c, body.z];
      this.scene.setPose(body.instance, { kind: "rest-to-world", layout: "rows-3x4", transforms: this.pose, place3x4 });
      place(this.pose, c, s, body, body.world);
    }
  }

  // Sets the lobes on all bodies, or on the first one only: Nook needs one light to generate the GLSL.
  light(lobes, all) {
    this.bodies.forEach(({ instance }, i) => this.scene.setLight(instance, all || i === 0 ? lobes : null));
  }

  destroy() {
    this.scene.destroy();
  }
}

// Writes the matrices for skinning: the matrices of the pose, turned and moved to the body's place.
function place(pose, c, s, { x, z }, out) {
  for (let i = 0; i < pose.length; i += 12)
    for (let k = 0; k < 4; ++k) {
      const first = pose[i + k], third = pose[i + 8 + k], end = k === 3 ? 1 : 0;
      out[i + k] = c * first + s * third + end * x;
      out[i + 4 + k] = pose[i + 4 + k];
      out[i + 8 + k] = c * third - s * first + end * z;
    }
}
