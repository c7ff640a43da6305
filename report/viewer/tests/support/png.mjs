// Pixels of a screenshot: 8 bits a channel, not interlaced, which is what Chromium writes.
import { inflateSync } from "node:zlib";

export function decodePng(buffer) {
  const width = buffer.readUInt32BE(16),
    height = buffer.readUInt32BE(20);
  const channels = { 2: 3, 6: 4 }[buffer[25]];
  if (buffer[24] !== 8 || !channels || buffer[28] !== 0) throw new Error("unexpected kind of PNG");
  const parts = [];
  for (let at = 8; at < buffer.length;) {
    const length = buffer.readUInt32BE(at);
    if (buffer.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(buffer.subarray(at + 8, at + 8 + length));
    at += 12 + length;
  }
  const raw = inflateSync(Buffer.concat(parts));
  const stride = width * channels;
  const data = new Uint8Array(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (stride + 1)];
    for (let x = 0; x < stride; ++x) {
      const left = x >= channels ? data[y * stride + x - channels] : 0;
      const up = y > 0 ? data[(y - 1) * stride + x] : 0;
      const corner = x >= channels && y > 0 ? data[(y - 1) * stride + x - channels] : 0;
      data[y * stride + x] =
        raw[y * (stride + 1) + 1 + x] + [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter];
    }
  }
  return { width, height, channels, data };
}

function paeth(left, up, corner) {
  const p = left + up - corner;
  const [a, b, c] = [left, up, corner].map((x) => Math.abs(p - x));
  return a <= b && a <= c ? left : b <= c ? up : corner;
}

/** Share of pixels that differ by more than a little in some channel; 1 when the sizes differ. */
export function difference(a, b) {
  const x = decodePng(a),
    y = decodePng(b);
  if (x.width !== y.width || x.height !== y.height || x.channels !== y.channels) return 1;
  let changed = 0;
  for (let i = 0; i < x.data.length; i += x.channels) {
    if ([0, 1, 2].some((k) => Math.abs(x.data[i + k] - y.data[i + k]) > 12)) ++changed;
  }
  return changed / (x.width * x.height);
}

/** Share of pixels unlike the top left one: 0 for a blank picture. */
export function ink(png) {
  const { data, channels, width, height } = decodePng(png);
  let count = 0;
  for (let i = 0; i < data.length; i += channels)
    if ([0, 1, 2].some((k) => Math.abs(data[i + k] - data[k]) > 12)) ++count;
  return count / (width * height);
}
