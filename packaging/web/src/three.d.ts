// nook-web/three: Nook in three.js. docs/engines/three.md explains it step by step.
import type { Camera, Object3D, SkinnedMesh, WebGLRenderer } from "three";
import type { Pass } from "three/addons/postprocessing/Pass.js";
import type { CharacterModel, Context, Gl, Instance, NnaoFrame, NnaoOptions, Pose, Scene } from "./index.js";

/** A character that NookThree.add() returns. */
export interface Character {
  /** The character's number in the host's scene, for setGround and link. */
  readonly instance: Instance;
}

/** Create one for each WebGLRenderer. It adopts the renderer's context, and survives the loss of the context. */
export class NookThree {
  constructor(nook: Context, renderer: WebGLRenderer);
  /** Nook's scene, for links, grounds and occluders. */
  readonly scene: Scene;
  /** Null in a lost context. */
  readonly gl: Gl | null;
  /** False in a lost context: skip frames until the context is restored. */
  readonly isAlive: boolean;
  /** How much of the AO the materials use, from 0 to 1. */
  readonly share: { value: number };
  /** Gives AO to the skinned meshes of one character. They must share a skeleton, and `model` is the bake of their file. */
  add(model: CharacterModel, ...meshes: SkinnedMesh[]): Character;
  /** Removes a character. Its meshes get their own geometry and materials back. */
  remove(character: Character): void;
  /** Returns the pose of a character as three.js skins it. */
  pose(character: Character): Pose;
  /** Call this once per frame, after the animations have moved and before the renderer draws. */
  update(scene: Object3D): void;
  /** Removes all characters and releases what the host made. Dispose of the passes first. */
  dispose(): void;
}

/** Add this pass after the RenderPass of an EffectComposer. The composer's render target needs a depthTexture. The pass
 * multiplies the target's colour by the AO. */
export class NookPass extends Pass {
  /** frame: values that may change in each frame, such as radius. options: values with which the pass is created, such as
   * preset. */
  constructor(host: NookThree, camera: Camera, frame?: Partial<NnaoFrame>, options?: Partial<NnaoOptions>);
  frame: Partial<NnaoFrame>;
  /** To change the options, assign a new object. */
  options: Partial<NnaoOptions>;
}
