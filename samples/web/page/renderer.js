// Draws a frame: skinning, lamp depth, depth of the view, Nook's screen-space pass, and the picture. Everything here belongs to
// one WebGL context, and is made again after the context was lost.
import { lookAt, multiply, orthographic, perspective, scale } from "./matrix.js";
import { Program, depthTarget, texture } from "./program.js";
import { ballFragment, ballVertex, bodyDepthVertex, bodyFragment, bodyVertex, depthFragment, groundFragment, groundVertex,
  screenFragment, screenVertex, skinVertex } from "./shaders.js";

const lampMapSize = 1024;
const fovY = 0.62;
const near = 0.2, far = 60;
const groundHalfSize = 40;
const skinnedBytes = 24;  // per vertex: position and normal
const background = [0.8, 0.83, 0.87];

// Makes a ball of strips; uv repeats around it.
function ballMesh(rows, columns) {
  const vertices = [], indices = [];
  for (let r = 0; r <= rows; ++r)
    for (let c = 0; c <= columns; ++c) {
      const theta = (Math.PI * r) / rows, phi = (2 * Math.PI * c) / columns;
      vertices.push(Math.sin(theta) * Math.sin(phi), Math.cos(theta), Math.sin(theta) * Math.cos(phi), (6 * c) / columns, (-3 * r) / rows);
      if (r < rows && c < columns) {
        const a = r * (columns + 1) + c, b = a + columns + 1;
        indices.push(a, b, a + 1, a + 1, b, b + 1);
      }
    }
  return { vertices: new Float32Array(vertices), indices: new Uint16Array(indices) };
}

function buffer(gl, target, data) {
  const made = gl.createBuffer();
  gl.bindBuffer(target, made);
  gl.bufferData(target, data, gl.STATIC_DRAW);
  return made;
}

export class Renderer {
  constructor(webgl, nook, character, probe, material) {
    this.gl = webgl;
    this.character = character;
    this.ao = nook.createGl(webgl);
    this.probe = this.ao.uploadProbe(probe);
    this.material = null;
    this.pass = null;
    this.bodyPrograms = new Map();  // by the form of the light
    this.#makeGeometry();
    this.skin = new Program(webgl, skinVertex, depthFragment, ["world", "world_normal"]);
    this.feedback = webgl.createTransformFeedback();
    this.bodyDepth = new Program(webgl, bodyDepthVertex, depthFragment);
    this.groundDepth = new Program(webgl, groundVertex, depthFragment);
    this.ballDepth = new Program(webgl, ballVertex, depthFragment);
    this.groundProgram = new Program(webgl, groundVertex, groundFragment);
    this.screenProgram = new Program(webgl, screenVertex, screenFragment);
    if (material) this.addMaterial(material);
    this.lampMap = depthTarget(webgl, lampMapSize, lampMapSize, true);
  }

  addMaterial(material) {
    this.material = this.ao.uploadMaterial(material);
    this.ballProgram = new Program(this.gl, ballVertex, ballFragment(this.probe.info.glsl + this.material.info.glsl));
  }

