// The WebAssembly module and its memory. Makes calls, checks their results, and allocates memory for their arguments.
import { checkBytes, checkOut, described, refuse } from "./arguments.js";
import { NookError } from "./error.js";
import { Layouts } from "./layouts.js";

const alignment = 16, firstCapacity = 1 << 16, maxBytes = 2 ** 32 - 1 - alignment;

// Memory for the arguments of calls. It is reused by each call. Its addresses are valid until the end of the outermost `call`.
class Room {
  constructor(module) {
    this.module = module;
    this.reserve(firstCapacity);
    this.used = 0;
    this.missing = 0;
    this.extra = [];
    this.depth = 0;
    this.call = "nook-web";  // the outermost call, for messages
  }

  // If this allocation fails, there is no block, and each argument is allocated separately.
  reserve(capacity) {
    this.block = this.module._malloc(capacity);
    this.capacity = this.block ? capacity : 0;
    return this.block !== 0;
  }

  take(bytes) {
    if (!Number.isSafeInteger(bytes) || bytes < 0)
      throw new NookError(`${this.call}: an argument has no size (got ${bytes} bytes); give an array`,
        "NOOK_ERROR_INVALID_ARGUMENT");
    const size = Math.max(alignment, Math.ceil(bytes / alignment) * alignment);
    if (this.used + size <= this.capacity) {
      this.used += size;
      return this.block + this.used - size;
    }
    // The module has 32-bit addresses. _malloc would truncate a larger size.
    const address = size <= maxBytes ? this.module._malloc(size) : 0;
    if (!address)
      throw new NookError(`${this.call}: no memory for ${bytes} bytes of arguments or results (the module has ` +
        `${this.module.HEAPU8.length}); destroy what you no longer use, or pass less at once`, "NOOK_ERROR_OUT_OF_MEMORY");
    this.missing += size;
    this.extra.push(address);
    return address;
  }

  end() {
    this.used = 0;
    if (this.missing === 0) return;
    for (const address of this.extra) this.module._free(address);
    this.extra.length = 0;
    const before = this.capacity, wanted = before + this.missing;
    this.missing = 0;
    if (this.block) this.module._free(this.block);
    if (!this.reserve(wanted)) this.reserve(Math.max(before, firstCapacity));
  }
}

export class Library {
  constructor(module) {
    this.module = module;
    this.layouts = new Layouts(module);
    this.version = module._nook_version();
    this.room = new Room(module);
    this.lastMessage = "";
  }

  // Runs body, and then frees the memory of its arguments. `name` is the function that body calls.
  call(name, body) {
    if (this.room.depth++ === 0) this.room.call = name;
    try {
      return body();
    } finally {
      if (--this.room.depth === 0) {
        this.room.end();
        this.room.call = "nook-web";
      }
    }
  }

  // Throws the library's message if a result is an error.
  check(result) {
    if (result >= 0) return result;
    const { module } = this;
    throw new NookError(module.UTF8ToString(module._nook_last_message()), module.UTF8ToString(module._nook_result_name(result)));
  }

  // Returns the name of the outermost call, for messages.
  get name() {
    return this.room.call;
  }

  // Checks `values`, and returns a function that makes a descriptor with the library's defaults, overwritten by `values`.
  // Prepare all arguments of a call before you make the first one.
  prepared(name, values = {}) {
    const struct = this.layouts.struct(name);
    const checked = this.layouts.check(struct, values, this.name);
    return () => {
      const address = this.room.take(struct.size);
      const type = this.layouts.bits("NOOK_DESC_CONTEXT", [name.slice("nook_".length, -"_desc".length).replaceAll("_", "-")]);
      this.check(this.module._nook_desc_init(type, address, struct.size, this.version));
      this.layouts.store(address, checked);
      return address;
    };
  }
  descriptor(name, values) {
    return this.prepared(name, values)();
  }

  // Makes a struct of zeros, sets struct_size if it has this field, and then writes `values`.
  struct(name, values = {}) {
    const struct = this.layouts.struct(name);
    const checked = this.layouts.check(struct, values, this.name);
    const address = this.room.take(struct.size);
    this.module.HEAPU8.fill(0, address, address + struct.size);
    if (struct.fields.has("structSize")) this.layouts.write(struct, address, { structSize: struct.size });
    this.layouts.store(address, checked);
    return address;
  }

  read(name, address) {
    return this.layouts.read(this.layouts.struct(name), address);
  }

  // Returns the handle of an object that is passed to a call. Kind is its class. `word` is the name of the class, because
  // bundlers may rename the class.
  handleOf(value, argument, Kind, word) {
    const call = this.name;
    if (!(value instanceof Kind)) refuse(call, `${argument} needs a ${word} (got ${described(value)})`);
    if (value.library !== this) refuse(call, `${argument} was made by another load(); objects of two modules cannot be combined`);
    return value.handle;
  }

  // Calls a function of the form (handle, ..., info*), and returns what it has written. `struct` is the name of the info.
  info(name, struct, call, values) {
    return this.call(name, () => {
      const address = this.struct(struct, values);
      this.check(call(address));
      return this.read(struct, address);
    });
  }

  // Calls a function of the form (..., handle* out), and returns the handle.
  made(call) {
    const out = this.room.take(4);
    this.module.HEAPU32[out >> 2] = 0;
    this.check(call(out));
    return this.module.HEAPU32[out >> 2];
  }

  // Calls a function of the form (handle*).
  destroy(name, handle) {
    this.call(name, () => {
      const address = this.room.take(4);
      this.module.HEAPU32[address >> 2] = handle;
      this.module[`_${name}`](address);
    });
  }

  room32(count) {
    return this.room.take(4 * count);
  }

  // Copies numbers, which the caller has checked, to memory. Returns 0 for null and undefined.
  floats(values) {
    if (!values) return 0;
    const address = this.room32(values.length);
    this.module.HEAPF32.set(values, address >> 2);
    return address;
  }
  integers(values) {
    if (!values) return 0;
    const address = this.room32(values.length);
    this.module.HEAP32.set(values, address >> 2);
    return address;
  }
  bytes(values) {
    checkBytes(this.name, "bytes", values);
    const view = !ArrayBuffer.isView(values) ? new Uint8Array(values)
      : new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
    const address = this.room.take(view.length);
    this.module.HEAPU8.set(view, address);
    return { address, size: view.length };
  }
  texts(values) {
    const encoder = new TextEncoder();
    return this.integers(values.map((text) => (text === null ? 0 : this.bytes(encoder.encode(`${text}\0`)).address)));
  }

  // Calls a function of the form (..., float* out, count). Writes the numbers to `out`, or to a new array if there is no `out`.
  readFloats(name, count, out, call) {
    return this.call(name, () => {
      checkOut(this.name, out, count);
      const address = this.room32(count);
      this.check(call(address));
      const numbers = this.module.HEAPF32.subarray(address >> 2, (address >> 2) + count);
      if (!out) return numbers.slice();
      out.set(numbers);
      return out;
    });
  }
}

// An object of the library. `handle` is 0 after destroy().
export class Owned {
  #destroy;
  constructor(library, handle, destroy) {
    this.library = library;
    this.address = handle;
    this.#destroy = destroy;
  }
  // Throws if the object has been destroyed.
  get handle() {
    if (!this.address) throw new NookError(`nook: the ${this.constructor.name} is destroyed`, "NOOK_ERROR_INVALID_ARGUMENT");
    return this.address;
  }
  // Releases the object; a second call does nothing.
  destroy() {
    if (!this.address) return;
    const handle = this.address;
    this.address = 0;
    this.library.destroy(this.#destroy, handle);
  }
}
