// Shows the list of all assets. Rows become HTML in pieces, so that a list of thousands loads quickly.
(() => {
"use strict";
const [NAME, KIND, STATE, OVER, FIGURE, NOTES, BYTES, SECONDS, KEY, CHANGE, BEFORE, FLAGS, SOURCE, LOG] = Array(14).keys();
const HAS_PAGE = 1, LINKABLE = 2, CAN_HAVE_PAGE = 4;
const PIECE = 60;
const data = JSON.parse(document.getElementById("results").textContent);
const rows = data.rows;
const find = (id) => document.getElementById(id);
const body = find("list").tBodies[0];
let matching = [], shown = 0;
const states = new Set();

const element = (tag, className, text) => {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text) made.textContent = text;
  return made;
};

const digits = (value) => Number(value.toPrecision(3)).toString();

function size(bytes) {
  if (!bytes) return "";
  if (bytes < 1e3) return `${bytes} bytes`;
  return bytes < 1e6 ? `${digits(bytes / 1e3)} kB` : `${digits(bytes / 1e6)} MB`;
}

function duration(seconds) {
  if (seconds === null) return "";
  if (seconds < 120) return `${digits(seconds)} s`;
  return seconds < 7200 ? `${digits(seconds / 60)} min` : `${digits(seconds / 3600)} h`;
}

// Quotes a word for a shell's command line, if necessary.
const word = (text) => (/^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

const link = (path) => data.links + path.split("/").map(encodeURIComponent).join("/");

function command(row) {
  const place = (name) => `${data.folder.replace(/\/+$/, "") || "/"}/${name}`;
  const source = row[SOURCE] === "?" ? " SOURCE.glb" : row[SOURCE] && ` ${word(place(row[SOURCE]))}`;
  return `nook report ${word(place(`${row[NAME]}.nook`))}${source} -o ${word(place(`${row[NAME]}.html`))}`;
}

function anchor(href, text) {
  const made = element("a", "", text);
  made.href = href;
  return made;
}

function more(row) {
  const cell = element("td", "more");
  if (data.links && row[FLAGS] & LINKABLE && row[FLAGS] & HAS_PAGE) cell.append(anchor(link(`${row[NAME]}.html`), "page"));
  if (data.links && row[LOG]) cell.append(" ", anchor(link(row[LOG]), "log"));
  if (!(row[FLAGS] & HAS_PAGE) && row[FLAGS] & CAN_HAVE_PAGE && row[FLAGS] & LINKABLE) {
    const details = element("details");
    details.append(element("summary", "", "make a page"), element("code", "", command(row)));
    cell.append(" ", details);
  }
  return cell;
}

function labelled(className, label, text) {
  const cell = element("td", className, text);
  cell.dataset.label = label;
  return cell;
}

function line(row) {
  const state = data.states[row[STATE]], tr = element("tr");
  const asset = element("td", "asset");
  const slash = row[NAME].lastIndexOf("/") + 1;
  asset.append(element("span", "folder", row[NAME].slice(0, slash)), element("span", "name", row[NAME].slice(slash)), element("small", "", row[KIND]));
  for (const column of [FIGURE, NOTES])
    if (row[column]) asset.append(element("small", "", row[column]));
  const stateCell = element("td");
  stateCell.append(element("span", `state ${state === "not measured" ? "unmeasured" : state}`, state));
  const change = labelled("change", "", row[CHANGE] ? data.changes[row[CHANGE]] : "");
  if (row[BEFORE]) change.append(element("small", "", row[BEFORE]));
  if (row[KEY]) tr.title = `key ${row[KEY]}`;
  tr.append(asset, stateCell, labelled("limit", "of its limit", row[OVER] === null ? "" : digits(row[OVER])), change,
    labelled("size", "size", size(row[BYTES])), labelled("bake", "bake", duration(row[SECONDS])), more(row));
  return tr;
}

function showMore() {
  const piece = document.createDocumentFragment();
  for (const row of matching.slice(shown, shown + PIECE)) piece.append(line(row));
  body.append(piece);
  shown = Math.min(shown + PIECE, matching.length);
  find("more").hidden = shown === matching.length;
  find("shown").textContent = matching.length === rows.length ? `${rows.length} rows` : `${matching.length} of ${rows.length} rows`;
}

// Compares names without a locale, because sorting 5,000 names with a locale takes a tenth of a second.
const byText = (a, b) => (a < b ? -1 : Number(a > b));
const changeOrder = data.changes.map((name) => ["worse", "new", "gone", "other key", "better", "same"].indexOf(name));
const orders = {
  worst: null,
  name: (a, b) => byText(a[NAME], b[NAME]),
  kind: (a, b) => byText(a[KIND], b[KIND]),
  change: (a, b) => changeOrder[a[CHANGE]] - changeOrder[b[CHANGE]],
  bytes: (a, b) => b[BYTES] - a[BYTES],
  seconds: (a, b) => (b[SECONDS] ?? -1) - (a[SECONDS] ?? -1),
};

function apply() {
  const text = find("search").value.toLowerCase(), kind = find("kind").value, change = find("change").value;
  matching = rows.filter((row) => (!states.size || states.has(row[STATE])) && (kind === "" || row[KIND] === kind.slice(1)) &&
    (change === "" || row[CHANGE] === Number(change)) && (!text || row[NAME].toLowerCase().includes(text)));
  const order = orders[find("order").value];
  if (order) matching.sort(order);
  body.replaceChildren();
  shown = 0;
  showMore();
}

function option(select, value, text) {
  const made = element("option", "", text);
  made.value = value;
  select.append(made);
}

const countBy = (column) => {
  const counts = new Map();
  for (const row of rows) counts.set(row[column], (counts.get(row[column]) ?? 0) + 1);
  return counts;
};

function addStates() {
  const counts = countBy(STATE);
  data.states.forEach((name, state) => {
    if (!counts.has(state)) return;
    const button = element("button", "", `${name} ${counts.get(state)}`);
    button.type = "button";
    button.setAttribute("aria-pressed", "false");
    button.addEventListener("click", () => {
      if (!states.delete(state)) states.add(state);
      button.setAttribute("aria-pressed", String(states.has(state)));
      apply();
    });
    find("states").append(button);
  });
}

function addFilters() {
  // The value of a kind has a prefix, so that assets without a kind differ from "all".
  option(find("kind"), "", "all");
  for (const [kind, count] of [...countBy(KIND)].sort()) option(find("kind"), `k${kind}`, `${kind || "unknown"} (${count})`);
  option(find("change"), "", "all");
  for (const [change, count] of [...countBy(CHANGE)].sort((a, b) => a[0] - b[0]))
    option(find("change"), String(change), `${data.changes[change]} (${count})`);
  for (const id of ["kind", "change", "order"]) find(id).addEventListener("change", apply);
  find("search").addEventListener("input", apply);
}

function clear() {
  states.clear();
  for (const button of find("states").children) button.setAttribute("aria-pressed", "false");
  for (const id of ["kind", "change", "search"]) find(id).value = "";
  find("order").value = "worst";
  apply();
}

addStates();
addFilters();
find("clear").addEventListener("click", clear);
find("more").addEventListener("click", showMore);
// After a reload, the browser may keep the text that the reader typed.
clear();
performance.mark("rows");
// Observes the button again after each piece. The button may still be visible in the next frame, and then the
// observer would report no change.
const observer = new IntersectionObserver((entries) => {
  if (find("more").hidden || !entries.some((entry) => entry.isIntersecting)) return;
  showMore();
  observer.unobserve(find("more"));
  observer.observe(find("more"));
}, { rootMargin: "600px" });
observer.observe(find("more"));
})();
