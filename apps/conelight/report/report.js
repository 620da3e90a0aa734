// SPDX-License-Identifier: MIT
// The report's page: two layers (pictures or error maps) under a divider, controls, read-out, tables. pixels.js and
// tables.js stand before this. State is one object; every change ends in draw(). ASCII only.
const $ = (id) => document.getElementById(id);
const data = JSON.parse($("data").textContent);
const scales = {magnitude: bytesOfText(data.scales.magnitude), signed: bytesOfText(data.scales.signed)};
const mapNames = {signed: "error, signed", absolute: "error, absolute", relative: "error, relative squared",
                  flip: "FLIP", hdrFlip: "HDR-FLIP"};
const errorEnds = {signed: ["too dark", "too bright"], absolute: ["0", ""], relative: ["0", ""],
                   flip: ["0, invisible", ""], hdrFlip: ["0, invisible", ""]};

const state = {view: 0, a: 0, b: 0, split: 0.5, exposure: 0, tone: "none", end: 0.5, zoom: 0, panX: 0, panY: 0,
               swapped: false, pixel: null};
let layers = [];  // of the view: {label, kind, picture}

// --- Layers ---------------------------------------------------------------------------------------------

function layersOf(view) {
  const list = view.pictures.map((picture, i) => ({label: picture.name, kind: "picture", picture: i}));
  view.pictures.forEach((picture, i) => {
    const kinds = view.reference !== null && i !== view.reference ? ["signed", "absolute", "relative"] : [];
    for (const kind of ["flip", "hdrFlip"]) if (kind in picture) kinds.push(kind);
    for (const kind of kinds) list.push({label: picture.name + ": " + mapNames[kind], kind, picture: i});
  });
  return list;
}

const pictureValues = (view, i) => blockValues(view.pictures[i].block, data.format);

// RGB of a picture, one value per pixel of a map.
function layerValues(layer) {
  const view = data.views[state.view], picture = view.pictures[layer.picture];
  if (layer.kind === "picture") return pictureValues(view, layer.picture);
  if (layer.kind in picture) return blockValues(picture[layer.kind], "map");
  if (!layer.values) {
    const r = pictureValues(view, view.reference);
    const mean = picture.referenceMean ?? meanOfFinite(r);
    layer.values = errorValues(layer.kind, pictureValues(view, layer.picture), r, mean);
  }
  return layer.values;
}

const isFlip = (kind) => kind === "flip" || kind === "hdrFlip";

// The layer as a canvas of the picture's size, drawn anew when what it depends on has changed.
function layerCanvas(layer) {
  const view = data.views[state.view];
  const end = isFlip(layer.kind) ? 1 : state.end;
  const key = layer.kind === "picture" ? state.exposure + state.tone : String(end);
  if (layer.key !== key) {
    layer.canvas ??= element("canvas", {width: view.width, height: view.height});
    const context = layer.canvas.getContext("2d");
    const pixels = context.createImageData(view.width, view.height);
    if (layer.kind === "picture") {
      pictureBytes(layerValues(layer), state.exposure, state.tone, pixels.data);
    } else {
      const isSigned = layer.kind === "signed";
      mapBytes(layerValues(layer), isSigned ? scales.signed : scales.magnitude, isSigned, end, pixels.data);
    }
    context.putImageData(pixels, 0, 0);
    layer.key = key;
  }
  return layer.canvas;
}

const shownA = () => layers[state.swapped ? state.b : state.a];
const shownB = () => layers[state.swapped ? state.a : state.b];

// --- The stage ------------------------------------------------------------------------------------------

const canvas = $("canvas"), stage = $("stage");
const zoomLevels = [1 / 8, 1 / 4, 1 / 2, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32];

// Screen pixels per picture pixel, and where the picture's corner lies, in CSS pixels of the stage.
function placement() {
  const view = data.views[state.view], width = stage.clientWidth, height = stage.clientHeight;
  const fit = Math.min(width / view.width, height / view.height);
  const scale = state.zoom || fit;
  const w = view.width * scale, h = view.height * scale;
  const clampPan = (pan, size, room) => (size <= room ? 0 : Math.min(Math.max(pan, (room - size) / 2), (size - room) / 2));
  state.panX = clampPan(state.panX, w, width);
  state.panY = clampPan(state.panY, h, height);
  return {scale, x: (width - w) / 2 + state.panX, y: (height - h) / 2 + state.panY, w, h, width, height};
}

// As tall as the picture at full width, but never taller than most of the window.
function resizeStage() {
  const view = data.views[state.view];
  const room = Math.max(260, window.innerHeight * 0.78);
  stage.style.height = Math.round(Math.min(stage.clientWidth * view.height / view.width, room)) + "px";
}

