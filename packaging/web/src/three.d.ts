// nook-web/three: Nook in three.js. docs/engines/three.md is a page to follow.
import type { Camera, Object3D, SkinnedMesh, WebGLRenderer } from "three";
import type { Pass } from "three/addons/postprocessing/Pass.js";
import type { CharacterModel, Context, Gl, Instance, NnaoFrame, NnaoOptions, Pose, Scene } from "./index.js";

/** A character of NookThree.add(). */
export interface Character {
  /** Its number in the host's scene, for setGround and link. */
  readonly instance: Instance;
}

/** One for each WebGLRenderer. It adopts the renderer's context, and survives its loss. */
export class NookThree {
  constructor(nook: Context, renderer: WebGLRenderer);
  /** Nook's own scene, for links, grounds and occluders. */
  readonly scene: Scene;
  /** Null in a lost context. */
  readonly gl: Gl | null;
  /** False in a lost context: skip frames until it is back. */
  readonly isAlive: boolean;
  /** The share of AO that the materials use, 0 to 1. */
  readonly share: { value: number };
  /** Gives the skinned meshes of one character AO; they share a skeleton, and model is the bake of their file. */
  add(model: CharacterModel, ...meshes: SkinnedMesh[]): Character;
  /** Takes a character out: its meshes have their own geometry and materials again. */
  remove(character: Character): void;
  /** The pose of a character as three.js skins it. */
  pose(character: Character): Pose;
  /** Once a frame, when the animations have moved and before the renderer draws. */
  update(scene: Object3D): void;
  /** Removes all characters and releases what the host made. Dispose the passes before. */
  dispose(): void;
}

/** Stands after the RenderPass of an EffectComposer whose render target has a depthTexture, and multiplies its colour by the AO. */
export class NookPass extends Pass {
  /** frame: what may change from frame to frame, such as radius. options: what the pass is made with, such as preset. */
  constructor(host: NookThree, camera: Camera, frame?: Partial<NnaoFrame>, options?: Partial<NnaoOptions>);
  frame: Partial<NnaoFrame>;
  /** Set it anew to change it. */
  options: Partial<NnaoOptions>;
}
