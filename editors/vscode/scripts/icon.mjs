// Draws the icon: a window of stained glass, one pane of which is being looked at. No picture has to be kept in the tree for it.

import { deflateSync } from 'node:zlib';

const SIZE = 256;
/** Samples along one edge of a pixel. */
const SAMPLES = 4;

const BACKGROUND = [27, 26, 36];
const LEAD = [14, 13, 20];
const FRAME = [196, 178, 138];
const MARK = [255, 255, 255];

/** The window: four columns of panes under a pointed arch, in units of the picture. */
const WINDOW = { left: 0.2, right: 0.8, spring: 0.63, bottom: 0.9, columns: 4, rows: 6, top: 0.11 };
/** The pane that is looked at, counted from the upper left. */
const LOOKED_AT = { column: 2, row: 3 };

/** How far inside the arch a point is; negative outside. The arch is the meeting of two circles, each around the other side. */
function depthInWindow(x, y) {
  const { left, right, spring, bottom } = WINDOW;
  if (y >= spring) {
    return Math.min(x - left, right - x, bottom - y);
  }
  const radius = right - left;
  return Math.min(radius - Math.hypot(x - left, y - spring), radius - Math.hypot(x - right, y - spring));
}

/** A colour of full strength, hue in turns. */
function hue(turns) {
  return [0, 1 / 3, 2 / 3].map((shift) => {
    const distance = Math.abs((((turns - shift) % 1) + 1.5) % 1 - 0.5);
    return 255 * Math.min(1, Math.max(0, 2 - 6 * distance));
  });
}

function mix(from, to, weight) {
  return from.map((value, i) => value + (to[i] - value) * weight);
}

/** The colour of a point, both coordinates from 0 to 1. */
function colorAt(x, y) {
  const depth = depthInWindow(x, y);
  if (depth < -0.035) {
    return BACKGROUND;
  }
  if (depth < 0) {
    return FRAME;
  }
  const { left, right, top, bottom, columns, rows } = WINDOW;
  const across = ((x - left) / (right - left)) * columns;
  const down = ((y - top) / (bottom - top)) * rows;
  const [column, row] = [Math.floor(across), Math.floor(down)];
  const [u, v] = [across - column, down - row];
  const edge = Math.min(u * 0.15, (1 - u) * 0.15, v * 0.133, (1 - v) * 0.133);
  const looked = column === LOOKED_AT.column && row === LOOKED_AT.row;
  if (edge < (looked ? 0.016 : 0.007)) {
    return looked && edge > 0.003 ? MARK : LEAD;
  }
  // Rows go round the colours, columns shift them; a little light from the upper left in each pane.
  const glass = hue(row / 7 + column * 0.06 + 0.02);
  const light = 0.25 * (1 - u) * (1 - v) + (looked ? 0.35 : 0);
  return mix(mix(glass, [40, 30, 60], looked ? 0 : 0.25), [255, 255, 255], light);
}

function pixels() {
  const rows = Buffer.alloc(SIZE * (SIZE * 3 + 1));
  for (let y = 0; y < SIZE; y++) {
    for (let x = 0; x < SIZE; x++) {
      let sum = [0, 0, 0];
      for (let i = 0; i < SAMPLES * SAMPLES; i++) {
        const dx = ((i % SAMPLES) + 0.5) / SAMPLES;
        const dy = (Math.floor(i / SAMPLES) + 0.5) / SAMPLES;
        const color = colorAt((x + dx) / SIZE, (y + dy) / SIZE);
        sum = sum.map((value, c) => value + color[c]);
      }
      // One byte before each row says that it is stored unfiltered.
      rows.set(sum.map((value) => Math.round(value / (SAMPLES * SAMPLES))), y * (SIZE * 3 + 1) + 1 + x * 3);
    }
  }
  return rows;
}

function crc(bytes) {
  let value = 0xffffffff;
  for (const byte of bytes) {
    value ^= byte;
    for (let bit = 0; bit < 8; bit++) {
      value = (value >>> 1) ^ (value & 1 ? 0xedb88320 : 0);
    }
  }
  return (value ^ 0xffffffff) >>> 0;
}

function chunk(name, data) {
  const named = Buffer.concat([Buffer.from(name, 'latin1'), data]);
  const whole = Buffer.alloc(named.length + 8);
  whole.writeUInt32BE(data.length, 0);
  named.copy(whole, 4);
  whole.writeUInt32BE(crc(named), named.length + 4);
  return whole;
}

/** The icon as a PNG file of 8-bit RGB. */
export function icon() {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(SIZE, 0);
  header.writeUInt32BE(SIZE, 4);
  header.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([
    Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunk('IHDR', header),
    chunk('IDAT', deflateSync(pixels(), { level: 9 })),
    chunk('IEND', Buffer.alloc(0)),
  ]);
}
