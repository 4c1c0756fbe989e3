// nook-web: ambient occlusion for WebGL 2. The names of options are those of the C headers in camelCase, constants are words;
// the headers in sdk/include/nook describe each of them. Lengths are in metres. Every call that fails throws NookError. Lists of
// numbers that are too short, too long or no numbers are refused by name.

export class NookError extends Error {
  /** The name of the result, such as "NOOK_ERROR_BAD_FILE". */
  readonly code: string;
}

export type Bytes = ArrayBuffer | ArrayBufferView;
export type Numbers = ArrayLike<number>;
export type Instance = number;
export type Occluder = number;

export interface LoadOptions {
  /** Where nook.wasm is, if it does not lie beside this file; or its bytes or module. Node reads file: addresses and paths itself. */
  wasm?: string | URL | Response | Bytes | WebAssembly.Module | Promise<Response | Bytes | WebAssembly.Module>;
  /** Takes the lines of the library's log. */
  log?: (severity: "info" | "warning" | "error", text: string) => void;
  /** The instruction set of all objects of the context. */
  isa?: "auto" | "scalar" | "wasm128";
  /** Units of length of your scene in a metre, such as 100; default 1. */
  unitsPerMetre?: number;
}
/** Loads the module of WebAssembly and makes a context in it. */
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
  /** The index in the file of the skin that "skinning" takes. */
  skin?: number;
  /** For each bone of the model the index of its transform, or -1; see CharacterModel.mapBones. */
  transformOfBone?: Numbers;
  /** 3x4, row-major, applied after every transform. */
  place3x4?: Numbers;
  /** Bones without a transform keep their matrices. */
  partial?: boolean;
  strict?: boolean;
  /** There may be more transforms than needed, as in three.js's Skeleton.boneMatrices; the first ones count. */
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
  /** The model's vertex for each vertex of a host's mesh; 0xffffffff where none is near enough. joints and weights, which are as
   * many for each vertex, tell vertices apart where meshes meet. indices are three for each triangle, and tell the two sides of a sharp fold apart. ambiguous counts
   * the vertices that nothing tells apart, and text names them. */
  matchVertices(match: { positions: Numbers; normals?: Numbers; joints?: Numbers; weights?: Numbers; skin?: number; primitive?: number;
    indices?: Numbers; inRestSpace?: boolean; tolerance?: number }): { vertices: Uint32Array; unmatched: number; ambiguous: number; text: string };
  /** A model whose vertices are those of a host's mesh. */
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
  /** The change of AO, root mean square, by which far spheres may be merged; 0 merges none. */
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
  /** What becomes of the state of WebGL that a call touches; see docs/gl_state.md. Default "defaults". "preserve" is slow in
   *  browsers, and cannot restore objects that the host made. */
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
  /** Of "directional-ao": a TEXTURE_2D for the sampler nook_scene_lights of the GLSL. */
  texture: WebGLTexture | null;
  /** Of "directional-ao": the first argument of the GLSL's functions. */
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
  /** Call it on "webglcontextlost"; then destroy everything, and make it anew on "webglcontextrestored". Other calls into WebGL throw
   *  between the loss and that. */
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
  /** Gives taps, halfResolution and blur that are not set. Default "default". */
  preset?: "default" | "fast" | "best";
  taps?: 9 | 16 | 32 | 64 | 128 | 256;
  halfResolution?: boolean | number;
  /** How often the filter runs: 0, 1 or 2. */
  blur?: number;
  blurSharpness?: number;
  /** The texture is then RGBA8: the bent normal in view space as (n + 1) / 2, and AO in alpha. */
  bentNormals?: boolean | number;
  /** A mean over at most so many frames; 0: none. */
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
  /** Metres, or the share that radiusKind says. */
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
  /** Where the result goes: nothing for the pass's own texture, null for the canvas. */
  target?: WebGLTexture | WebGLFramebuffer | null;
  blend?: "write" | "multiply";
  /** A debug view. */
  show?: "ao" | "raw" | "blurred" | "normals";
  /** Set it after a texture of yours has been given another size or format. */
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
  /** The result in its red channel, where the target is the pass's own texture. */
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
  /** Cells in which walls choose among the probes; 0: a grid without walls. */
  wallCells: number;
}
export interface ProbeFitOptions {
  method?: "least-squares" | "least-squares-non-negative" | "running-average" | "running-average-non-negative";
  /** "paper" is the published method; leave method and matchSh out then. */
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
  /** The same for glossy reflection, with amplitudes that are never negative. Throws for a probe that has none. */
  glossLobes(position?: Numbers): Lobe[];
  /** Three floats for each function of a probe of the grid. */
  coefficients(index?: number): Float32Array;
  /** The position is three floats for all directions, or three for each. */
  radiance(directions: Numbers, position?: Numbers): Float32Array;
  /** As radiance. Only probes on the surface's side of a wall count. */
  irradiance(normals: Numbers, position?: Numbers): Float32Array;
}
/** A probe, a grid or a material as textures, and the GLSL that reads them. */
export class Upload extends Owned {
  private constructor();
  /** Replaces the probe of an upload of a probe. */
  update(probe: Probe): void;
  readonly info: {
    /** Bind each to a unit without a sampler object, and set the uniform of its name; or call bind. */
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
