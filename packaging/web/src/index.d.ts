// nook-web: ambient occlusion for WebGL 2. Options have the names of the C headers in camelCase, and constants are
// words. The headers in sdk/include/nook describe each of them. Lengths are in metres. Every call that fails throws NookError. If
// a list has the wrong length or contains something other than numbers, the message names the list.

export class NookError extends Error {
  /** The name of the result, such as "NOOK_ERROR_BAD_FILE". */
  readonly code: string;
}

export type Bytes = ArrayBuffer | ArrayBufferView;
export type Numbers = ArrayLike<number>;
export type Instance = number;
export type Occluder = number;

export interface LoadOptions {
  /** The location of nook.wasm, or its bytes, or its compiled module. Default: beside this file. In Node, you can also pass a path
   *  or a file: URL. */
  wasm?: string | URL | Response | Bytes | WebAssembly.Module | Promise<Response | Bytes | WebAssembly.Module>;
  /** Called with each line of the library's log. */
  log?: (severity: "info" | "warning" | "error", text: string) => void;
  /** The instruction set of all objects of the context. */
  isa?: "auto" | "scalar" | "wasm128";
  /** How many of your scene's length units make one metre, such as 100 for centimetres. Default 1. */
  unitsPerMetre?: number;
}
/** Loads the WebAssembly module and creates a context in it. */
export function load(options?: LoadOptions): Promise<Context>;

declare class Owned {
  /** Releases the object; a second call does nothing. */
  destroy(): void;
}

export class Context extends Owned {
  readonly version: string;
  /** The memory of the module in bytes; it grows and never shrinks. */
  readonly memoryBytes: number;
  loadCharacter(bytes: Bytes): CharacterModel;
  loadProbe(bytes: Bytes): Probe;
  loadMaterial(bytes: Bytes): Material;
  createScene(options?: SceneOptions): Scene;
  createProbeFit(options?: ProbeFitOptions): ProbeFit;
  /** Adopts a WebGL 2 context of the host. */
  createGl(webgl: WebGL2RenderingContext, options?: GlOptions): Gl;
}

// ---- Characters

export interface CharacterModelInfo {
  boneCount: number;
  sphereCount: number;
  keyPointCount: number;
  vertexCount: number;
  /** The number of AO values: one for each vertex of the imported file. */
  fileVertexCount: number;
  primitiveCount: number;
  lodCount: number;
  boundingRadius: number;
  gamma: number;
  /** The number of skins of `skin`; 0 without bind data. */
  skinCount: number;
  /** The number of vertices of `checkVertex`; 0 without bind data. */
  checkVertexCount: number;
  /** Memory of the model, of each instance, and of each instance with a light. */
  modelBytes: number;
  instanceBytes: number;
  litInstanceBytes: number;
}
export type PoseKind = "rest-to-world" | "joint-to-world" | "skinning";
export type TransformLayout = "rows-3x4" | "rows-4x4" | "columns-4x4" | "columns-4x3" | "dual-quaternion" | "trs";
/** A pose in a host's own transforms. three.js and glTF: { kind: "skinning", layout: "columns-4x4", transforms }. */
export interface Pose {
  /** Default "skinning". */
  kind?: PoseKind;
  /** Default "columns-4x4". */
  layout?: TransformLayout;
  transforms: Numbers;
  /** Bytes between transforms; 0: tightly packed. */
  stride?: number;
  transformCount?: number;
  /** For "skinning": the file's index of the skin to which the matrices belong. */
  skin?: number;
  /** For each bone of the model, the index of its transform, or -1 for none. See CharacterModel.mapBones. */
  transformOfBone?: Numbers;
  /** 3x4, row-major, applied after every transform. */
  place3x4?: Numbers;
  /** Bones without a transform keep their matrices. */
  partial?: boolean;
  strict?: boolean;
  /** Allows more transforms than needed, as in three.js's Skeleton.boneMatrices. Only the first ones are used. */
  surplus?: boolean;
}
export interface SkinInfo {
  fileIndex: number;
  jointCount: number;
  restFromMesh3x4: Float32Array;
}
export interface CheckVertex {
  vertex: number;
  position: Float32Array;
  meshPosition: Float32Array;
  bone: number;
}
export interface PoseCheck {
  fault: "none" | "transposed" | "no-bind" | "kind" | "skin" | "order" | "unit" | "place" | "inverted" | "unknown";
  maxError: number;
  rmsError: number;
  worstBone: number;
  fittingSkin: number;
  scale: number;
  text: string;
}
export class CharacterModel extends Owned {
  private constructor();
  readonly info: CharacterModelInfo;
  readonly boneNames: string[];
  boneName(bone: number): string | null;
  primitive(index: number): { first: number; count: number };
  /** Ray-traced AO of the rest pose. */
  staticAo(out?: Float32Array): Float32Array;
  skin(index: number): SkinInfo;
  checkVertex(index: number): CheckVertex;
  mapBones(names: (string | null)[], options?: { loose?: boolean; dropSharedPrefix?: boolean }):
    { transformOfBone: Int32Array; unmatched: number };
  convertPose(pose: Pose, out?: Float32Array): Float32Array;
  /** Compares a pose with vertices that the host skinned itself, and names the likely fault. */
  checkPose(pose: Pose, vertices: { positions: Numbers; checkVertices?: Numbers; place3x4?: Numbers; tolerance?: number }):
    PoseCheck;
  /** Finds the model's vertex for each vertex of a host's mesh, or 0xffffffff if no vertex is near enough. `joints` and `weights`
   * distinguish vertices where meshes meet. Both have the same count for each vertex. `indices` are three for each triangle, and
   * distinguish the two sides of a sharp fold. In the result, `ambiguous` counts the vertices that nothing distinguishes, and `text`
   * names them. */
  matchVertices(match: { positions: Numbers; normals?: Numbers; joints?: Numbers; weights?: Numbers; skin?: number; primitive?: number;
    indices?: Numbers; inRestSpace?: boolean; tolerance?: number }): { vertices: Uint32Array; unmatched: number; ambiguous: number; text: string };
  /** Returns a model with its vertices in the order of a host's mesh. */
  remap(vertices: Numbers): CharacterModel;
}

