// Nook in three.js: AO of skinned meshes as an attribute of their vertices, and AO of the screen as a pass of EffectComposer.
import { BufferGeometry, GLBufferAttribute, Matrix4, ShaderChunk } from "three";
import { Pass } from "three/addons/postprocessing/Pass.js";

// Returns a copy of the material that multiplies ambient light by Nook's AO, where three.js would multiply it by an aoMap.
function occluded(material, share) {
  const ambient = ShaderChunk.aomap_fragment.replace("#ifdef USE_AOMAP", "#if 1")
    .replace(/float ambientOcclusion =[^;]*;/, "float ambientOcclusion = mix(1.0, saturate(vNookAo), nookShare);");
  const copy = material.clone();
  copy.onBeforeCompile = (shader) => {
    shader.uniforms.nookShare = share;
    shader.vertexShader = "attribute float nookAo;\nvarying float vNookAo;\n" +
      shader.vertexShader.replace("#include <begin_vertex>", "#include <begin_vertex>\nvNookAo = nookAo;");
    shader.fragmentShader = "varying float vNookAo;\nuniform float nookShare;\n" +
      shader.fragmentShader.replace("#include <aomap_fragment>", ambient);
  };
  return copy;
}

// Returns the numbers of a mesh's attribute, or undefined if the mesh does not have it.
function values({ geometry: { attributes } }, name) {
  const from = attributes[name];
  return from && Array.from({ length: from.count * from.itemSize }, (_, i) => from.getComponent(Math.floor(i / from.itemSize), i % from.itemSize));
}

// Finds the vertices of a mesh in the model. The GLTFLoader makes one mesh for each primitive of the file, so this looks for a
// primitive that has all of the vertices. If there is none, it searches all primitives. Where meshes meet, joints and weights
// distinguish vertices. They refer to the only skin that has as many joints as the mesh. Triangles distinguish the two sides of
// a sharp fold.
function matchMesh(model, mesh, taken) {
  const { count } = mesh.geometry.attributes.position, { primitiveCount, skinCount } = model.info;
  const skins = Array.from({ length: skinCount }, (_, i) => model.skin(i)).filter(({ jointCount }) => jointCount === mesh.skeleton?.bones.length);
  const bound = skins.length === 1 && { skin: skins[0].fileIndex, joints: values(mesh, "skinIndex"), weights: values(mesh, "skinWeight") };
  const indices = mesh.geometry.index?.array ?? Array.from({ length: count - (count % 3) }, (_, i) => i);
  const match = { positions: values(mesh, "position"), normals: values(mesh, "normal"), indices, ...bound };
  for (let primitive = 0; primitive < primitiveCount; ++primitive) {
    if (taken.has(primitive) || model.primitive(primitive).count !== count) continue;
    const found = model.matchVertices({ ...match, primitive });
    if (found.unmatched) continue;
    taken.add(primitive);
    return found;
  }
  return model.matchVertices(match);
}

