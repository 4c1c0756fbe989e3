// The state of the page in its address, so that a link keeps what you see.

const switches = new Map([["true", true], ["1", true], ["on", true], ["false", false], ["0", false], ["off", false]]);

// The number nearest to `value` that the limits allow.
function clamp(value, { min, max, step, wraps }) {
  const near = wraps ? ((value % max) + max) % max : step ? min + Math.round((value - min) / step) * step : value;
  return Number(Math.min(max, Math.max(min, near)).toFixed(6));
}
function numberOf(text) {
  const value = text.trim() === "" ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}

// Takes the members of `state` that the address has. limits: { min, max, step } of numbers and { choices } of words. Numbers outside
// of their limits are clamped, and what is not understood is left out.
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

// The address's query for a state: members that differ from `initial`, after what the query has beside them.
export function writeAddress(search, state, initial) {
  const query = new URLSearchParams(search);
  for (const [name, value] of Object.entries(state)) {
    query.delete(name);
    if (value !== initial[name]) query.set(name, typeof value === "number" ? Number(value.toFixed(3)) : value);
  }
  const text = query.toString();
  return text && `?${text}`;
}

// A time in seconds at which the picture stands, or null.
export function readTime(search) {
  const text = new URLSearchParams(search).get("time");
  return text === null ? null : numberOf(text);
}
