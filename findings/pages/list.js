// The list of findings: reads the table that is embedded in the page, draws the map and the rows asked for. What is
// asked for is kept in the address, behind '#', so that it can be sent to somebody. Text is only ever set as text.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const chunk = 200;

// A column of numbers to base 36, each of the same width (list_page.cpp).
function column({ width, digits }) {
  const numbers = new Float64Array(data.rows);
  if (width > 0) for (let i = 0; i < data.rows; ++i) numbers[i] = parseInt(digits.substr(i * width, width), 36);
  return numbers;
}

const columns = Object.fromEntries(Object.entries(data.columns).map(([name, packed]) => [name, column(packed)]));
columns.rank = Float64Array.from({ length: data.rows }, (_, i) => i);
for (const [k, name] of ["kind", "element", "conditioning"].entries())
  columns[name] = Float64Array.from(columns.signature, (s) => data.classes[s][k]);

// A severity, from three digits and an exponent (three_digits in list_page.cpp).
function severity(code) {
  return code === 0 ? 0 : ((code - 1) % 900 + 100) * 10 ** (Math.floor((code - 1) / 900) - 402);
}

function shortNumber(x) {
  if (x >= 1e6 || (x !== 0 && x < 1e-3)) return x.toExponential(2).replace("+", "");
  return String(Number(x.toPrecision(3)));
}

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (value !== null) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

// What is asked for. `sort` is a column; rank is the order in which the rows come.
const defaults = { text: "", tracer: "", kind: "", conditioning: "", status: "", fresh: "", sort: "rank", down: "" };
let asked = { ...defaults };
let found = [];

const shownColumns = [
  { name: "id", title: "No.", number: true },
  { name: "tracer", title: "Tracer", words: data.tracers },
  { name: "kind", title: "Kind", words: data.kinds },
  { name: "element", title: "Where", words: data.elements },
  { name: "conditioning", title: "Condition", words: data.conditionings },
  { name: "rank", title: "Worst, ulps", number: true, help: "the nominal first, the worst first" },
  { name: "bits", title: "Simplest, bits", number: true, help: "significant bits of all its numbers" },
  { name: "count", title: "Seen", number: true, help: "how often" },
  { name: "status", title: "Status", words: data.statuses },
  { name: "first", title: "First seen", words: data.days },
  { name: "last", title: "Last seen", words: data.days },
  { name: "signature", title: "Signature", words: data.signatures },
];

function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1));
  asked = { ...defaults };
  for (const key of Object.keys(defaults)) if (given.has(key)) asked[key] = given.get(key);
  if (!shownColumns.some((c) => c.name === asked.sort)) asked.sort = defaults.sort;
}

function writeAddress() {
  const said = new URLSearchParams();
  for (const [key, value] of Object.entries(asked)) if (value !== defaults[key]) said.set(key, value);
  const text = said.toString();
  history.replaceState(null, "", text ? "#" + text : location.pathname + location.search);
}

function alphabetical(words) {
  const order = words.map((_, i) => i).sort((x, y) => (words[x] < words[y] ? -1 : words[x] > words[y] ? 1 : 0));
  const places = new Float64Array(words.length);
  order.forEach((word, place) => { places[word] = place; });
  return places;
}

function search() {
  const tests = [];
  for (const [key, words] of [["tracer", data.tracers], ["kind", data.kinds], ["conditioning", data.conditionings],
                              ["status", data.statuses]]) {
    if (asked[key] === "") continue;
    const wanted = words.indexOf(asked[key]), values = columns[key];
    tests.push((i) => values[i] === wanted);
  }
  if (asked.fresh) tests.push((i) => columns.fresh[i] === 1);
  const text = asked.text.trim().toLowerCase();
  if (text) {
    const has = (words) => words.map((w) => w.toLowerCase().includes(text));
    const tracers = has(data.tracers), signatures = has(data.signatures);
    tests.push(
      (i) => tracers[columns.tracer[i]] || signatures[columns.signature[i]] || String(columns.id[i]) === text);
  }
  found = [];
  for (let i = 0; i < data.rows; ++i) if (tests.every((t) => t(i))) found.push(i);
  const by = shownColumns.find((c) => c.name === asked.sort);
  const values = columns[by.name], places = by.words ? alphabetical(by.words) : null;
  const key = places ? (i) => places[values[i]] : (i) => values[i];
  const direction = asked.down ? -1 : 1;
  if (by.name !== "rank" || asked.down) found.sort((x, y) => direction * (key(x) - key(y)) || x - y);
}

function row(i) {
  const made = element("tr");
  for (const { name, number, words } of shownColumns) {
    const value = columns[name][i];
    const cell = element("td", number ? { class: "n" } : {});
    if (name === "id") {
      cell.append(i < data.pages ? element("a", { href: `finding-${value}.html` }, String(value)) : String(value));
    } else if (name === "rank") {
      const nominal = data.conditionings[columns.conditioning[i]] === "nominal";
      const ulps = shortNumber(severity(columns.worst[i]));
      cell.append(element("span", { class: nominal ? "nominal" : "ill" }, ulps));
    } else {
      cell.append(words ? words[value] : String(value));
    }
    if (name === "signature") cell.className = "code";
    if (name === "tracer" && columns.fresh[i]) cell.append(" ", element("span", { class: "new" }, "new"));
    made.append(cell);
  }
  return made;
}