export interface SceneOptions {
  form?: "default" | "paper";
  cutoffError?: number;
  lodError?: number;
  lodDistance?: number;
  lodMaxInterval?: number;
  groundRadius?: number;
  strictPoses?: boolean | number;
  /** Far spheres are merged if this changes AO by at most this root mean square error. 0 never merges spheres. */
  farError?: number;
}
export interface OccluderOptions {
  /** World space, metres. */
  centre: Numbers;
  radius: number;
  /** The only instance that the sphere darkens; 0 (default): every instance. */
  receiver?: Instance | 0;
}
export interface SceneInfo {
  instances: number;
  instancesUpdated: number;
  links: number;
  linksCulled: number;
  /** Instances whose pose now has a bone that is sheared or scaled unevenly. */
  unevenInstances: number;
  evaluations: number;
  memoryBytes: number;
}
export class Scene extends Owned {
  private constructor();
  addInstance(model: CharacterModel): Instance;
  removeInstance(instance: Instance): void;
  setModel(instance: Instance, model: CharacterModel): void;
  /** The number of AO values of an instance. */
  vertexCount(instance: Instance): number;
  setPose(instance: Instance, pose: Pose): void;
  link(receiver: Instance, caster: Instance): void;
  unlink(receiver: Instance, caster: Instance): void;
  linkNearest(count: number, maxDistance: number): void;
  /** Normal and offset of the plane; null for none. */
  setGround(instance: Instance, plane: Numbers | null): void;
  addOccluder(options: OccluderOptions): Occluder;
  setOccluder(occluder: Occluder, options: OccluderOptions): void;
  removeOccluder(occluder: Occluder): void;
  setLight(instance: Instance, lobes: Lobe[] | null): void;
  setCamera(position: Numbers | null): void;
  setTerms(terms: ("self" | "links" | "ground" | "occluders" | "all")[]): void;
  /** Evaluates everything on the CPU; Gl.update does it on the GPU instead. */
  update(): void;
  readAo(instance: Instance, out?: Float32Array): Float32Array;
  readDirectionalAo(instance: Instance, out?: Float32Array): Float32Array;
  readonly info: SceneInfo;
}

// ---- WebGL

