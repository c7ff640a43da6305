// What a three.js geometry of outward triangles encloses.
export function volumeOf(geometry) {
  const at = geometry.getAttribute("position");
  const corner = (i) => [at.getX(i), at.getY(i), at.getZ(i)];
  let volume = 0;
  for (let i = 0; i < (geometry.index ?? at).count; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => corner(geometry.index ? geometry.index.getX(i + k) : i + k));
    volume +=
      (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
      6;
  }
  return volume;
}
