// Numbers on the pieces: placed on what can be seen of each, once the picture stands still.

class Labels {
  constructor(layer, stage) {
    this.layer = layer;
    this.stage = stage;
    this.wanted = () => false;
    stage.onMove = () => layer.classList.add("moving");
    stage.onStill = () => this.place();
  }

  place() {
    const pieces = this.stage.data.pieces.filter((piece) => this.wanted(piece));
    const seen = pieces.length ? this.places() : new Map();
    const box = this.layer.getBoundingClientRect();
    const marks = pieces.filter((piece) => seen.has(piece.id)).map((piece) => {
      const { x, y, n } = seen.get(piece.id), kind = this.wanted(piece);
      return { id: piece.id, kind, n, x: x * box.width, y: y * box.height };
    });
    this.layer.replaceChildren(...withRoom(marks).map(drawn));
    this.layer.classList.remove("moving");
  }

  // For each piece in sight, the visible place that is nearest to the middle of what is visible.
  places() {
    const height = 240, width = Math.max(1, Math.round(height * this.stage.camera.aspect));
    const ids = this.stage.ids(width, height);
    const seen = new Map();
    ids.forEach((id, k) => {
      if (!id) return;
      const sum = seen.get(id) ?? { n: 0, x: 0, y: 0, best: Infinity };
      seen.set(id, sum);
      sum.n++;
      sum.x += k % width;
      sum.y += Math.floor(k / width);
    });
    const places = new Map();
    ids.forEach((id, k) => {
      const sum = seen.get(id);
      if (!id || sum.n < 6) return;
      const x = k % width, y = Math.floor(k / width);
      const off = (x - sum.x / sum.n) ** 2 + (y - sum.y / sum.n) ** 2;
      if (off >= sum.best) return;
      sum.best = off;
      places.set(id, { n: sum.n, x: (x + 0.5) / width, y: 1 - (y + 0.5) / height });
    });
    return places;
  }
}

const RANKS = ["chosen", "near", "new", "plain"]; // a number that matters more takes the room

function withRoom(marks) {
  const kept = [];
  const rank = ({ kind }) => RANKS.indexOf(kind);
  for (const mark of marks.sort((a, b) => rank(a) - rank(b) || b.n - a.n)) {
    const wide = mark.kind === "plain" ? 28 : 34, high = mark.kind === "plain" ? 17 : 22;
    if (kept.every((one) => Math.abs(one.x - mark.x) > wide || Math.abs(one.y - mark.y) > high)) kept.push(mark);
  }
  return kept;
}

function drawn({ id, kind, x, y }) {
  const mark = document.createElement("span");
  mark.textContent = id;
  mark.className = kind;
  mark.style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
  return mark;
}