function drawHalf(context, layer, place, from, to) {
  if (to <= from) return;
  context.save();
  context.beginPath();
  context.rect(from, 0, to - from, place.height);
  context.clip();
  context.imageSmoothingEnabled = place.scale < 1;
  context.imageSmoothingQuality = "high";
  context.drawImage(layerCanvas(layer), place.x, place.y, place.w, place.h);
  context.restore();
}

function drawProbe(context, place) {
  if (!state.pixel) return;
  const [x, y] = state.pixel, size = Math.max(place.scale, 7);
  const cx = place.x + (x + 0.5) * place.scale, cy = place.y + (y + 0.5) * place.scale;
  context.lineWidth = 1;
  for (const [color, grow] of [["#000", 1], ["#fff", 0]]) {
    context.strokeStyle = color;
    context.strokeRect(cx - size / 2 - grow, cy - size / 2 - grow, size + 2 * grow, size + 2 * grow);
  }
}

let pending = false;
function draw() {
  if (pending) return;
  pending = true;
  requestAnimationFrame(() => { pending = false; drawNow(); });
}

function drawNow() {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(stage.clientWidth * ratio);
  canvas.height = Math.round(stage.clientHeight * ratio);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  const place = placement(), at = state.split * place.width;
  drawHalf(context, shownA(), place, 0, at);
  drawHalf(context, shownB(), place, at, place.width);
  drawProbe(context, place);
  const split = $("split");
  split.style.left = at + "px";
  split.setAttribute("aria-valuenow", Math.round(state.split * 100));
  split.setAttribute("aria-valuetext", Math.round(state.split * 100) + " percent of the width shows A");
  $("tagA").textContent = shownA().label;
  $("tagB").textContent = shownB().label;
  $("exposureText").textContent = (state.exposure > 0 ? "+" : "") + state.exposure.toFixed(1) + " stops";
  $("zoomText").textContent = Math.round(place.scale * ratio * 100) + " %";
  $("scaleText").textContent = endText(state.end);
  drawLegends();
  showPixel();
  document.documentElement.dataset.draws = Number(document.documentElement.dataset.draws || 0) + 1;
}

const endText = (end) => Number(end.toPrecision(2)).toString();

function drawLegends() {
  const kinds = [...new Set([shownA(), shownB()].map((layer) => layer.kind))].filter((kind) => kind !== "picture");
  const key = kinds.join() + state.end;
  if ($("legends").dataset.key === key) return;
  $("legends").dataset.key = key;
  $("legends").replaceChildren(...kinds.map((kind) => {
    const isSigned = kind === "signed", end = isFlip(kind) ? 1 : state.end;
    const bar = element("canvas", {width: 256, height: 1});
    const context = bar.getContext("2d"), pixels = context.createImageData(256, 1);
    const ramp = Float32Array.from({length: 256}, (_, i) => (isSigned ? i / 127.5 - 1 : i / 255));
    mapBytes(ramp, isSigned ? scales.signed : scales.magnitude, isSigned, 1, pixels.data);
    context.putImageData(pixels, 0, 0);
    bar.setAttribute("aria-hidden", "true");
    const unit = kind === "signed" || kind === "absolute" ? " of the mean" : "";
    const [low, high] = errorEnds[kind];
    const left = isSigned ? low + ", -" + endText(end) + unit : low;
    const right = (high ? high + ", +" : "") + endText(end) + unit + (isFlip(kind) ? ", obvious" : "");
    return element("div", {className: "legend"}, mapNames[kind] + " (green: not a number)", bar,
                   element("div", {}, element("span", {textContent: left}), element("span", {textContent: right})));
  }));
}

// --- Read-out -------------------------------------------------------------------------------------------

// As many digits as the values in the page have.
const digits = data.format === "half" ? 4 : 6;
function valueText(value) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "NaN" : value > 0 ? "+Inf" : "-Inf";
  return value === 0 ? "0" : Math.abs(value) >= 1e-4 && Math.abs(value) < 1e6
    ? Number(value.toPrecision(digits)).toString() : value.toExponential(3);
}

function pixelValues(layer, index) {
  const values = layerValues(layer);
  if (layer.kind === "picture") return [...values.subarray(3 * index, 3 * index + 3)];
  return [isFlip(layer.kind) ? Math.round(values[index] * 1000) / 1000 : values[index]];
}

function fillRow(id, values) {
  const cells = $(id).querySelectorAll("td");
  cells.forEach((cell, i) => { cell.textContent = i < values.length ? valueText(values[i]) : ""; });
}

function showPixel() {
  const view = data.views[state.view];
  if (!state.pixel) return;
  const [x, y] = state.pixel, index = y * view.width + x;
  $("pixel").textContent = x + ", " + y;
  const a = pixelValues(shownA(), index), b = pixelValues(shownB(), index);
  fillRow("readA", a);
  fillRow("readB", b);
  fillRow("readD", a.length === b.length ? a.map((value, i) => value - b[i]) : []);
}