// Create one for each WebGLRenderer. `scene` is Nook's scene, for links, ground and occluders. share.value is how much of the
// AO is used, from 0 to 1.
export class NookThree {
  share = { value: 1 };
  characters = [];
  #lose = () => {
    this.gl?.contextLost();
    this.gl?.destroy();
    this.gl = null;
  };
  #adopt = () => {
    // If the context is lost again while it is being restored, another event follows.
    if (this.webgl.isContextLost()) return;
    this.gl = this.nook.createGl(this.webgl);
    this.characters.forEach(({ parts }) => parts.forEach((part) => this.#makeBuffer(part)));
    this.renderer.resetState();
  };
  constructor(nook, renderer) {
    Object.assign(this, { nook, renderer, webgl: renderer.getContext(), scene: nook.createScene(), gl: null });
    this.#adopt();
    renderer.domElement.addEventListener("webglcontextlost", this.#lose);
    renderer.domElement.addEventListener("webglcontextrestored", this.#adopt);
  }

  // False while the context is lost. Frames are then skipped.
  get isAlive() {
    return this.gl !== null && !this.webgl.isContextLost();
  }

  #makeBuffer({ attribute }) {
    if (!this.isAlive) return;
    this.webgl.bindBuffer(this.webgl.ARRAY_BUFFER, attribute.setBuffer(this.webgl.createBuffer()).buffer);
    this.webgl.bufferData(this.webgl.ARRAY_BUFFER, new Float32Array(attribute.count).fill(1), this.webgl.DYNAMIC_COPY);
  }

  // Gives AO to the skinned meshes of one character. The meshes must share a skeleton, and `model` is the bake of their file.
  // The result's `instance` is the character's number in `scene`.
  add(model, ...meshes) {
    if (!meshes.length || meshes.some((mesh) => !mesh?.geometry?.attributes?.position))
      throw new Error("NookThree.add: give the model, then the skinned meshes of one character");
    if (meshes.some((mesh) => mesh.geometry.attributes.nookAo)) throw new Error("NookThree.add: a mesh has already been added; remove its character first");
    const taken = new Set(), matches = meshes.map((mesh) => matchMesh(model, mesh, taken));
    const vertices = matches.flatMap((match) => [...match.vertices]), unmatched = matches.reduce((sum, match) => sum + match.unmatched, 0);
    for (const { ambiguous, text } of matches) if (ambiguous) console.warn(`NookThree.add: ${text}`);
    if (unmatched) throw new Error(`NookThree.add: ${unmatched} of ${vertices.length} vertices are not in the model; bake the file again`);
    const own = model.remap(vertices), instance = this.scene.addInstance(own);
    own.destroy();
    let first = 0;
    const parts = meshes.map((mesh) => {
      const { count } = mesh.geometry.attributes.position;
      const attribute = new GLBufferAttribute(null, this.webgl.FLOAT, 1, 4, count);
      const before = { geometry: mesh.geometry, material: mesh.material };
      // Instances of a character may share a geometry, but not its AO.
      const { index, attributes, groups, drawRange, morphAttributes, morphTargetsRelative } = mesh.geometry;
      mesh.geometry = Object.assign(new BufferGeometry(),
        { index, groups, drawRange, morphAttributes, morphTargetsRelative, attributes: { ...attributes, nookAo: attribute } });
      mesh.material = Array.isArray(mesh.material) ? mesh.material.map((each) => occluded(each, this.share)) : occluded(mesh.material, this.share);
      first += count;
      return { mesh, before, attribute, offset: 4 * (first - count) };
    });
    parts.forEach((part) => this.#makeBuffer(part));
    const character = { mesh: meshes[0], instance, parts, transforms: new Float32Array(16 * meshes[0].skeleton.bones.length) };
    return this.characters[this.characters.push(character) - 1];
  }

  // Removes a character that add() returned. Its meshes get their own geometry and materials back.
  remove(character) {
    const at = this.characters.indexOf(character);
    if (at < 0) throw new Error("NookThree.remove: this character is not in the host; pass the result of add()");
    this.characters.splice(at, 1);
    this.scene.removeInstance(character.instance);
    for (const { mesh, before, attribute } of character.parts) {
      for (const material of [mesh.material].flat()) material.dispose();
      // The copy shares everything except the AO with the old geometry, whose buffers three.js still uses.
      mesh.geometry.deleteAttribute("nookAo");
      Object.assign(mesh, before);
      if (this.isAlive) this.webgl.deleteBuffer(attribute.buffer);
    }
    this.renderer.resetState();
  }
  // Removes all characters, and releases the scene and everything in the renderer's context. Dispose of the passes first.
  dispose() {
    while (this.characters.length) this.remove(this.characters.at(-1));
    this.renderer.domElement.removeEventListener("webglcontextlost", this.#lose);
    this.renderer.domElement.removeEventListener("webglcontextrestored", this.#adopt);
    this.gl?.destroy();
    this.gl = null;
    this.scene.destroy();
  }

  // Returns a character's pose for Nook: the matrices with which three.js skins, to world space. three.js makes boneMatrices
  // longer than the bones need, so that they fill a texture.
  pose({ mesh, transforms }) {
    /* [pose] */
    const place = new Matrix4().multiplyMatrices(mesh.matrixWorld, mesh.bindMatrixInverse), matrix = new Matrix4();
    mesh.skeleton.update();
    for (let i = 0; i < transforms.length; i += 16)
      matrix.fromArray(mesh.skeleton.boneMatrices, i).multiply(mesh.bindMatrix).premultiply(place).toArray(transforms, i);
    return { kind: "skinning", layout: "columns-4x4", transforms };
    /* [end] */
  }

  // Call this once per frame, after the animations have moved and before the renderer draws.
  update(scene) {
    if (!this.isAlive) return;
    const { gl, webgl } = this;
    scene.updateMatrixWorld();
    for (const character of this.characters) this.scene.setPose(character.instance, this.pose(character));
    gl.update(this.scene);
    for (const { instance, parts } of this.characters) {
      const view = gl.view(this.scene, instance);
      webgl.bindBuffer(webgl.COPY_READ_BUFFER, view.buffer);
      for (const { attribute, offset } of parts) {
        webgl.bindBuffer(webgl.COPY_WRITE_BUFFER, attribute.buffer);
        webgl.copyBufferSubData(webgl.COPY_READ_BUFFER, webgl.COPY_WRITE_BUFFER, view.offset + offset, 0, 4 * attribute.count);
      }
    }
    // WebGL refuses to write a buffer by transform feedback while another target holds it.
    webgl.bindBuffer(webgl.COPY_READ_BUFFER, null);
    this.renderer.resetState();
  }
}

// Add this pass after the RenderPass. The composer's render target needs a depthTexture; the pass multiplies the target's
// colour. `frame` has values that may change in each frame, such as radius and intensity. `options` has the values with which
// the pass is created: preset, taps, blur, halfResolution, maxHistoryFrames and others of createNnao. To change them, assign a
// new object to `options`.
export class NookPass extends Pass {
  needsSwap = false;
  constructor(host, camera, frame = {}, options = {}) {
    super();
    Object.assign(this, { host, camera, frame, options, nnao: null });
  }
  // Returns the WebGLTexture of a texture of three.js.
  #webglOf(renderer, of, what) {
    if (!of?.isTexture) throw new Error(`NookPass: ${what} needs a THREE.Texture (got ${of?.constructor?.name ?? of})`);
    const { __webglTexture: texture } = renderer.properties.get(of);
    if (!texture) throw new Error(`NookPass: three.js has not drawn to ${what} yet; add the pass after the RenderPass`);
    return texture;
  }
  render(renderer, _, { width, height, texture, depthTexture }) {
    if (!this.host.isAlive) return;
    const { gl } = this.host, { camera, options } = this;
    if (!depthTexture) throw new Error("NookPass: the composer's render target has no depthTexture; give EffectComposer a render target with a depthTexture");
    // Textures in `frame` may be textures of three.js, such as a normalTexture.
    const frame = { ...this.frame };
    for (const [name, value] of Object.entries(frame)) if (value?.isTexture) frame[name] = this.#webglOf(renderer, value, name);
    if (renderer.capabilities.logarithmicDepthBuffer && frame.depthKind === undefined)
      throw new Error("NookPass: the renderer's depth is logarithmic; leave logarithmicDepthBuffer out, or set depthKind and the members that nook_nnao.h describes with it");
    const depth = this.#webglOf(renderer, depthTexture, "the depthTexture"), colour = this.#webglOf(renderer, texture, "the colour");
    if (this.gl !== gl || this.width !== width || this.height !== height || this.made !== options) {
      this.nnao?.destroy();
      this.nnao = null;
      const nnao = gl.createNnao({ ...options, maxWidth: width, maxHeight: height });
      Object.assign(this, { gl, width, height, made: options, nnao });
    }
    this.nnao.render({ width, height, depthTexture: depth, projection: camera.projectionMatrix.elements, view: camera.matrixWorldInverse.elements,
      target: colour, blend: "multiply", ...frame });
    renderer.resetState();
  }
  dispose() {
    this.nnao?.destroy();
    this.nnao = null;
    this.made = null;
    this.gl = null;
  }
}
