// What colour a piece has in each way of colouring, in linear light.

const VIRIDIS = ["#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"].map((hex) => new THREE.Color(hex));

function ramp(t) {
  const x = Math.min(Math.max(t, 0), 1) * (VIRIDIS.length - 1), k = Math.min(Math.floor(x), VIRIDIS.length - 2);
  return VIRIDIS[k].clone().lerp(VIRIDIS[k + 1], x - k);
}

function colouring(pieces, valueOf) {
  const values = pieces.map(valueOf), low = Math.min(...values), high = Math.max(...values);
  const share = (value) => (high > low ? (value - low) / (high - low) : 0.5);
  return { low, high, values, colour: (value) => ramp(share(value)) };
}

function colourWays(data) {
  const own = data.pieces.map((piece) => new THREE.Color(piece.colour).toArray());
  const size = colouring(data.pieces, (piece) => piece.area);
  const degree = colouring(data.pieces, (piece) => piece.neighbours.length);
  return {
    piece: { tint: (piece) => own[piece.id - 1] },
    picture: { tint: (piece) => own[piece.id - 1] },
    size: { tint: (piece) => size.colour(piece.area).toArray(), legend: gradientLegend(size) },
    neighbours: { tint: (piece) => degree.colour(piece.neighbours.length).toArray(), legend: countLegend(degree) },
  };
}

function css(colour) {
  return "#" + colour.getHexString();
}

function gradientLegend({ low, high }) {
  const stops = VIRIDIS.map(css).join(",");
  return `<i class="gradient" style="background:linear-gradient(90deg,${stops})"></i>
    <span>${squareMm(low)}</span><span>${squareMm(high)}</span>`;
}

function countLegend({ values, colour }) {
  const counts = [...new Set(values)].sort((a, b) => a - b);
  return counts
    .map((n) => `<span class="swatch"><i style="background:${css(colour(n))}"></i>${n}</span>`)
    .join("");
}

function squareMm(area) {
  return area >= 1000 ? `${(area / 100).toFixed(1)} cm²` : `${Math.round(area)} mm²`;
}