function setPixel(x, y) {
  const view = data.views[state.view];
  state.pixel = [Math.min(Math.max(x, 0), view.width - 1), Math.min(Math.max(y, 0), view.height - 1)];
  draw();
}

function pixelUnder(event) {
  const box = stage.getBoundingClientRect(), place = placement();
  return [Math.floor((event.clientX - box.left - stage.clientLeft - place.x) / place.scale),
          Math.floor((event.clientY - box.top - stage.clientTop - place.y) / place.scale)];
}

// --- Choices --------------------------------------------------------------------------------------------

function fillPick(select) {
  const groups = [["Pictures", (layer) => layer.kind === "picture"]];
  data.views[state.view].pictures.forEach((picture, i) => {
    groups.push(["Error of " + picture.name, (layer) => layer.kind !== "picture" && layer.picture === i]);
  });
  select.replaceChildren();
  for (const [label, belongs] of groups) {
    const options = layers.map((layer, i) => [layer, i]).filter(([layer]) => belongs(layer))
      .map(([layer, i]) => new Option(layer.kind === "picture" ? layer.label : mapNames[layer.kind], i));
    if (options.length) select.append(Object.assign(element("optgroup", {}, ...options), {label}));
  }
}

function choose(side, index) {
  if (index < 0 || index >= layers.length) return;
  state[side] = index;
  $("pickA").value = state.a;
  $("pickB").value = state.b;
  draw();
}

// Keeps what A and B show when the next view has layers of the same names.
function showView(index) {
  const wanted = [layers[state.a]?.label, layers[state.b]?.label];
  const old = data.views[state.view], view = data.views[index];
  const first = !layers.length;
  state.view = index;
  layers = layersOf(view);
  const find = (label, fallback) => Math.max(layers.findIndex((layer) => layer.label === label), -1) + 1
    ? layers.findIndex((layer) => layer.label === label) : fallback;
  const notReference = view.pictures.findIndex((_, i) => i !== view.reference);
  state.a = find(wanted[0], Math.max(notReference, 0));
  state.b = find(wanted[1], view.reference ?? Math.min(1, view.pictures.length - 1));
  if (first || old.exposure !== view.exposure) state.exposure = view.exposure;
  if (first || old.tone !== view.tone) state.tone = view.tone;
  if (first || old.width !== view.width || old.height !== view.height) {
    state.zoom = state.panX = state.panY = 0;
    state.pixel = null;
  }
  fillPick($("pickA"));
  fillPick($("pickB"));
  $("exposure").value = state.exposure;
  $("tone").value = state.tone;
  [...$("views").children].forEach((button, i) => button.setAttribute("aria-pressed", i === index));
  resizeStage();
  choose("a", state.a);
}

function setExposure(stops) {
  state.exposure = Math.min(Math.max(Math.round(stops * 10) / 10, -10), 10);
  $("exposure").value = state.exposure;
  draw();
}

function setTone(tone) {
  state.tone = $("tone").value = tone;
  draw();
}

function setSwapped(swapped) {
  if (state.swapped === swapped) return;
  state.swapped = swapped;
  draw();
}

function swap() {
  [state.a, state.b] = [state.b, state.a];
  choose("a", state.a);
}

// Next level in a direction, about a point of the stage (its middle without one).
function zoomBy(direction, x = stage.clientWidth / 2, y = stage.clientHeight / 2) {
  const before = placement();
  const levels = direction > 0 ? zoomLevels : [...zoomLevels].reverse();
  const next = levels.find((level) => (level - before.scale) * direction > 1e-6 * level);
  if (!next) return;
  state.zoom = next;
  const grow = next / before.scale, view = data.views[state.view];
  state.panX = x - (x - before.x) * grow - (before.width - view.width * next) / 2;
  state.panY = y - (y - before.y) * grow - (before.height - view.height * next) / 2;
  draw();
}

function zoomFit() {
  state.zoom = state.panX = state.panY = 0;
  draw();
}

// --- Mouse, keyboard ------------------------------------------------------------------------------------

function moveSplitTo(clientX) {
  const box = stage.getBoundingClientRect();
  state.split = Math.min(Math.max((clientX - box.left - stage.clientLeft) / stage.clientWidth, 0), 1);
  draw();
}