function showMore(focus) {
  const body = document.querySelector("#list tbody"), from = body.children.length;
  const rows = document.createDocumentFragment();
  for (const i of found.slice(from, from + chunk)) rows.append(row(i));
  body.append(rows);
  const shown = body.children.length;
  document.getElementById("more").hidden = shown >= found.length;
  document.getElementById("shown").textContent =
    found.length === 0 ? (data.rows === 0 ? "Nothing was found." : "None of the findings is like that.")
      : `${found.length < data.rows ? `${found.length} of ` : ""}${data.rows} findings${
        shown < found.length ? `; the first ${shown} are shown` : ""}`;
  if (focus) (body.children[from]?.querySelector("a") ?? body.parentElement.parentElement).focus();
}

function showHeader() {
  const cells = shownColumns.map(({ name, title, number, help }) => {
    const sorted = asked.sort === name;
    const down = (asked.down !== "") !== (name === "rank");  // the first rank is the greatest severity
    const button = element("button", { type: "button", title: help ?? null, id: `sort-${name}` }, title);
    button.addEventListener("click", () => {
      asked.down = sorted && !asked.down ? "1" : "";
      asked.sort = name;
      show();
      document.getElementById(`sort-${name}`).focus();
    });
    return element("th", {
      scope: "col", class: number ? "n" : null, "aria-sort": sorted ? (down ? "descending" : "ascending") : null,
    }, button);
  });
  document.querySelector("#list thead tr").replaceChildren(...cells);
}

const limits = [1, 16, 1024, 2 ** 20];  // ulps, between the shades of the map
function shade(ulps) { return limits.filter((l) => ulps >= l).length; }

// Of each tracer and condition, by one number for both: how many there are, and the worst.
const counts = new Map(), worst = new Map();
for (let i = 0; i < data.rows; ++i) {
  const key = columns.tracer[i] * data.conditionings.length + columns.conditioning[i];
  counts.set(key, (counts.get(key) ?? 0) + 1);
  worst.set(key, Math.max(worst.get(key) ?? 0, severity(columns.worst[i])));
}

function showMap() {
  if (data.rows === 0) return;
  const head = element("tr", {}, element("th", { scope: "col" }, "Tracer"),
                       ...data.conditionings.map((c) => element("th", { scope: "col" }, c)));
  const places = alphabetical(data.tracers);
  const rows = data.tracers.map((_, t) => t).sort((x, y) => places[x] - places[y]).map((t) => {
    const cells = data.conditionings.map((condition, c) => {
      const key = t * data.conditionings.length + c;
      if (!counts.has(key)) return element("td", { class: "none" }, "0");
      const pressed = asked.tracer === data.tracers[t] && asked.conditioning === condition;
      const words = `${counts.get(key)}, the worst ${shortNumber(worst.get(key))} ulps`;
      const button = element("button", {
        type: "button", class: `shade${shade(worst.get(key))}`, title: words, "aria-pressed": String(pressed),
        "aria-label": `${data.tracers[t]}, ${condition}: ${words}`, "data-cell": String(key),
      }, String(counts.get(key)));
      button.addEventListener("click", () => {
        asked.tracer = pressed ? "" : data.tracers[t];
        asked.conditioning = pressed ? "" : condition;
        show();
        document.querySelector(`[data-cell="${key}"]`).focus();
      });
      return element("td", {}, button);
    });
    return element("tr", {}, element("th", { scope: "row" }, data.tracers[t]), ...cells);
  });
  document.getElementById("map").replaceChildren(element("thead", {}, head), element("tbody", {}, ...rows));
  const names = ["below 1 ulp", "1 to 16", "16 to 1024", "1024 to 2^20", "2^20 and more"];
  document.getElementById("legend").replaceChildren(
    "The worst: ", ...names.map((n, k) => element("span", { class: `shade${k}` }, n)));
  document.getElementById("map-section").hidden = false;
}

function showFilters() {
  for (const key of ["text", "tracer", "kind", "conditioning", "status"])
    document.getElementById(key).value = asked[key];
  document.getElementById("fresh").checked = asked.fresh !== "";
}

function show() {
  writeAddress();
  showFilters();
  showMap();
  showHeader();
  search();
  document.querySelector("#list tbody").replaceChildren();
  showMore(false);
}

function fill(id, words) {
  const places = alphabetical(words);
  const sorted = [...words].sort((x, y) => places[words.indexOf(x)] - places[words.indexOf(y)]);
  document.getElementById(id).replaceChildren(
    element("option", { value: "" }, "all"), ...sorted.map((w) => element("option", { value: w }, w)));
}

fill("tracer", data.tracers);
fill("kind", data.kinds);
fill("conditioning", data.conditionings);
fill("status", data.statuses);
for (const key of ["text", "tracer", "kind", "conditioning", "status"])
  document.getElementById(key).addEventListener(key === "text" ? "input" : "change", (event) => {
    asked[key] = event.target.value;
    show();
  });
document.getElementById("fresh").addEventListener("change", (event) => {
  asked.fresh = event.target.checked ? "1" : "";
  show();
});
document.getElementById("filters").addEventListener("submit", (event) => event.preventDefault());
document.getElementById("filters").addEventListener("reset", (event) => {
  event.preventDefault();
  asked = { ...defaults };
  show();
});
document.getElementById("more").addEventListener("click", () => showMore(true));
addEventListener("hashchange", () => {
  if (["#findings"].includes(location.hash)) return;  // the skip link
  readAddress();
  show();
});
readAddress();
show();
