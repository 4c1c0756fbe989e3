// The layouts of the library's structs, and its constants, read from tables in the module. Converts objects with camelCase names to
// structs in memory, and structs to objects. Constants are words: NOOK_POSE_SKINNING is "skinning".
import { checkNumber, checkNumbers, described, refuse } from "./arguments.js";

const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
const word = (name) => name.toLowerCase().replaceAll("_", "-");

// Returns the longest common prefix of all names that ends with an underscore.
function sharedPrefix(names) {
  let prefix = names[0];
  for (const name of names) while (!name.startsWith(prefix)) prefix = prefix.slice(0, -1);
  return prefix.slice(0, prefix.lastIndexOf("_") + 1);
}

function readConstants(module) {
  const groups = new Map();
  const words = module.HEAPU32;
  for (let row = module._nook_web_constants() >> 2; words[row]; row += 3) {
    const group = module.UTF8ToString(words[row + 1]);
    if (!groups.has(group)) groups.set(group, []);
    groups.get(group).push([module.UTF8ToString(words[row]), words[row + 2] | 0]);
  }
  const all = new Map();
  for (const [group, rows] of groups) {
    const prefix = sharedPrefix(rows.map(([name]) => name));
    const numbers = new Map(rows.map(([name, value]) => [word(name.slice(prefix.length)), value]));
    const wordOf = new Map([...numbers].map(([name, value]) => [value, name]));
    all.set(group, { numbers, wordOf });
  }
  return all;
}

export class Layouts {
  constructor(module) {
    this.module = module;
    this.constants = readConstants(module);
    this.structs = new Map();
    const words = module.HEAPU32;
    for (let row = module._nook_web_fields() >> 2; words[row]; row += 6) {
      const struct = module.UTF8ToString(words[row]), path = module.UTF8ToString(words[row + 1]);
      if (path === "") {
        this.structs.set(struct, { name: struct, size: words[row + 2], fields: new Map() });
        continue;
      }
      this.structs.get(struct).fields.set(path.split(".").map(camel).join("."), {
        offset: words[row + 2],
        type: String.fromCharCode(words[row + 3] & 255),
        count: words[row + 4],
        constants: words[row + 5] ? this.constants.get(module.UTF8ToString(words[row + 5])) : null,
      });
    }
  }

  struct(name) {
    return this.structs.get(name);
  }

  // Returns the sum of constants of a group of bits, such as NOOK_TERM_SELF.
  bits(first, names, call) {
    const { numbers } = this.constants.get(`bits ${first}`);
    return names.reduce((sum, name) => sum | this.number(numbers, name, "a bit", call), 0);
  }

  number(numbers, name, of, call = "nook-web") {
    const value = numbers.get(name);
    if (value === undefined) refuse(call, `${of} is unknown (got ${described(name)}, need ${[...numbers.keys()].join(", ")})`);
    return value;
  }

  // Checks the members of `values` that are not undefined, for the function `call`. Returns pairs of a field and the value to
  // write. For an address, the value is a number, or a function that returns the address when the struct is written.
  check(struct, values, call = "nook-web") {
    const checked = [];
    for (const [name, given] of Object.entries(values)) {
      if (given === undefined) continue;
      const field = struct.fields.get(name);
      if (!field) refuse(call, `${struct.name} has no ${name}; it has ${[...struct.fields.keys()].join(", ")}`);
      const value = typeof given === "string" && field.constants ? this.number(field.constants.numbers, given, name, call) : given;
      checked.push([field, value]);
      if (typeof value === "function" && field.type === "p") continue;
      const argument = `${struct.name}: ${name}`, whole = !["f", "d"].includes(field.type);
      if (field.count > 1) checkNumbers(call, argument, value, { count: field.count, whole });
      else if (typeof value !== "boolean" || !whole)
        checkNumber(call, argument, value, field.type === "p" || field.type === "w" ? {} : { whole, least: whole && field.type === "u" ? 0 : whole ? -(2 ** 31) : -Infinity });
    }
    return checked;
  }

  // Writes the result of `check` to memory.
  store(address, checked) {
    const { module } = this;
    for (const [field, given] of checked) {
      const value = typeof given === "function" ? given() : given;
      const at = (address + field.offset) >> 2;
      if (field.type === "f") {
        if (field.count > 1) module.HEAPF32.set(value, at);
        else module.HEAPF32[at] = value;
      } else if (field.count > 1) {
        module.HEAPU32.set(value, at);
      } else {
        module.HEAPU32[at] = Number(value);
        if (field.type === "w") module.HEAPU32[at + 1] = Number(value) / 2 ** 32;
      }
    }
  }
  write(struct, address, values, call) {
    this.store(address, this.check(struct, values, call));
  }

  read(struct, address) {
    const result = {};
    for (const [path, field] of struct.fields) {
      if (path === "structSize" || path === "reserved") continue;
      const names = path.split(".");
      const last = names.pop();
      let object = result;
      for (const name of names) {
        const [, array, index] = /^(\w+)\[(\d+)\]$/.exec(name) ?? [];
        object = array ? (object[array] ??= [])[index] ??= {} : object[name] ??= {};
      }
      object[last] = this.value(field, address + field.offset);
    }
    return result;
  }

  value({ type, count, constants }, address) {
    const { module } = this;
    const at = address >> 2;
    switch (type) {
      case "s": return module.UTF8ToString(address, count);
      case "t": return module.UTF8ToString(module.HEAPU32[at]);
      case "f": return count > 1 ? module.HEAPF32.slice(at, at + count) : module.HEAPF32[at];
      case "d": return count > 1 ? module.HEAPF64.slice(address >> 3, (address >> 3) + count) : module.HEAPF64[address >> 3];
      case "w": return module.HEAPU32[at] + module.HEAPU32[at + 1] * 2 ** 32;
      case "i": return constants?.wordOf.get(module.HEAP32[at]) ?? (count > 1 ? module.HEAP32.slice(at, at + count) : module.HEAP32[at]);
      default: return count > 1 ? module.HEAPU32.slice(at, at + count) : module.HEAPU32[at];
    }
  }
}
