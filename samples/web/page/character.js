// The baked data of the character: its geometry, its clips and its .nook file.
const types = { float32: Float32Array, uint32: Uint32Array, uint16: Uint16Array, uint8: Uint8Array };

// Returns the bytes of a file. Calls progress(received, all) while they arrive; `all` is 0 if the server does not say how many
// there are.
export async function fetchBytes(url, progress = () => {}) {
  const response = await globalThis.nookFetch(url).catch((error) => {
    throw new Error(`${url} cannot be fetched (${error.message}); check the connection and the page's content security policy`);
  });
  if (!response.ok) throw new Error(`${url} cannot be fetched (status ${response.status}); samples/web/build.sh makes it`);
  // If the server compresses the file, Content-Length is the number of compressed bytes.
  const all = response.headers.get("Content-Encoding") ? 0 : Number(response.headers.get("Content-Length") ?? 0);
  const parts = [];
  let received = 0;
  try {
    for (let reader = response.body.getReader(), part = await reader.read(); !part.done; part = await reader.read()) {
      parts.push(part.value);
      progress(received += part.value.length, all);
    }
  } catch (error) {
    throw new Error(`${url} stopped after ${received} bytes (${error.message}); load the page again`);
  }
  const bytes = new Uint8Array(received);
  let at = 0;
  for (const part of parts) bytes.set(part, at), (at += part.length);
  return bytes.buffer;
}

const needed = { arrays: ["positions", "normals", "joints", "weights", "indices", "stills"], showcase: ["frames", "references"] };
function arraysOf(places, bytes, url) {
  const arrays = {};
  for (const [name, { type, offset, length }] of Object.entries(places)) {
    const end = offset + length * types[type].BYTES_PER_ELEMENT;
    if (end > bytes.byteLength)
      throw new Error(`${url} is incomplete (it has ${bytes.byteLength} bytes, and its array ${name} ends at ${end}); ` +
        "load the page again, or make the file again with samples/web/build.sh");
    arrays[name] = new types[type](bytes, offset, length);
  }
  return arrays;
}

// Fetches what the first picture needs. Calls progress(name of the file, received, all).
export async function fetchCharacter(folder, progress = () => {}) {
  const [text, bytes, nook] = await Promise.all(["json", "bin", "nook"].map((ending) => {
    const url = `${folder}/character.${ending}`;
    return fetchBytes(url, (received, all) => progress(url, received, all));
  }));
  let description = null;
  try {
    description = JSON.parse(new TextDecoder().decode(text));
  } catch {}
  const lacks = Object.keys(needed).flatMap((part) => needed[part].filter((name) => !types[description?.[part]?.[name]?.type]))[0];
  if (lacks || !Array.isArray(description.clips))
    throw new Error(`${folder}/character.json is damaged or is another file (it does not describe the array ${lacks ?? "of clips"}); samples/web/build.sh makes it`);
  return { ...description, arrays: arraysOf(description.arrays, bytes, `${folder}/character.bin`), nook, isComplete: false };
}

// Fetches what is needed after the first picture: all frames of the clips, and the ray-traced reference.
export async function fetchShowcase(folder, character) {
  const url = `${folder}/showcase.bin`;
  Object.assign(character.arrays, arraysOf(character.showcase, await fetchBytes(url), url));
  character.isComplete = true;
}

// Returns the matrices of a clip at a time, with 12 floats for each bone, interpolated between the two nearest frames. Until
// all frames have arrived, returns the matrices of the reference.
export function samplePose(character, clip, seconds, out) {
  if (!character.isComplete) return referencePose(character, clip, out);
  const { first_frame: first, frames, seconds: length } = character.clips[clip];
  const floats = 12 * character.bones;
  const at = ((((seconds / length) % 1) + 1) % 1) * frames;
  const a = Math.floor(at) % frames, b = (a + 1) % frames, t = at - Math.floor(at);
  const all = character.arrays.frames, from = (first + a) * floats, to = (first + b) * floats;
  for (let i = 0; i < floats; ++i) out[i] = all[from + i] * (1 - t) + all[to + i] * t;
  for (let i = 0; i < floats; i += 12) straighten(out, i, Math.hypot(all[from + i], all[from + i + 4], all[from + i + 8]));
  return out;
}

// Replaces the axes of a 3x4 matrix by a rotation with one scale. The axes of a mean of two rotations are shorter and no longer
// perpendicular.
function straighten(matrix, at, scale) {
  const axis = (column) => [matrix[at + column], matrix[at + column + 4], matrix[at + column + 8]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const unit = (v) => v.map((value) => value / Math.sqrt(dot(v, v)));
  const x = unit(axis(0)), second = axis(1), along = dot(x, second);
  const y = unit(second.map((value, i) => value - along * x[i]));
  const z = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
  [x, y, z].forEach((v, column) => v.forEach((value, row) => (matrix[at + 4 * row + column] = scale * value)));
}

// Returns the matrices of the frame for which there is a ray-traced reference.
export function referencePose(character, clip, out) {
  const floats = 12 * character.bones;
  out.set(character.arrays.stills.subarray(clip * floats, (clip + 1) * floats));
  return out;
}