export interface GlOptions {
  /** What a call does with the WebGL state that it changes. See docs/gl_state.md. Default "defaults". "preserve" is slow in
   *  browsers, and cannot restore bindings of objects that the host made. */
  stateMode?: "defaults" | "preserve" | "host";
}
export interface GlInfo {
  tier: string;
  version: string;
  renderer: string;
  bufferBytes: number;
  aoBytes: number;
}
export type GlChannel = "ao" | "directional-ao";
export interface GlView {
  buffer: WebGLBuffer;
  offset: number;
  stride: number;
  count: number;
  /** For "directional-ao": a TEXTURE_2D for the sampler nook_scene_lights of the GLSL. */
  texture: WebGLTexture | null;
  /** For "directional-ao": the first argument of the GLSL's functions. */
  light: number;
  glsl: string;
}
export interface AoTarget {
  buffer?: WebGLBuffer;
  texture?: WebGLTexture;
  format?: "float" | "half" | "unorm8";
  offset?: number;
  instanceStride?: number;
  /** Needed with a texture. */
  textureWidth?: number;
}
export class Gl extends Owned {
  private constructor();
  readonly info: GlInfo;
  /** The number of WebGL objects that the library holds in this context. */
  readonly objectCount: number;
  /** Call this on "webglcontextlost". Then destroy all objects, and create them again on "webglcontextrestored". Between these two
   *  events, other calls into WebGL throw. */
  contextLost(): void;
  prepare(scene: Scene): void;
  /** Evaluates the AO of all instances. */
  update(scene: Scene): void;
  release(scene: Scene): void;
  view(scene: Scene, instance: Instance, channel?: GlChannel): GlView;
  writeAo(scene: Scene, instances: Numbers, target: AoTarget): void;
  /** For tests: waits for the GPU. */
  read(scene: Scene, instance: Instance, channel?: GlChannel, out?: Float32Array): Float32Array;
  createNnao(options: NnaoOptions): Nnao;
  uploadProbe(probe: Probe, form?: "lobes" | "sh" | "zh3"): Upload;
  uploadMaterial(material: Material): Upload;
}

export interface NnaoOptions {
  maxWidth: number;
  maxHeight: number;
  /** Sets taps, halfResolution and blur, unless you set them yourself. Default "default". */
  preset?: "default" | "fast" | "best";
  taps?: 9 | 16 | 32 | 64 | 128 | 256;
  halfResolution?: boolean | number;
  /** How often the filter runs: 0, 1 or 2. */
  blur?: number;
  blurSharpness?: number;
  /** The texture is then RGBA8: the bent normal in view space as (n + 1) / 2, and AO in alpha. */
  bentNormals?: boolean | number;
  /** Averages AO over at most this number of frames. 0: no averaging. */
  maxHistoryFrames?: number;
  /** A .nook file of `nook train nnao`; default: the library's own. */
  network?: Bytes;
}
export interface NnaoFrame {
  width: number;
  height: number;
  viewport?: Numbers;
  depthTexture: WebGLTexture;
  depthKind?: "hardware" | "linear" | "logarithmic";
  /** Of logarithmic depth; see nook_nnao.h. */
  depthLogFar?: number;
  depthLogScale?: number;
  depthLogNear?: number;
  skyDepth?: number;
  normalTexture?: WebGLTexture | null;
  normalScale?: number;
  normalBias?: number;
  normalMatrix?: Numbers;
  /** Column-major, as WebGL takes it. */
  projection: Numbers;
  /** From world space to view space, column-major; the identity by default. */
  view?: Numbers;
  clipSpace?: "negative-one-to-one" | "zero-to-one";
  /** In metres, or as a share, depending on radiusKind. */
  radius: number;
  radiusKind?: "metres" | "screen" | "scene";
  sceneSize?: number;
  maxRadiusPx?: number;
  /** Default 12; 0: no minimum. */
  minRadiusPx?: number;
  /** Metres; AO fades from fadeBegin on and is 1 from fadeEnd on. Default 0: never. */
  fadeBegin?: number;
  fadeEnd?: number;
  intensity?: number;
  power?: number;
  gbufferAo?: "none" | "min" | "remainder" | "replace" | "exclude";
  gbufferAoTexture?: WebGLTexture | null;
  /** For maxHistoryFrames. */
  motionVectors?: WebGLTexture | null;
  motionVectorScale?: Numbers;
  reset?: boolean | number;
  /** The target of the result. Omit it for the pass's own texture, or pass null for the canvas. */
  target?: WebGLTexture | WebGLFramebuffer | null;
  blend?: "write" | "multiply";
  /** A debug view. */
  show?: "ao" | "raw" | "blurred" | "normals";
  /** Set this after you have changed the size or format of one of your textures. */
  texturesChanged?: boolean | number;
}
export interface NnaoInfo {
  texture: WebGLTexture;
  textureBytes: number;
  taps: number;
  halfResolution: number;
  blur: number;
  horizonForm: number;
  compute: number;
}
export class Nnao extends Owned {
  private constructor();
  readonly info: NnaoInfo;
  /** If the target is the pass's own texture: this texture, with the result in its red channel. */
  readonly texture: WebGLTexture;
  render(frame: NnaoFrame): void;
}

// ---- Light probes

