// Nook in three.js: AO of skinned meshes as an attribute of their vertices, and AO of the screen as a pass of EffectComposer.
import { BufferGeometry, GLBufferAttribute, Matrix4, ShaderChunk, Vector3 } from "three";
import { Pass } from "three/addons/postprocessing/Pass.js";

// A copy of the material whose ambient light is multiplied by Nook's AO, where three.js multiplies it by an aoMap.
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

const values = (meshes, name) => meshes.flatMap(({ geometry: { attributes: { [name]: from } } }) =>
  Array.from({ length: from?.count ?? 0 }, (_, i) => new Vector3().fromBufferAttribute(from, i).toArray()).flat());

// One for each WebGLRenderer. `scene` is Nook's own, for links, ground and occluders; share.value is the share of AO in use.
export class NookThree {
  share = { value: 1 };
  characters = [];
  constructor(nook, renderer) {
    Object.assign(this, { renderer, webgl: renderer.getContext(), scene: nook.createScene() });
    const adopt = () => {
      this.gl = nook.createGl(this.webgl);
      this.characters.forEach(({ parts }) => parts.forEach((part) => this.#makeBuffer(part)));
      renderer.resetState();
    };
    adopt();
    renderer.domElement.addEventListener("webglcontextlost", () => {
      this.gl.contextLost();
      this.gl.destroy();
    });
    renderer.domElement.addEventListener("webglcontextrestored", adopt);
  }

  #makeBuffer({ attribute }) {
    this.webgl.bindBuffer(this.webgl.ARRAY_BUFFER, attribute.setBuffer(this.webgl.createBuffer()).buffer);
    this.webgl.bufferData(this.webgl.ARRAY_BUFFER, new Float32Array(attribute.count).fill(1), this.webgl.DYNAMIC_COPY);
  }

  // Gives the skinned meshes of one character AO; they share a skeleton, and model is the bake of their file. The result's
  // `instance` is the character's number in `scene`.
  add(model, ...meshes) {
    const { vertices, unmatched } = model.matchVertices({ positions: values(meshes, "position"), normals: values(meshes, "normal") });
    if (unmatched) throw new Error(`NookThree.add: ${unmatched} of ${vertices.length} vertices are not in the model; bake the file again`);
    const own = model.remap(vertices), instance = this.scene.addInstance(own);
    own.destroy();
    let first = 0;
    const parts = meshes.map((mesh) => {
      const { count } = mesh.geometry.attributes.position;
      const attribute = new GLBufferAttribute(null, this.webgl.FLOAT, 1, 4, count);
      // Instances of a character may share a geometry, but not its AO.
      const { index, attributes, groups, drawRange, morphAttributes, morphTargetsRelative } = mesh.geometry;
      mesh.geometry = Object.assign(new BufferGeometry(),
        { index, groups, drawRange, morphAttributes, morphTargetsRelative, attributes: { ...attributes, nookAo: attribute } });
      mesh.material = occluded(mesh.material, this.share);
      first += count;
      return { attribute, offset: 4 * (first - count) };
    });
    parts.forEach((part) => this.#makeBuffer(part));
    const character = { mesh: meshes[0], instance, parts, transforms: new Float32Array(16 * meshes[0].skeleton.bones.length) };
    return this.characters[this.characters.push(character) - 1];
  }

  // The pose of a character as Nook takes it: the matrices that three.js skins with, to the world.
  pose({ mesh, transforms }) {
    const place = new Matrix4().multiplyMatrices(mesh.matrixWorld, mesh.bindMatrixInverse), matrix = new Matrix4();
    mesh.skeleton.update();
    for (let i = 0; i < transforms.length; i += 16)
      matrix.fromArray(mesh.skeleton.boneMatrices, i).multiply(mesh.bindMatrix).premultiply(place).toArray(transforms, i);
    return { kind: "skinning", layout: "columns-4x4", transforms };
  }

  // Once a frame, when the animations have moved and before the renderer draws.
  update(scene) {
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

// Stands after the RenderPass. The composer's render target needs a depthTexture; the pass multiplies its colour.
export class NookPass extends Pass {
  needsSwap = false;
  constructor(host, camera, frame) {
    super();
    Object.assign(this, { host, camera, frame });
  }
  render(renderer, _, { width, height, texture, depthTexture }) {
    const { gl } = this.host, webglOf = (of) => renderer.properties.get(of).__webglTexture;
    if (!depthTexture) throw new Error("NookPass: the composer's render target has no depthTexture; give EffectComposer one that has");
    if (this.gl !== gl || this.width !== width || this.height !== height) {
      this.nnao?.destroy();
      Object.assign(this, { gl, width, height, nnao: gl.createNnao({ maxWidth: width, maxHeight: height }) });
    }
    this.nnao.render({ width, height, depthTexture: webglOf(depthTexture), projection: this.camera.projectionMatrix.elements,
      target: webglOf(texture), blend: "multiply", ...this.frame });
    renderer.resetState();
  }
}
