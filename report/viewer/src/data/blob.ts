import { inflateSync } from "fflate";
import type { Part } from "./report";

// The geometry lies in the page as base64 text behind the program, in one script element after the other. It stays
// text: a part is decoded when it is asked for, so that a page of 30 MB opens without decoding what nobody looks at,
// and before the browser has read its end. Three bytes are four characters, so a part begins inside the group of four
// at 4 * floor(offset / 3).
const pieces: string[] = [];
const ends: number[] = []; // in the whole text, of the pieces known to be complete

/** True once the browser has read the whole page. */
export function blobLoaded(): boolean {
  return document.readyState !== "loading";
}

// An element may still be growing while it is the last one.
function readPieces(): void {
  const elements = document.getElementsByClassName("antigrasp-blob");
  const complete = blobLoaded() ? elements.length : elements.length - 1;
  while (pieces.length < complete) {
    const piece = (elements[pieces.length].textContent ?? "").trim();
    pieces.push(piece);
    ends.push((ends[ends.length - 1] ?? 0) + piece.length);
  }
}

const groups = ([offset, length]: Part) => [Math.floor(offset / 3), Math.ceil((offset + length) / 3)];

/** False while the browser has not yet read the page as far as this part. */
export function hasArrived(part: Part): boolean {
  if (blobLoaded()) return true;
  readPieces();
  return (ends[ends.length - 1] ?? 0) >= 4 * groups(part)[1];
}

function text(from: number, to: number): string {
  readPieces();
  let found = "";
  for (let i = ends.findIndex((end) => end > from); i >= 0 && i < pieces.length; ++i) {
    const start = ends[i] - pieces[i].length;
    if (start >= to) break;
    found += pieces[i].slice(Math.max(0, from - start), to - start);
  }
  return found;
}

const MOST_GROWTH = 1032; // of a deflated stream

/** The bytes of a part. Throws when the blob is shorter than the part says or holds something else. */
export function bytesOf(part: Part): Uint8Array {
  const [offset, length, size] = part;
  const [first, last] = groups(part);
  const binary = atob(text(4 * first, 4 * last));
  const skip = offset - 3 * first;
  if (binary.length < skip + length || !(size <= MOST_GROWTH * length)) throw new RangeError("geometry is cut short");
  const stream = new Uint8Array(length);
  for (let i = 0; i < length; ++i) stream[i] = binary.charCodeAt(skip + i);
  // One byte more than there should be: a longer stream is cut off there, not refused.
  const bytes = inflateSync(stream, { out: new Uint8Array(size + 1) });
  if (bytes.length !== size) throw new RangeError("geometry is cut short");
  return bytes;
}
