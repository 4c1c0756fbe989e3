// Checks of arguments. A failed check throws before anything is written to the module's memory. The message names the function, the
// argument, the passed value and the expected value.
import { NookError } from "./error.js";

const mostNumbers = 2 ** 32;

export function refuse(call, text) {
  throw new NookError(`${call}: ${text}`, "NOOK_ERROR_INVALID_ARGUMENT");
}

const tagOf = (value) => Object.prototype.toString.call(value).slice(8, -1);
const isObject = (value) => typeof value === "object" && value !== null;

// Returns a hint that says what to pass instead of an object that contains the numbers, such as a Vector3 of three.js.
function cureOf(value) {
  if (typeof value.then === "function") return "await it";
  if (value.isPlane || (isObject(value.normal) && typeof value.constant === "number"))
    return "pass [plane.normal.x, plane.normal.y, plane.normal.z, plane.constant]";
  if (typeof value.elements?.length === "number") return "pass its elements";
  if (value.isSkeleton) return "pass its boneMatrices";
  if (value.isBufferAttribute) return "pass its array";
  if (typeof value.toArray === "function") return "pass its toArray()";
  if (typeof value.x === "number" && typeof value.y === "number") return "pass its members as an array";
  if (["ArrayBuffer", "SharedArrayBuffer", "DataView"].includes(tagOf(value))) return "pass a Float32Array or an array";
  return "";
}

// Describes a passed value for messages, such as "3 numbers", "a Vector3; pass its toArray()" or "\"text\"".
export function described(value) {
  if (typeof value === "string") return JSON.stringify(value.length > 40 ? `${value.slice(0, 40)}…` : value);
  if (typeof value === "function") return "a function";
  if (!isObject(value)) return String(value);
  if (Number.isSafeInteger(value.length)) return `${value.length} ${value.length === 1 ? "number" : "numbers"}`;
  const name = value.constructor?.name || tagOf(value);
  const cure = cureOf(value);
  return `${/^[AEIOU]/.test(name) ? "an" : "a"} ${name}${cure && `; ${cure}`}`;
}

const isList = (value) => isObject(value) && Number.isSafeInteger(value.length) && value.length >= 0 && value.length < mostNumbers &&
  !["BigInt64Array", "BigUint64Array", "String"].includes(tagOf(value));

// Checks a list of numbers, which is an array or a typed array.
//   count      the required length
//   groupsOf   the length must be a multiple of this
//   least      the minimum length
//   whole      each number must be a 32-bit integer
//   anyValue   NaN and infinity are allowed
//   optional   undefined and null are allowed, and mean that there is no list
//   why        text at the end of the message
export function checkNumbers(call, argument, value, { count, groupsOf, least, whole, anyValue, optional, why = "" } = {}) {
  if (optional && (value === undefined || value === null)) return;
  const noun = whole ? "whole numbers" : "numbers";
  const wanted = `${argument} needs ${count !== undefined ? `${count} ${count === 1 ? noun.slice(0, -1) : noun}`
    : groupsOf ? `a multiple of ${groupsOf} ${noun}` : least ? `at least ${least} ${noun}` : `an array of ${noun}`}${why && ` ${why}`}`;
  if (!isList(value) || (count !== undefined && value.length !== count) || (groupsOf && value.length % groupsOf !== 0) ||
      (least && value.length < least))
    refuse(call, `${wanted} (got ${described(value)})`);
  for (let i = 0; i < value.length; ++i) {
    const each = value[i];
    if (typeof each !== "number") refuse(call, `${wanted} (got ${described(each)} in place ${i})`);
    if (whole ? !Number.isInteger(each) || each < -(2 ** 31) || each >= 2 ** 32 : !anyValue && !Number.isFinite(each))
      refuse(call, `${wanted} (got ${each} in place ${i})`);
  }
}

// Checks one number. `least` is the smallest allowed value.
export function checkNumber(call, argument, value, { whole, least = -Infinity, optional } = {}) {
  if (optional && value === undefined) return;
  const most = whole ? 2 ** 32 - 1 : Infinity;
  if (typeof value === "number" && !Number.isNaN(value) && value >= least && value <= most && (!whole || Number.isInteger(value))) return;
  const from = least === -Infinity ? "" : ` from ${least} on`;
  refuse(call, `${argument} needs a ${whole ? "whole " : ""}number${from} (got ${described(value)})`);
}
// Checks an index, or the id of an instance or an occluder.
export const checkIndex = (call, argument, value) => checkNumber(call, argument, value, { whole: true, least: 0 });

// Checks an object of options or of members.
export function checkObject(call, argument, value, wanted = "an object") {
  if (!isObject(value) || isList(value)) refuse(call, `${argument} needs ${wanted} (got ${described(value)})`);
}

// Checks an array whose elements are not numbers. each(value, argument) checks one element.
export function checkList(call, argument, value, wanted, each) {
  if (!Array.isArray(value)) refuse(call, `${argument} needs an array of ${wanted} (got ${described(value)})`);
  for (let i = 0; i < value.length; ++i) each(value[i], `${argument}[${i}]`);
}

// Checks the array into which a call writes `count` numbers.
export function checkOut(call, out, count) {
  if (out === undefined || out === null) return;
  if (!["Float32Array", "Float64Array"].includes(tagOf(out)) || out.length < count)
    refuse(call, `out needs a Float32Array of ${count} numbers (got ${described(out)})`);
}

// Checks the contents of a file.
export function checkBytes(call, argument, value) {
  if (!ArrayBuffer.isView(value) && !["ArrayBuffer", "SharedArrayBuffer"].includes(tagOf(value)))
    refuse(call, `${argument} needs an ArrayBuffer or a typed array with the bytes of the file (got ${
      typeof value?.arrayBuffer === "function" ? `a ${tagOf(value)}; pass await its arrayBuffer()` : described(value)})`);
}

// Checks a WebGL object, such as a WebGLTexture; undefined and null mean none. Engines may have their own classes with the same
// names.
export function checkWebGL(call, argument, value, kinds) {
  if (value === undefined || value === null) return;
  const isOne = kinds.some((kind) => tagOf(value) === kind || (globalThis[kind] && value instanceof globalThis[kind]));
  // Outside of browsers, replacements of WebGL do not have these classes.
  const isStandIn = !kinds.some((kind) => globalThis[kind]) && isObject(value) && !isList(value) &&
    !value.isTexture && !value.isRenderTarget && !value.isBufferAttribute;
  if (isOne || isStandIn) return;
  const cure = value.isTexture || value.isRenderTarget
    ? "; with three.js, pass renderer.properties.get(texture).__webglTexture once the renderer has made it" : "";
  refuse(call, `${argument} needs a ${kinds.join(" or a ")} (got ${described(value)}${cure})`);
}
