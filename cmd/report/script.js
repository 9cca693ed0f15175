// Lays out the data of the page: tables that sort, pictures that zoom, and for every number the call that prints it.
"use strict";
(function () {

const data = JSON.parse(document.getElementById("data").textContent);
const tip = document.getElementById("tip");

// ---- words and numbers

const numeric = /^-?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
const names = new Set(["id", "ids", "line", "rate", "frontal", "clique", "id_min", "id_max"]);  // numbers that count nothing
const times = new Set(["order_s", "plan_s", "median_s", "isam2_s", "s_per_ec"]);
const isNumber = text => numeric.test(text);

// As people read it; the exact number is in the tip and in data-value.
function pretty(text, column) {
  if (!isNumber(text) || names.has(column)) return text;
  const value = Number(text);
  if (column === "share" || column === "of_full") return (100 * value).toPrecision(3) + " %";
  if (times.has(column)) return seconds(value);
  if (Number.isInteger(value) && Math.abs(value) < 1e7) return value.toString().replace(/\B(?=(\d{3})+$)/g, "\u2009");
  const units = [[1e18, "e18"], [1e15, "P"], [1e12, "T"], [1e9, "G"], [1e6, "M"]];
  for (const [size, name] of units) if (Math.abs(value) >= size) return (value / size).toPrecision(4) + "\u2009" + name;
  return String(Number(value.toPrecision(4)));
}

function seconds(value) {
  if (value >= 1) return value.toPrecision(3) + "\u2009s";
  if (value >= 1e-3) return (1e3 * value).toPrecision(3) + "\u2009ms";
  return value > 1e-15 && value < 1e-7 ? (1e9 * value).toPrecision(3) + "\u2009ns" : (1e6 * value).toPrecision(3) + "\u2009µs";
}

function element(name, properties, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(properties || {})) {
    if (key === "class") made.className = value;
    else if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

function showTip(event, text) {
  tip.textContent = text;
  tip.hidden = false;
  const box = event.target.getBoundingClientRect();
  const x = event.pageX || box.left + scrollX, y = event.pageY || box.bottom + scrollY;
  tip.style.left = Math.max(4, Math.min(x + 12, scrollX + document.documentElement.clientWidth - tip.offsetWidth - 8)) + "px";
  tip.style.top = y + 14 + "px";
}
const hideTip = () => { tip.hidden = true; };
addEventListener("keydown", event => { if (event.key === "Escape") hideTip(); });

// ---- the calls that print a number

function command(text) {
  const copy = element("button", {type: "button", "aria-label": "Copy: " + text, onclick: () => {
    const done = () => { copy.textContent = "copied"; setTimeout(() => { copy.textContent = "copy"; }, 1500); };
    if (navigator.clipboard) navigator.clipboard.writeText(text).then(done, () => select(pre));
    else select(pre);
  }}, "copy");
  const pre = element("pre", {}, text);
  return element("div", {class: "command"}, pre, copy);
}
function select(node) { getSelection().selectAllChildren(node); }
function calls(text) {
  return element("details", {}, element("summary", {}, "the call that prints it"), ...text.split("\n").map(command));
}

// ---- tables

function table(sheet, name, choose) {
  if (sheet.rows.length === 0) return element("p", {class: "none"}, "Nothing.");
  const columns = sheet.columns.map((column, k) => {
    const cells = sheet.rows.map(row => row[k] || "").filter(text => text !== "");
    return {...column, k, number: cells.length > 0 && cells.every(isNumber), empty: cells.length === 0};
  }).filter(column => !column.empty);
  const body = element("tbody");
  const rows = sheet.rows.map((cells, index) => {
    const row = element("tr", choose ? {tabindex: "0", "data-row": index} : {"data-row": index});
    for (const column of columns) {
      const text = cells[column.k] || "";
      const long = column.name === "cause", list = column.name === "frontal";
      const cell = element("td", {"data-column": column.name, "data-value": text,
        class: column.number ? "number" : column.name === "severity" ? "severity-" + text : long ? "long" : ""});
      cell.textContent = list && text.length > 90 ? text.slice(0, 87) + "…" : pretty(text, column.name);
      if (cell.textContent !== text) cell.title = text;
      row.append(cell);
    }
    if (choose) {
      row.addEventListener("click", () => choose(index));
      row.addEventListener("keydown", event => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        choose(index);
      });
    }
    return row;
  });
  body.append(...rows);
  const heads = columns.map(column => {
    const head = element("th", {scope: "col", class: column.number ? "number" : "", title: column.what, "aria-sort": "none"});
    head.append(element("button", {type: "button", onclick: () => {
      const down = head.getAttribute("aria-sort") === "none" ? column.number : head.getAttribute("aria-sort") === "ascending";
      for (const other of heads) other.setAttribute("aria-sort", "none");
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      body.append(...sorted(rows, sheet, column, down));
    }}, column.name));
    return head;
  });
  return element("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": name},
    element("table", {}, element("thead", {}, element("tr", {}, ...heads)), body));
}

// Rows without a value come last, whatever the direction.
function sorted(rows, sheet, column, down) {
  const value = row => sheet.rows[row.dataset.row][column.k] || "";
  const sign = down ? -1 : 1;
  return rows.slice().sort((a, b) => {
    const x = value(a), y = value(b);
    if (x === "" || y === "") return (x === "") - (y === "");
    return sign * (column.number ? Number(x) - Number(y) : x < y ? -1 : x > y ? 1 : 0);
  });
}

function facts(sheet) {
  const list = element("dl", {class: "facts"});
  for (const [key, value, what] of sheet.rows) {
    if (value === "") continue;
    list.append(element("div", {title: what}, element("dt", {}, key),
      element("dd", {"data-fact": key, "data-value": value}, pretty(value, key))));
  }
  return list;
}

// ---- pictures

// Zoom by wheel with Ctrl, pinch, drag, buttons and keys: `moved` is told scale and shift.
function zoomable(svg, width, height, moved) {
  const zoom = d3.behavior.zoom().scaleExtent([1, 40]).size([width, height]).on("zoom", () => moved(zoom.scale(), zoom.translate()));
  const node = svg.node();
  // Who scrolls the page, by wheel or by a finger, is not to zoom by accident.
  node.addEventListener("wheel", event => { if (!event.ctrlKey && !event.metaKey) event.stopImmediatePropagation(); }, true);
  node.addEventListener("touchstart", event => {
    if (event.touches.length < 2 && zoom.scale() === 1) event.stopImmediatePropagation();
  }, true);
  svg.call(zoom);
  const by = factor => {
    const [x, y] = zoom.translate(), scale = Math.min(40, Math.max(1, zoom.scale() * factor)), k = scale / zoom.scale();
    zoom.scale(scale).translate(scale === 1 ? [0, 0] : [width / 2 - k * (width / 2 - x), height / 2 - k * (height / 2 - y)]).event(svg);
  };
  const shift = (dx, dy) => { const [x, y] = zoom.translate(); zoom.translate([x + dx, y + dy]).event(svg); };
  const reset = () => zoom.scale(1).translate([0, 0]).event(svg);
  node.setAttribute("tabindex", "0");
  node.addEventListener("keydown", event => {
    const keys = {"+": () => by(1.5), "=": () => by(1.5), "-": () => by(1 / 1.5), "0": reset, ArrowLeft: () => shift(60, 0),
      ArrowRight: () => shift(-60, 0), ArrowUp: () => shift(0, 60), ArrowDown: () => shift(0, -60)};
    if (event.target !== node || !keys[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    keys[event.key]();
  });
  return [element("button", {type: "button", "aria-label": "Zoom in", onclick: () => by(1.5)}, "+"),
    element("button", {type: "button", "aria-label": "Zoom out", onclick: () => by(1 / 1.5)}, "\u2212"),
    element("button", {type: "button", onclick: reset}, "all of it")];
}

function drawMap(figure, graph, index) {
  const drawn = document.querySelector(`#maps [data-graph="${index}"]`);
  const svg = drawn && drawn.querySelector("svg");
  if (!svg) return figure.append(element("p", {class: "none"}, "No map."));
  const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
  svg.removeAttribute("width");
  svg.removeAttribute("height");
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", "Map of " + graph.title + ", shaded by cost");
  const all = document.createElementNS(svg.namespaceURI, "g");
  all.append(...svg.childNodes);
  svg.append(all);
  const spots = d3.select(all).append("g");
  spots.selectAll("circle").data(graph.map.spots).enter().append("circle")
    .attr({class: "spot", cx: d => d.x, cy: d => d.y, r: 4})
    .on("mouseover", d => showTip(d3.event, `vertex ${d.id}\ncost ${pretty(d.cost, "cost")}`)).on("mouseout", hideTip);
  const tools = zoomable(d3.select(svg), width, height, (scale, [x, y]) => all.setAttribute("transform", `translate(${x},${y})scale(${scale})`));
  figure.append(element("div", {class: "tools"}, ...tools,
    element("span", {class: "none"}, "drag to move, Ctrl and wheel to zoom")), drawn, calls(graph.map.call));
}

function drawBars(figure, sheet) {
  const at = name => sheet.columns.findIndex(column => column.name === name);
  const rows = sheet.rows.map(row => ({name: row[at("order")], ec: row[at("ec")]})).filter(row => Number(row.ec) > 0);
  const most = d3.max(rows, row => Number(row.ec));
  if (rows.length > 1) figure.append(element("div", {class: "bars", role: "img", "aria-label": "EC by ordering"}, ...rows.flatMap(row => [
    element("span", {}, row.name), element("span", {class: "bar", style: `width: ${100 * Number(row.ec) / most}%`}),
    element("span", {}, pretty(row.ec, "ec"))])));
}

// Accuracy against cost. Returns a function that marks the point of a row.
function drawPareto(figure, sheet, choose) {
  const at = name => sheet.columns.findIndex(column => column.name === name);
  const axes = {x: [["ec", "EC"], ["median_s", "seconds of an elimination"], ["isam2_s", "seconds of iSAM2"]],
    y: [["sigma_mean", "mean sigma"], ["ate_rmse", "ATE"], ["edges", "edges"]]};
  const has = ([name]) => sheet.rows.some(row => row[at(name)] !== "");
  const known = {x: axes.x.filter(has), y: axes.y.filter(has)};
  if (sheet.rows.length < 2 || !known.x.length || !known.y.length)
    return figure.append(element("p", {class: "none"}, "Too little was measured for a picture.")), () => {};
  const chosen = {x: known.x[0], y: known.y[0]};
  const policies = [...new Set(sheet.rows.map(row => row[at("policy")]))];
  const orders = [...new Set(sheet.rows.map(row => row[at("order")]))];
  const color = d3.scale.category10().domain(policies);
  // As wide as the page is when it is opened, so that letters have their size on a phone, too.
  const width = Math.max(300, Math.min(1100, figure.clientWidth || 760)), height = Math.round(Math.max(320, Math.min(520, 0.6 * width)));
  const margin = {left: 74, right: 20, top: 16, bottom: 48};
  const svg = d3.select(figure).append("svg").attr({viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": "Accuracy against cost"});
  const clip = "clip" + Math.random().toString(36).slice(2);
  svg.append("clipPath").attr("id", clip).append("rect").attr({x: margin.left, y: margin.top - 8,
    width: width - margin.left - margin.right + 10, height: height - margin.top - margin.bottom + 16});
  const under = svg.append("g"), inside = svg.append("g").attr("clip-path", `url(#${clip})`);
  const xAxis = under.append("g").attr({class: "axis", transform: `translate(0,${height - margin.bottom})`});
  const yAxis = under.append("g").attr({class: "axis", transform: `translate(${margin.left},0)`});
  const xLabel = under.append("text").attr({class: "label", x: width - margin.right, y: height - 8, "text-anchor": "end"});
  const yLabel = under.append("text").attr({class: "label", x: -margin.top, y: 14, "text-anchor": "end", transform: "rotate(-90)"});
  const front = inside.append("path").attr("class", "front");
  const dots = inside.append("g");
  const marks = {x: null, y: null};
  let zoomed = {scale: 1, shift: [0, 0]}, marked = -1;

  const points = () => sheet.rows.map((row, index) => ({index, x: Number(row[at(chosen.x[0])] || NaN), y: Number(row[at(chosen.y[0])] || NaN),
    policy: row[at("policy")], rate: row[at("rate")], order: row[at("order")]}))
    .filter(p => p.x > 0 && Number.isFinite(p.y));
  // Where everything is within a factor of three, a logarithm shows nothing; an error of zero has none.
  function scale(values, range) {
    const [low, high] = d3.extent(values), log = low > 0 && high / low > 3 && high / low < 1e9;
    const pad = log ? Math.pow(high / low, 0.06) : 0.06 * (high - low || Math.abs(high) || 1);
    return (log ? d3.scale.log() : d3.scale.linear()).domain(log ? [low / pad, high * pad] : [low - pad, high + pad]).range(range);
  }
  function best(all) {
    let least = Infinity;
    return all.slice().sort((a, b) => a.x - b.x || a.y - b.y).filter(p => p.y < least && ((least = p.y), true));
  }
  const words = p => [`${p.policy}${p.rate ? " at rate " + p.rate : ""}, in the order of ${p.order}`,
    ...sheet.columns.slice(3).map((column, k) => [column.name, sheet.rows[p.index][k + 3]]).filter(([, text]) => text)
      .map(([name, text]) => `${name} ${pretty(text, name)}`)].join("\n");
  function draw() {
    const all = points(), [dx, dy] = zoomed.shift;
    const base = {x: scale(all.map(p => p.x), [margin.left, width - margin.right]), y: scale(all.map(p => p.y), [height - margin.bottom, margin.top])};
    const stretched = (s, shift) => s.copy().range(s.range().map(r => r * zoomed.scale + shift));
    const wide = {x: stretched(base.x, dx), y: stretched(base.y, dy)};
    marks.x = base.x.copy().domain([margin.left, width - margin.right].map(wide.x.invert));
    marks.y = base.y.copy().domain([height - margin.bottom, margin.top].map(wide.y.invert));
    const unit = name => value => pretty(String(Number(value.toPrecision(6))), name);
    const count = Math.max(3, Math.round(width / 130));
    const ticks = (s, count, name) => {
      const axis = d3.svg.axis().scale(s).ticks(count).tickSize(4);
      const [low, high] = s.domain();
      if (s.base && high / low > 10) {  // of a logarithmic one only powers of ten, or 1, 2 and 5
        const wanted = s.ticks().filter(v => { const d = v / Math.pow(10, Math.floor(Math.log10(v) + 1e-9)); return high / low > 1e3 ? Math.abs(d - 1) < 1e-6 : [1, 2, 5].some(w => Math.abs(d - w) < 1e-6); });
        axis.tickValues(wanted);
      } else if (s.base) {
        axis.tickValues(d3.scale.linear().domain(s.domain()).ticks(count));
      }
      return axis.tickFormat(unit(name));
    };
    xAxis.call(ticks(marks.x, count, chosen.x[0]).orient("bottom"));
    yAxis.call(ticks(marks.y, 6, chosen.y[0]).orient("left"));
    xLabel.text(chosen.x[1] + " \u2192 dearer");
    yLabel.text(chosen.y[0] === "edges" ? chosen.y[1] : chosen.y[1] + " \u2192 worse");
    front.attr("d", chosen.y[0] === "edges" ? null : d3.svg.line().x(p => marks.x(p.x)).y(p => marks.y(p.y)).interpolate("step-after")(best(all)));
    const dot = dots.selectAll("path").data(all, p => p.index);
    dot.exit().remove();
    dot.enter().append("path").attr({class: "point", tabindex: 0, role: "button"})
      .on("mouseover", p => showTip(d3.event, words(p))).on("mouseout", hideTip)
      .on("focus", p => showTip(d3.event, words(p))).on("blur", hideTip)
      .on("click", p => choose(p.index))
      .on("keydown", p => { if (d3.event.key === "Enter" || d3.event.key === " ") { d3.event.preventDefault(); choose(p.index); } });
    dot.attr("transform", p => `translate(${marks.x(p.x)},${marks.y(p.y)})`).attr("aria-label", words)
      .attr("d", p => d3.svg.symbol().type(orders.indexOf(p.order) ? "diamond" : "circle").size(p.policy === "full" ? 160 : 90)())
      .attr("fill", p => orders.indexOf(p.order) ? color(p.policy) : "var(--card)")
      .attr("stroke", p => color(p.policy)).classed("chosen", p => p.index === marked)
      .filter(p => p.index === marked).each(function () { this.parentNode.append(this); });  // on top
  }
  const chooser = axis => {
    const menu = element("select", {onchange: () => { chosen[axis] = known[axis][menu.selectedIndex]; draw(); }},
      ...known[axis].map(([, words]) => element("option", {}, words)));
    return element("label", {}, axis === "x" ? "across" : "up", menu);
  };
  const tools = zoomable(svg, width, height, (k, shift) => { zoomed = {scale: k, shift}; draw(); });
  const key = (d, policy, words) => {
    const item = element("span");
    item.innerHTML = `<svg viewBox="-7 -7 14 14" aria-hidden="true"><path d="${d}" fill="${policy}" stroke="${policy}" stroke-width="2"/></svg>`;
    item.append(words);
    return item;
  };
  const circle = d3.svg.symbol().type("circle").size(80)(), diamond = d3.svg.symbol().type("diamond").size(80)();
  const legend = element("div", {class: "legend"}, ...policies.map(policy => {
    const item = key(circle, color(policy), policy);
    item.dataset.policy = policy;
    return item;
  }));
  orders.forEach((order, k) => {
    const item = key(k ? diamond : circle, "currentColor", "in the order of " + order);
    if (!k) item.querySelector("path").setAttribute("fill", "none");
    legend.append(item);
  });
  figure.prepend(element("div", {class: "tools"}, chooser("x"), chooser("y"), ...tools));
  figure.append(legend);
  draw();
  return index => { marked = index; draw(); };
}

// ---- a chapter a graph

function addChapter(graph, index) {
  const made = document.getElementById("chapter").content.cloneNode(true).firstElementChild;
  document.getElementById("chapters").append(made);  // first, so that pictures know their width
  const part = name => made.querySelector(`[data-sheet="${name}"]`);
  made.id = "graph" + index;
  made.querySelector("h2").textContent = graph.title;
  const advice = made.querySelector(".advice");
  advice.classList.toggle("off", !graph.advice.granted);
  advice.querySelector(".wish").textContent = "Wanted: " + graph.advice.wish;
  advice.querySelector(".sentence").textContent = graph.advice.sentence;
  if (graph.advice.pipe) {
    advice.dataset.ec = graph.advice.ec;
    advice.querySelector(".calls").append(command(graph.advice.pipe + " >faster.g2o"),
      element("p", {class: "wish"}, `Its EC, ${graph.advice.ec}, is printed by`), command(graph.advice.check));
  }
  part("facts").append(facts(graph.facts), calls(graph.facts.call));
  const sheets = {findings: "Findings", orderings: "Orderings", variables: "Costliest variables", cliques: "Costliest cliques",
    edges: "Costliest edges"};
  for (const [name, words] of Object.entries(sheets)) part(name).append(table(graph[name], words), calls(graph[name].call));
  drawBars(made.querySelector("[data-bars]"), graph.orderings);
  drawMap(made.querySelector("[data-map]"), graph, index);
  let mark = () => {};
  const choose = row => {
    mark(row);
    for (const other of part("variants").querySelectorAll("tr[data-row]")) other.setAttribute("aria-selected", other.dataset.row === String(row));
    const place = made.querySelector(".calls[data-row]"), {pipe, prints} = graph.calls[row];
    const cells = graph.variants.rows[row];
    place.replaceChildren(element("h4", {}, `${cells[0]}${cells[1] ? " at rate " + cells[1] : ""}, in the order of ${cells[2]}`),
      command(pipe), element("p", {}, "Its numbers: EC; seconds of an elimination; seconds of iSAM2; sigma and ATE."),
      ...graph.first.map(command), ...prints.map(command));
  };
  part("variants").append(table(graph.variants, "Policies and rates", choose));
  mark = drawPareto(made.querySelector("[data-pareto]"), graph.variants, choose);
  if (graph.advice.variant !== undefined) choose(graph.advice.variant);
  if (graph.notes.length) {
    const notes = made.querySelector(".notes");
    notes.hidden = false;
    notes.querySelector("ul").append(...graph.notes.map(note => element("li", {}, note)));
  }
}

for (const [policy, what] of Object.entries(data.policies))
  for (const item of document.querySelectorAll(`.legend [data-policy="${policy}"]`)) item.title = what;
document.title = data.graphs.map(graph => graph.title.split(":")[0]).join(", ") + " \u2013 sg-report";
document.getElementById("call").textContent = data.call;
data.graphs.forEach(addChapter);
if (data.graphs.length > 1)
  document.getElementById("graphs").append(...data.graphs.map((graph, k) => element("a", {href: "#graph" + k}, graph.title.split(":")[0])));
document.documentElement.dataset.ready = "yes";
})();