export interface Lobe {
  axis: Numbers;
  sharpness: number;
  amplitude: Numbers;
}
export interface ProbeInfo {
  basis: "lobes" | "sh";
  domain: "sphere" | "hemisphere";
  up: Float32Array;
  functionCount: number;
  ambient: number;
  order: number;
  probeCount: number;
  counts: Uint32Array;
  originWs: Float32Array;
  spacingWs: Float32Array;
  /** The number of cells in which walls select the probes that light a point; 0: a grid without walls. */
  wallCells: number;
}
export interface ProbeFitOptions {
  method?: "least-squares" | "least-squares-non-negative" | "running-average" | "running-average-non-negative";
  /** "paper" is the published method. With it, omit `method` and `matchSh`. */
  form?: "default" | "paper";
  /** The lobes agree with the light in spherical harmonics of bands 0 to 2; default true. */
  matchSh?: boolean | number;
  basis?: "lobes" | "sh";
  domain?: "sphere" | "hemisphere";
  up?: Numbers;
  /** Default: the number of axes or sharpnesses, or 12. */
  lobeCount?: number;
  sharpness?: number;
  axes?: Numbers;
  sharpnesses?: Numbers;
  ambient?: boolean | number;
  order?: number;
  growingSamples?: number;
}
export interface ProbeFitInfo {
  functionCount: number;
  samples: number;
  skipped: number;
  skippedDirection: number;
  skippedRadiance: number;
  skippedWeight: number;
  weight: number;
  meanRadiance: Float64Array;
}
export class ProbeFit extends Owned {
  private constructor();
  readonly info: ProbeFitInfo;
  /** Three floats for each direction and radiance. */
  addSamples(directions: Numbers, radiance: Numbers, weights?: Numbers): void;
  /** Adds the samples of another fit with the same options. */
  merge(other: ProbeFit): void;
  reset(): void;
  solve(): Probe;
}
export class Probe extends Owned {
  private constructor();
  readonly info: ProbeInfo;
  lobes(position?: Numbers): Lobe[];
  /** Like lobes(), but for glossy reflection: amplitudes are never negative. Throws if the probe has no such lobes. */
  glossLobes(position?: Numbers): Lobe[];
  /** Three floats for each function of a probe of the grid. */
  coefficients(index?: number): Float32Array;
  /** The position is three floats for all directions, or three for each. */
  radiance(directions: Numbers, position?: Numbers): Float32Array;
  /** Like radiance(). Uses only probes on the surface's side of a wall. */
  irradiance(normals: Numbers, position?: Numbers): Float32Array;
}
/** A probe, a grid or a material as textures, and the GLSL that reads them. */
export class Upload extends Owned {
  private constructor();
  /** Replaces the probe. Only for uploads of probes. */
  update(probe: Probe): void;
  readonly info: {
    /** Bind each texture to a unit without a sampler object, and set its uniform to the unit. Or call bind(). */
    textures: { target: number; texture: WebGLTexture; uniform: string }[];
    bytes: number;
    glsl: string;
    constant: string;
    constantValues: Float32Array;
    constantVec4s: number;
    walls: number;
  };
  /** Leaves the program in use, and the textures bound from unit firstUnit on. */
  bind(program: WebGLProgram, firstUnit?: number): void;
}

// ---- Materials

export interface MaterialTensor {
  rankLight: number;
  rankView: number;
  rankX: number;
  rankY: number;
  clusters: number;
  mixture: number;
  viewMapSide: number;
  terms: number;
}
export interface MaterialInfo {
  visibility: "none" | "binary" | "distance";
  visibilityThreshold: number;
  visibilityWeight: number;
  lightCount: number;
  viewCount: number;
  width: number;
  height: number;
  btf: MaterialTensor;
  votf: MaterialTensor;
  decodeFetches: number;
  decodeMultiplyAdds: number;
  lightFetches: number;
  lightMultiplyAdds: number;
  occlusionFetches: number;
  occlusionMultiplyAdds: number;
  compressedBytes: number;
  viewMapBytes: number;
  tableBytes: number;
  neuralChannels: number;
  neuralUnits: number;
  furtherDecodeFetches: number;
  furtherOcclusionFetches: number;
}
export interface MaterialPixel {
  uv: Numbers;
  dx?: Numbers;
  dy?: Numbers;
  view: Numbers;
  light: Numbers;
}
export class Material extends Owned {
  private constructor();
  readonly info: MaterialInfo;
  evaluate(pixels: MaterialPixel[], fetches?: number): { radiance: Float32Array; occlusion: number; visibility: number }[];
}