  addReferences() {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.references);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, this.character.arrays.references, this.gl.STATIC_DRAW);
  }

  #makeGeometry() {
    const { gl } = this;
    const { positions, normals, joints, weights, indices } = this.character.arrays;
    this.restArray = gl.createVertexArray();
    gl.bindVertexArray(this.restArray);
    const floats = (slot, data, size, type = gl.FLOAT, normalised = false) => {
      const made = buffer(gl, gl.ARRAY_BUFFER, data);
      gl.enableVertexAttribArray(slot);
      gl.vertexAttribPointer(slot, size, type, normalised, 0, 0);
      return made;
    };
    floats(0, positions, 3);
    floats(1, normals, 3);
    buffer(gl, gl.ARRAY_BUFFER, joints);
    gl.enableVertexAttribArray(2);
    gl.vertexAttribIPointer(2, 4, gl.UNSIGNED_SHORT, 0, 0);
    floats(3, weights, 4);
    this.bodyArray = gl.createVertexArray();
    gl.bindVertexArray(this.bodyArray);
    // The reference arrives after the first picture, but an attribute needs a buffer before.
    this.references = floats(6, this.character.arrays.references ?? new Uint8Array(this.character.vertices), 1, gl.UNSIGNED_BYTE, true);
    buffer(gl, gl.ELEMENT_ARRAY_BUFFER, indices);
    this.ballArray = gl.createVertexArray();
    gl.bindVertexArray(this.ballArray);
    const ball = ballMesh(40, 80);
    this.ballIndices = ball.indices.length;
    buffer(gl, gl.ARRAY_BUFFER, ball.vertices);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 20, 0);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 2, gl.FLOAT, false, 20, 12);
    buffer(gl, gl.ELEMENT_ARRAY_BUFFER, ball.indices);
    this.emptyArray = gl.createVertexArray();
    gl.bindVertexArray(null);
    this.bones = null;
    this.skinned = null;
  }

  // Makes depth, pass and bones for a size of the canvas and a number of bodies.
  #fit(width, height, bodies) {
    const { gl } = this;
    if (!this.view || this.view.width !== width || this.view.height !== height) {
      if (this.view) {
        gl.deleteTexture(this.view.depth);
        gl.deleteFramebuffer(this.view.framebuffer);
        this.pass.destroy();
      }
      this.view = depthTarget(gl, width, height);
      this.pass = this.ao.createNnao({ maxWidth: width, maxHeight: height, taps: 16, blur: 2 });
    }
    if (!this.bones || this.bones.rows < bodies) {
      if (this.bones) gl.deleteTexture(this.bones.texture);
      if (this.skinned) gl.deleteBuffer(this.skinned);
      this.skinned = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, this.skinned);
      gl.bufferData(gl.ARRAY_BUFFER, bodies * this.character.vertices * skinnedBytes, gl.DYNAMIC_COPY);
      gl.bindBuffer(gl.ARRAY_BUFFER, null);
      this.bones = { rows: bodies, texture: texture(gl, gl.RGBA32F, 3 * this.character.bones, bodies) };
    }
  }

  #skin(bodies) {
    const { gl } = this;
    const { bones, vertices } = this.character;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.bones.texture);
    bodies.forEach((body, row) => gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, 3 * bones, 1, gl.RGBA, gl.FLOAT, body.world));
    this.skin.use({ bones: this.bones.texture });
    gl.bindVertexArray(this.restArray);
    gl.enable(gl.RASTERIZER_DISCARD);
    gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, this.feedback);
    bodies.forEach((_, row) => {
      const bytes = vertices * skinnedBytes;
      this.skin.set({ body: row });
      gl.bindBufferRange(gl.TRANSFORM_FEEDBACK_BUFFER, 0, this.skinned, row * bytes, bytes);
      gl.beginTransformFeedback(gl.POINTS);
      gl.drawArrays(gl.POINTS, 0, vertices);
      gl.endTransformFeedback();
    });
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
    gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, null);
    gl.disable(gl.RASTERIZER_DISCARD);
  }

  #drawBodies(bodies, each = () => {}) {
    const { gl } = this;
    gl.bindVertexArray(this.bodyArray);
    bodies.forEach((body, row) => {
      const first = row * this.character.vertices * skinnedBytes;
      gl.bindBuffer(gl.ARRAY_BUFFER, this.skinned);
      for (const slot of [0, 1]) {
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, skinnedBytes, first + 12 * slot);
      }
      each(body);
      gl.drawElements(gl.TRIANGLES, this.character.arrays.indices.length, gl.UNSIGNED_INT, 0);
    });
  }
  #drawGround() {
    this.gl.bindVertexArray(this.emptyArray);
    this.gl.drawArrays(this.gl.TRIANGLE_STRIP, 0, 4);
  }
  #drawBall() {
    this.gl.bindVertexArray(this.ballArray);
    this.gl.drawElements(this.gl.TRIANGLES, this.ballIndices, this.gl.UNSIGNED_SHORT, 0);
  }

  #drawDepth(target, clip_from_world, bodies, ball, ground) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.viewport(0, 0, target.width, target.height);
    gl.enable(gl.DEPTH_TEST);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.bodyDepth.use({ clip_from_world });
    this.#drawBodies(bodies);
    if (ball) {
      this.ballDepth.use({ clip_from_world, ball });
      this.#drawBall();
    }
    if (!ground) return;
    this.groundDepth.use({ clip_from_world, half_size: groundHalfSize });
    this.#drawGround();
  }

  // Binds an instance's AO as the attributes 4 and 5, and its reference as the attribute 6.
  #bindAo(crowd, body, options) {
    const { gl } = this;
    const view = this.ao.view(crowd.scene, body.instance);
    gl.bindBuffer(gl.ARRAY_BUFFER, view.buffer);
    gl.enableVertexAttribArray(4);
    gl.vertexAttribPointer(4, 1, gl.FLOAT, false, view.stride, view.offset);
    if (options.light === "lobes") {
      const light = this.ao.view(crowd.scene, body.instance, "directional-ao");
      gl.bindBuffer(gl.ARRAY_BUFFER, light.buffer);
      gl.enableVertexAttribArray(5);
      gl.vertexAttribPointer(5, 3, gl.FLOAT, false, light.stride, light.offset);
      this.bodyProgram.set({ light: light.light, nook_scene_lights: light.texture });
    } else {
      gl.disableVertexAttribArray(5);
      gl.vertexAttrib3f(5, 1, 1, 1);
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, this.references);
    gl.vertexAttribPointer(6, 1, gl.UNSIGNED_BYTE, true, 0, body.clip * this.character.vertices);
  }

  // The program of the bodies includes Nook's GLSL for the lights.
  #bodyProgramOf(crowd, form) {
    if (!this.bodyPrograms.has(form)) {
      const { glsl } = this.ao.view(crowd.scene, crowd.bodies[0].instance);
      this.bodyPrograms.set(form, new Program(this.gl, bodyVertex, bodyFragment(this.probe.info.glsl + glsl, form)));
    }
    return this.bodyPrograms.get(form);
  }

  // options: view, light, characterAo, screenAo, radius, lampDirection, lamp, exposure, eye, target, ball, irradiance (the
  // mean), irradianceUp (on the ground).
  draw(crowd, options) {
    const { gl } = this;
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    const { bodies } = crowd;
    const views = { lit: 0, ao: 1, error: 2, screen: 1 };
    const ball = options.ball ? [...options.ball] : null;
    this.ao.update(crowd.scene);
    this.bodyProgram = this.#bodyProgramOf(crowd, options.light);
    this.#fit(width, height, bodies.length);
    this.#skin(bodies);

    const world = multiply(orthographic(7, 7, 0.1, 40), lookAt(scale(options.lampDirection, 20), [0, 0.8, 0]));
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1.5, 2);
    this.#drawDepth(this.lampMap, world, bodies, ball, false);
    gl.disable(gl.POLYGON_OFFSET_FILL);

    const projection = perspective(fovY, width / height, near, far);
    const clip = multiply(projection, lookAt(options.eye, options.target));
    const useScreen = options.screenAo || options.view === "screen";
    if (useScreen) {
      this.#drawDepth(this.view, clip, bodies, ball, true);
      this.pass.render({ depthTexture: this.view.depth, width, height, projection, radius: options.radius });
    }

    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    const behind = options.view === "lit" ? background : options.view === "error" ? [0.95, 0.95, 0.95] : [1, 1, 1];
    gl.clearColor(...behind, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (options.view === "screen") {
      gl.disable(gl.DEPTH_TEST);
      this.screenProgram.use({ screen_ao: this.pass.texture });
      gl.bindVertexArray(this.emptyArray);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      return this.#end();
    }
    gl.enable(gl.DEPTH_TEST);
    const shared = {
      clip_from_world: clip, eye: options.eye, background: behind, exposure: options.exposure,
      lamp_direction: options.lampDirection, lamp_colour: scale([1, 0.9, 0.74], 2.6 * options.lamp), lamp_from_world: world,
      lamp_depth: this.lampMap.depth, use_screen_ao: useScreen, screen_depth: this.view.depth, screen_ao: this.pass.texture,
      view: views[options.view], constant_irradiance: options.irradiance,
      ground_irradiance: options.light === "constant" ? options.irradiance : options.irradianceUp, nook_probe_texels: this.probe.info.textures[0].texture,
    };
    this.bodyProgram.use({ ...shared, use_ao: options.characterAo });
    this.#drawBodies(bodies, (body) => {
      const [a, b] = body.tint;
      this.bodyProgram.set({ albedo: [0.62 + 0.16 * a, 0.56 + 0.12 * a, 0.5 + 0.1 * a + 0.1 * b] });
      this.#bindAo(crowd, body, options);
    });
    this.groundProgram.use({ ...shared, half_size: groundHalfSize });
    this.#drawGround();
    if (ball) this.#drawMaterial({ ...shared, ball });
    this.#end();
  }

  // Draws the opaque pixels of the meso-structure first, then its edges.
  #drawMaterial(values) {
    const { gl } = this;
    this.ballProgram.use(values);
    for (const each of this.material.info.textures) this.ballProgram.set({ [each.uniform]: each });
    this.ballProgram.set({ solid: true });
    this.#drawBall();
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    this.ballProgram.set({ solid: false });
    this.#drawBall();
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  #end() {
    this.gl.bindVertexArray(null);
    this.gl.useProgram(null);
  }

  // If the context was lost, WebGL has already deleted the page's own objects.
  destroy() {
    this.pass?.destroy();
    this.probe.destroy();
    this.material?.destroy();
    this.ao.destroy();
  }
}
