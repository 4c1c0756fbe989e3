// Makes the page's own programs and textures.
function shader(gl, kind, source) {
  const made = gl.createShader(kind);
  gl.shaderSource(made, source);
  gl.compileShader(made);
  if (!gl.getShaderParameter(made, gl.COMPILE_STATUS) && !gl.isContextLost())
    throw new Error(`a shader of the page does not compile: ${gl.getShaderInfoLog(made)}\n${source}`);
  return made;
}

const head = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2DShadow;\n" +
  "precision highp sampler2DArray;\n";

// A program whose uniforms are set by name: p.set({ exposure: 1, light: [0, 1, 0], map: texture }). For a sampler, pass the
// texture, or { texture, target }. `feedback` lists the vertex shader's outputs that transform feedback writes.
export class Program {
  constructor(gl, vertex, fragment, feedback = null) {
    this.gl = gl;
    this.program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const made = shader(gl, kind, head + text);
      gl.attachShader(this.program, made);
      gl.deleteShader(made);
    }
    if (feedback) gl.transformFeedbackVaryings(this.program, feedback, gl.INTERLEAVED_ATTRIBS);
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(`a program of the page does not link: ${gl.getProgramInfoLog(this.program)}`);
    this.uniforms = new Map();
    this.units = new Map();
    const count = gl.getProgramParameter(this.program, gl.ACTIVE_UNIFORMS) ?? 0;
    for (let i = 0; i < count; ++i) {
      const { name, type } = gl.getActiveUniform(this.program, i);
      this.uniforms.set(name, { type, location: gl.getUniformLocation(this.program, name) });
    }
    // Samplers of different kinds must not share a unit, even if no texture is set.
    const plain = [gl.FLOAT, gl.FLOAT_VEC2, gl.FLOAT_VEC3, gl.FLOAT_VEC4, gl.FLOAT_MAT4, gl.INT, gl.BOOL];
    gl.useProgram(this.program);
    for (const [name, { type, location }] of this.uniforms) {
      if (plain.includes(type)) continue;
      this.units.set(name, this.units.size);
      gl.uniform1i(location, this.units.get(name));
    }
  }

  use(values = {}) {
    this.gl.useProgram(this.program);
    return this.set(values);
  }

  set(values) {
    const { gl } = this;
    for (const [name, value] of Object.entries(values)) {
      const uniform = this.uniforms.get(name);
      if (!uniform) continue;
      const { location, type } = uniform;
      switch (type) {
        case gl.FLOAT: gl.uniform1f(location, value); break;
        case gl.FLOAT_VEC2: gl.uniform2fv(location, value); break;
        case gl.FLOAT_VEC3: gl.uniform3fv(location, value); break;
        case gl.FLOAT_VEC4: gl.uniform4fv(location, value); break;
        case gl.FLOAT_MAT4: gl.uniformMatrix4fv(location, false, value); break;
        case gl.INT: case gl.BOOL: gl.uniform1i(location, Number(value)); break;
        default: this.#bind(name, value);
      }
    }
    return this;
  }

  #bind(name, value) {
    const { gl } = this;
    const unit = this.units.get(name);
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindSampler(unit, null);
    if (value?.target) gl.bindTexture(value.target, value.texture);
    else gl.bindTexture(gl.TEXTURE_2D, value);
  }
}

export function texture(gl, format, width, height, filter = gl.NEAREST) {
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, filter);
  for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
  return made;
}

export function depthTarget(gl, width, height, compare = false) {
  const depth = texture(gl, gl.DEPTH_COMPONENT24, width, height, compare ? gl.LINEAR : gl.NEAREST);
  if (compare) {
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL);
  }
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
  gl.drawBuffers([gl.NONE]);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  return { depth, framebuffer, width, height };
}
