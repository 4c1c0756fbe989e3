// Stores the state of the page in its address, so that a link keeps what you see.

const switches = new Map([["true", true], ["1", true], ["on", true], ["false", false], ["0", false], ["off", false]]);

// Returns the number nearest to `value` that the limits allow.
function clamp(value, { min, max, step, wraps }) {
  const near = wraps ? ((value % max) + max) % max : step ? min + Math.round((value - min) / step) * step : value;
  return Number(Math.min(max, Math.max(min, near)).toFixed(6));
}
function numberOf(text) {
  const value = text.trim() === "" ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}

// Reads members of `state` from the address. `limits` has { min, max, step } for numbers and { choices } for words. Numbers
// outside of their limits are clamped. Values that are not understood are ignored.
export function readAddress(search, state, limits) {
  for (const [name, text] of new URLSearchParams(search)) {
    if (!Object.hasOwn(state, name)) continue;
    const limit = limits[name] ?? {};
    let value = null;
    if (typeof state[name] === "number") {
      value = numberOf(text);
      if (value !== null) value = clamp(value, limit);
    } else if (typeof state[name] === "boolean") {
      value = switches.get(text.trim().toLowerCase()) ?? null;
    } else if (limit.choices?.some(([word]) => word === text)) {
      value = text;
    }
    if (value !== null) state[name] = value;
  }
}

// Returns the address's query for a state: the members that differ from `initial`, in addition to other parameters of the
// query.
export function writeAddress(search, state, initial) {
  const query = new URLSearchParams(search);
  for (const [name, value] of Object.entries(state)) {
    query.delete(name);
    if (value !== initial[name]) query.set(name, typeof value === "number" ? Number(value.toFixed(3)) : value);
  }
  const text = query.toString();
  return text && `?${text}`;
}

// Returns the time in seconds at which the picture stands still, or null.
export function readTime(search) {
  const text = new URLSearchParams(search).get("time");
  return text === null ? null : numberOf(text);
}