function listenToPointer() {
  const split = $("split");
  split.addEventListener("pointerdown", (event) => split.setPointerCapture(event.pointerId));
  split.addEventListener("pointermove", (event) => {
    if (split.hasPointerCapture(event.pointerId)) moveSplitTo(event.clientX);
  });
  let drag = null;
  canvas.addEventListener("pointerdown", (event) => {
    drag = [event.clientX - state.panX, event.clientY - state.panY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointerup", () => { drag = null; });
  canvas.addEventListener("pointercancel", () => { drag = null; });
  canvas.addEventListener("pointermove", (event) => {
    if (drag && state.zoom) {
      state.panX = event.clientX - drag[0];
      state.panY = event.clientY - drag[1];
    }
    setPixel(...pixelUnder(event));
  });
  stage.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey && document.activeElement !== canvas) return;
    event.preventDefault();
    const box = stage.getBoundingClientRect();
    zoomBy(event.deltaY < 0 ? 1 : -1, event.clientX - box.left, event.clientY - box.top);
  }, {passive: false});
}

const keys = {
  "x": swap, "0": zoomFit, "+": () => zoomBy(1), "=": () => zoomBy(1), "-": () => zoomBy(-1),
  "[": () => setExposure(state.exposure - 0.5), "]": () => setExposure(state.exposure + 0.5),
  "v": () => showView((state.view + 1) % data.views.length),
  "t": () => {
    const tones = Object.keys(toneCurves);
    setTone(tones[(tones.indexOf(state.tone) + 1) % tones.length]);
  },
};

function onKey(event) {
  const target = event.target, typing = target.matches("select, input, button, summary");
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const step = event.shiftKey ? 10 : 1;
  const arrow = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
  if (target === $("split") && arrow && arrow[0]) {
    state.split = Math.min(Math.max(state.split + arrow[0] * step * 0.01, 0), 1);
    draw();
  } else if (target === canvas && arrow) {
    const view = data.views[state.view], [x, y] = state.pixel ?? [view.width >> 1, view.height >> 1];
    setPixel(x + arrow[0] * step, y + arrow[1] * step);
  } else if (event.key === " " && !typing) {
    setSwapped(true);
  } else if (/^Digit[1-9]$/.test(event.code) && !typing) {
    choose(event.shiftKey ? "b" : "a", Number(event.code[5]) - 1);
  } else if (!typing && keys[event.key.toLowerCase()]) {
    keys[event.key.toLowerCase()]();
  } else {
    return;
  }
  event.preventDefault();
}

// --- Tables ---------------------------------------------------------------------------------------------

function fillTables() {
  data.views.forEach((view, v) => {
    if (!view.metrics) return;
    $("tables").append(tableSection(view.metrics, (name) => {
      showView(v);
      choose("a", layers.findIndex((layer) => layer.label === name));
      stage.scrollIntoView({block: "nearest"});
    }));
  });
  for (const table of data.tables) $("tables").append(tableSection(table));
}

function fillOrigin() {
  for (const command of data.commands) {
    const copy = element("button", {type: "button", textContent: "Copy"});
    copy.onclick = () => {
      navigator.clipboard?.writeText(command).then(() => { copy.textContent = "Copied"; }, () => {});
    };
    $("commands").append(element("div", {}, element("code", {textContent: command}), copy));
  }
  const list = element("dl");
  for (const [key, value] of data.settings) {
    list.append(element("dt", {textContent: key}), element("dd", {textContent: value}));
  }
  $("settings").append(list);
  $("settingsBox").hidden = !data.settings.length;
  $("precision").textContent = data.format === "half"
    ? "Values in this page are 16-bit floats: 3 to 4 digits of those in the files."
    : "Values are the 32-bit floats of the pictures, shown to 6 digits; those of FLIP have 8 bits.";
}

// --- Start ----------------------------------------------------------------------------------------------

function start() {
  if (data.views.length > 1) {
    data.views.forEach((view, i) => {
      $("views").append(element("button", {type: "button", textContent: view.name, onclick: () => showView(i)}));
    });
  }
  fillTables();
  fillOrigin();
  showView(0);
  $("scale").value = Math.log10(state.end);
  $("pickA").onchange = (event) => choose("a", Number(event.target.value));
  $("pickB").onchange = (event) => choose("b", Number(event.target.value));
  $("swap").onclick = swap;
  $("flip").onpointerdown = () => setSwapped(true);
  $("flip").onkeydown = (event) => { if (event.key === " " || event.key === "Enter") setSwapped(true); };
  $("flip").onblur = () => setSwapped(false);
  $("exposure").oninput = (event) => setExposure(Number(event.target.value));
  $("tone").onchange = (event) => setTone(event.target.value);
  $("scale").oninput = (event) => { state.end = 10 ** Number(event.target.value); draw(); };
  $("zoomFit").onclick = zoomFit;
  $("zoomIn").onclick = () => zoomBy(1);
  $("zoomOut").onclick = () => zoomBy(-1);
  listenToPointer();
  document.addEventListener("keydown", onKey);
  document.addEventListener("keyup", () => setSwapped(false));
  window.addEventListener("pointerup", () => setSwapped(false));
  window.addEventListener("resize", () => { resizeStage(); draw(); });
}
start();
