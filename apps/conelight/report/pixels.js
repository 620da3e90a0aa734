// SPDX-License-Identifier: MIT
// Numbers of the page: values out of base64, layers (pictures and error maps) to display bytes. No DOM but the
// blocks' text. Formulas of the maps are those of reference/metrics.h, of the tone curves those of
// src/image/tone_map.cpp. ASCII only.
"use strict";

function bytesOfText(text) {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

// 65,536 possible halves, once (IEEE 754 binary16).
let halfTable = null;
function floatsOfHalves(bytes) {
  if (!halfTable) {
    halfTable = new Float32Array(65536);
    for (let h = 0; h < 65536; h++) {
      const exponent = (h >> 10) & 31, mantissa = h & 1023, sign = h & 0x8000 ? -1 : 1;
      if (exponent === 0) halfTable[h] = sign * mantissa * 2 ** -24;
      else if (exponent === 31) halfTable[h] = mantissa ? NaN : sign * Infinity;
      else halfTable[h] = sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
    }
  }
  const floats = new Float32Array(bytes.length / 2);
  for (let i = 0; i < floats.length; i++) floats[i] = halfTable[bytes[2 * i] | (bytes[2 * i + 1] << 8)];
  return floats;
}

// Block -> its values, decoded when first asked for. Maps come as bytes: n / 254, 255 = not a number.
const decodedBlocks = new Map();
function blockValues(block, format) {
  if (!decodedBlocks.has(block)) {
    const bytes = bytesOfText(document.getElementById("block" + block).textContent);
    let values;
    if (format === "map") values = Float32Array.from(bytes, (n) => (n === 255 ? NaN : n / 254));
    else values = format === "half" ? floatsOfHalves(bytes) : new Float32Array(bytes.buffer);
    decodedBlocks.set(block, values);
  }
  return decodedBlocks.get(block);
}

const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

// Error per pixel of x against r, both RGB.
function errorValues(kind, x, r, referenceMean) {
  const values = new Float32Array(x.length / 3);
  for (let i = 0, k = 0; k < values.length; k++, i += 3) {
    const d0 = x[i] - r[i], d1 = x[i + 1] - r[i + 1], d2 = x[i + 2] - r[i + 2];
    if (kind === "relative") {
      values[k] = (d0 * d0 / (r[i] * r[i] + 0.01) + d1 * d1 / (r[i + 1] * r[i + 1] + 0.01) +
                   d2 * d2 / (r[i + 2] * r[i + 2] + 0.01)) / 3;
    } else {
      const difference = luminance(d0, d1, d2);
      const part = difference === 0 ? 0 : difference / referenceMean;
      values[k] = kind === "signed" ? part : Math.abs(part);
    }
  }
  return values;
}

function meanOfFinite(values) {
  let sum = 0, count = 0;
  for (const value of values) if (Number.isFinite(value)) { sum += value; count++; }
  return count ? sum / count : 0;
}

// sRGB bytes of 16,384 steps of [0,1]: one step is at most a fifth of a byte.
const srgbSteps = 16383;
const srgbBytes = Uint8Array.from({length: srgbSteps + 1}, (_, i) => {
  const c = i / srgbSteps;
  return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
});
const displayByte = (c) => srgbBytes[c >= 1 ? srgbSteps : c > 0 ? (c * srgbSteps + 0.5) | 0 : 0];

const each = (curve) => (r, g, b) => [curve(r), curve(g), curve(b)];
const times = (m, r, g, b) => [0, 1, 2].map((i) => m[i] * r + m[i + 3] * g + m[i + 6] * b);  // columns

function agx(r, g, b) {
  const inset = [0.842479062, 0.042328242, 0.042375655, 0.0784336, 0.878468636, 0.0784336,
    0.079223745, 0.079166127, 0.879142974];
  const outset = [1.196879005, -0.052896852, -0.052971636, -0.098020881, 1.151903130, -0.098043450,
    -0.099029744, -0.098961177, 1.151073673];
  const curved = times(inset, r, g, b).map((c) => {
    const x = Math.min(Math.max((Math.log2(Math.max(c, 1e-10)) + 12.47393) / 16.5, 0), 1);
    const x2 = x * x, x4 = x2 * x2;
    return 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
  });
  return times(outset, ...curved).map((c) => Math.max(c / 0.99858, 0) ** 2.2);
}

function neutral(r, g, b) {
  const start = 0.76, room = 0.24, desaturation = 0.15;
  const least = Math.min(r, g, b), offset = least < 0.08 ? least - 6.25 * least * least : 0.04;
  const c = [r - offset, g - offset, b - offset], peak = Math.max(...c);
  if (peak < start) return c;
  const shown = 1 - room * room / (peak + room - start), part = 1 / (desaturation * (peak - shown) + 1);
  return c.map((one) => shown + (one * shown / peak - shown) * part);
}

// By the names of image.tone_map.
const toneCurves = {
  none: each((c) => c),
  reinhard: (r, g, b) => each((c) => c / (1 + luminance(r, g, b)))(r, g, b),
  aces: each((c) => (c * (2.51 * c + 0.03)) / (c * (2.43 * c + 0.59) + 0.14)),
  agx, neutral,
};

// RGB radiance -> RGBA bytes; a pixel that is not finite shows green, as in error maps.
function pictureBytes(values, exposure, tone, out) {
  const gain = 2 ** exposure, curve = toneCurves[tone], white = 1e6;
  for (let i = 0, o = 0; i < values.length; i += 3, o += 4) {
    let r = values[i] * gain, g = values[i + 1] * gain, b = values[i + 2] * gain;
    out[o + 3] = 255;
    if (!Number.isFinite(r + g + b)) { out[o] = 0; out[o + 1] = 255; out[o + 2] = 0; continue; }
    r = Math.min(Math.max(r, 0), white); g = Math.min(Math.max(g, 0), white); b = Math.min(Math.max(b, 0), white);
    const shown = curve(r, g, b);
    out[o] = displayByte(shown[0]); out[o + 1] = displayByte(shown[1]); out[o + 2] = displayByte(shown[2]);
  }
}

// Values -> RGBA bytes by a colour scale of 256 colours; `end` is the value at its end.
function mapBytes(values, scale, isSigned, end, out) {
  for (let k = 0, o = 0; k < values.length; k++, o += 4) {
    const part = values[k] / end, at = isSigned ? part * 0.5 + 0.5 : part;
    out[o + 3] = 255;
    if (Number.isNaN(at)) { out[o] = 0; out[o + 1] = 255; out[o + 2] = 0; continue; }
    const c = 3 * Math.round(255 * Math.min(Math.max(at, 0), 1));
    out[o] = scale[c]; out[o + 1] = scale[c + 1]; out[o + 2] = scale[c + 2];
  }
}
