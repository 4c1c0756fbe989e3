// The controls beside the picture: one row for each entry, bound to a member of `state`.
function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

const rows = {
  range({ min, max, step, unit = "" }, value, change) {
    const digits = step < 1 ? 2 : 0;
    const shown = element("output", { value: `${value.toFixed(digits)}${unit}` });
    const input = element("input", { type: "range", min, max, step, value });
    input.addEventListener("input", () => {
      shown.value = `${input.valueAsNumber.toFixed(digits)}${unit}`;
      change(input.valueAsNumber);
    });
    return [input, shown];
  },
  check(_, value, change) {
    const input = element("input", { type: "checkbox", checked: value });
    input.addEventListener("change", () => change(input.checked));
    return [input];
  },
  choice({ choices }, value, change) {
    const input = element("select", {}, ...choices.map(([name, text]) => element("option", { value: name, textContent: text, selected: name === value })));
    input.addEventListener("change", () => change(input.value));
    return [input];
  },
};

// entries: [kind, member of state, text, options] each, or a heading as text.
export function makePanel(parent, state, entries, changed) {
  parent.replaceChildren();
  for (const entry of entries) {
    if (typeof entry === "string") {
      parent.append(element("h2", { textContent: entry }));
      continue;
    }
    const [kind, member, text, options = {}] = entry;
    const controls = rows[kind](options, state[member], (value) => {
      state[member] = value;
      changed(member);
    });
    parent.append(element("label", { className: kind, htmlFor: `control_${member}` }, element("span", { textContent: text }), ...controls));
    controls[0].id = `control_${member}`;
  }
}
