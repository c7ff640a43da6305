import type { Part } from "./report";

// The geometry lies in the page as one long base64 text. It stays text: a part is decoded when it is asked for, so
// that a page of 30 MB opens without decoding what nobody looks at. Three bytes are four characters, so a part
// begins inside the group of four at 4 * floor(offset / 3).
let text: string | null = null;

function source(): string {
  if (text === null) text = (document.getElementById("antigrasp-blob")?.textContent ?? "").trim();
  return text;
}

/** The bytes of a part. Throws when the blob is shorter than the part says. */
export function bytesOf([offset, length]: Part): Uint8Array {
  const first = Math.floor(offset / 3);
  const last = Math.ceil((offset + length) / 3);
  const binary = atob(source().slice(4 * first, 4 * last));
  const skip = offset - 3 * first;
  if (binary.length < skip + length) throw new RangeError("geometry is cut short");
  const bytes = new Uint8Array(length);
  for (let i = 0; i < length; ++i) bytes[i] = binary.charCodeAt(skip + i);
  return bytes;
}
