// Unpack the bytes of viewer_mesh.py into arrays that three.js draws from.

async function unpackMesh(text, facts) {
  const letters = atob(text), packed = new Uint8Array(letters.length);
  for (let k = 0; k < packed.length; k++) packed[k] = letters.charCodeAt(k);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const n = facts.vertices.reduce((a, b) => a + b, 0);
  const m = 3 * facts.faces.reduce((a, b) => a + b, 0);
  const position = positions(bytes, n, facts);
  const index = corners(bytes, 6 * n, m, facts.index);
  return {
    position,
    index,
    normal: normals(position, index),
    piece: ownerOfVertices(index, facts.faces, n),
    look: facts.look ? looks(bytes.subarray(6 * n + facts.index * m), n, facts.look) : null,
  };
}

// Each axis is a run of low bytes of the differences to the vertex before; high bytes follow all three.
function positions(bytes, n, { step, low }) {
  const position = new Float32Array(3 * n);
  for (let axis = 0; axis < 3; axis++) {
    for (let i = 0, at = axis * n, grid = 0; i < n; i++, at++) {
      grid = (grid + bytes[at] + 256 * bytes[at + 3 * n]) & 65535;
      position[3 * i + axis] = low[axis] + step * grid;
    }
  }
  return position;
}

function corners(bytes, start, m, width) {
  const index = new Uint32Array(m);
  for (let k = 0, fresh = 0; k < m; k++) {
    let ago = 0;
    for (let b = width - 1, at = start + b * m + k; b >= 0; b--, at -= m) ago = 256 * ago + bytes[at];
    index[k] = fresh - ago;
    if (ago === 0) fresh++;
  }
  return index;
}

function normals(position, index) {
  const sum = new Float32Array(position.length);
  for (let k = 0; k < index.length; k += 3) {
    const a = 3 * index[k], b = 3 * index[k + 1], c = 3 * index[k + 2];
    const ux = position[b] - position[a], uy = position[b + 1] - position[a + 1], uz = position[b + 2] - position[a + 2];
    const vx = position[c] - position[a], vy = position[c + 1] - position[a + 1], vz = position[c + 2] - position[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    sum[a] += x, sum[a + 1] += y, sum[a + 2] += z;
    sum[b] += x, sum[b + 1] += y, sum[b + 2] += z;
    sum[c] += x, sum[c + 1] += y, sum[c + 2] += z;
  }
  const normal = new Int8Array((sum.length / 3) * 4);
  for (let i = 0, at = 0; at < sum.length; i += 4, at += 3) {
    const scale = 127 / (Math.sqrt(sum[at] ** 2 + sum[at + 1] ** 2 + sum[at + 2] ** 2) || 1);
    for (let axis = 0; axis < 3; axis++) normal[i + axis] = scale * sum[at + axis];
  }
  return normal;
}

function ownerOfVertices(index, faces, n) {
  const piece = new Float32Array(n);
  let k = 0;
  faces.forEach((count, owner) => {
    for (const end = k + 3 * count; k < end; k++) piece[index[k]] = owner;
  });
  return piece;
}

function looks(bytes, n, kind) {
  if (kind === "uv") {
    const uv = new Uint16Array(2 * n);
    for (let i = 0; i < n; i++) {
      uv[2 * i] = bytes[i] + 256 * bytes[2 * n + i];
      uv[2 * i + 1] = bytes[n + i] + 256 * bytes[3 * n + i];
    }
    return uv;
  }
  const rgba = new Uint8Array(4 * n);
  for (let i = 0; i < n; i++) for (let k = 0; k < 4; k++) rgba[4 * i + k] = bytes[k * n + i];
  return rgba;
}

// A coarser set of faces over the same vertices: those that survive when all vertices of a piece that lie in
// one cell of a grid, and face much the same way, become one.
function roughCorners({ position, normal, piece, index }, cell) {
  const stand = new Uint32Array(piece.length), first = new Map();
  for (let i = 0; i < stand.length; i++) {
    const at = 3 * i, [nx, ny, nz] = [normal[4 * i], normal[4 * i + 1], normal[4 * i + 2]];
    const ax = Math.abs(nx), ay = Math.abs(ny), az = Math.abs(nz);
    const side = ax >= ay && ax >= az ? (nx > 0 ? 0 : 1) : ay >= az ? (ny > 0 ? 2 : 3) : nz > 0 ? 4 : 5;
    let key = 6 * piece[i] + side;
    for (let axis = 0; axis < 3; axis++) key = 512 * key + 256 + Math.floor(position[at + axis] / cell);
    const one = first.get(key);
    if (one === undefined) first.set(key, i);
    stand[i] = one ?? i;
  }
  const rough = new Uint32Array(index.length);
  let kept = 0;
  for (let k = 0; k < index.length; k += 3) {
    const a = stand[index[k]], b = stand[index[k + 1]], c = stand[index[k + 2]];
    if (a === b || b === c || c === a) continue;
    rough[kept++] = a, rough[kept++] = b, rough[kept++] = c;
  }
  return rough.slice(0, kept);
}
