// Everything together: one state, the ways to change it, and the keys.

const FIRST = 700, MORE = 400; // milliseconds in which the first piece of a step goes in, and each after it

const slideTime = (pieces) => pieces.length && FIRST + MORE * (pieces.length - 1);

class Viewer {
  constructor(stage, data) {
    Object.assign(this, { stage, data });
    this.state = { amount: 0, colour: data.mesh.look ? "picture" : "piece", numbers: false, chosen: null, scope: "all", step: data.steps.length + 1, playing: null, core: true };
    data.steps.forEach((ids, k) => ids.forEach((id) => (data.pieces[id - 1].step = k + 1)));
    this.ways = colourWays(data);
    this.labels = new Labels($("labels"), stage);
    this.labels.wanted = (piece) => this.labelOf(piece);
    this.panel = new Panel(data, this);
    this.refresh();
  }

  set(change) {
    Object.assign(this.state, change);
    this.refresh();
  }

  refresh() {
    const way = this.ways[this.state.colour];
    const pale = getComputedStyle(document.documentElement).getPropertyValue("--pale").trim();
    this.stage.dress(way.tint, (piece) => this.keepOf(piece), this.coreKeeps, this.state.colour === "picture", pale);
    this.panel.show(this.state, way);
  }

  // How much of its colour a piece keeps; null hides it.
  keepOf(piece) {
    const { chosen, scope, step } = this.state;
    const complete = step > this.data.steps.length;
    if (!complete && piece.step > step) return null;
    if (!chosen) return complete || piece.step === step ? 1 : 0.3;
    if (piece.id === chosen) return 1;
    const near = piece.neighbours.includes(chosen);
    if (scope === "one" || (scope === "near" && !near)) return null;
    return near ? 0.6 : 0.18;
  }

  get coreKeeps() {
    const { core, chosen, scope } = this.state;
    if (!core || scope !== "all") return null;
    return chosen ? 0.18 : 1;
  }

  labelOf(piece) {
    const { chosen, step, numbers } = this.state;
    if (piece.id === chosen) return "chosen";
    if (chosen && piece.neighbours.includes(chosen)) return "near";
    if (!chosen && piece.step === step) return "new";
    return numbers && "plain";
  }

  choose(id, turn = false) {
    const piece = this.data.pieces[id - 1];
    const hidden = piece && piece.step > this.state.step;
    this.set({ chosen: id, ...(!id && { scope: "all" }), ...(hidden && { step: this.data.steps.length + 1 }) });
    if (id) this.panel.miss("");
    if (piece && turn) this.stage.face(piece);
  }

  chooseBy(by) {
    const n = this.data.pieces.length, { chosen } = this.state;
    this.choose(chosen ? ((chosen - 1 + by + n) % n) + 1 : by > 0 ? 1 : n, true);
  }

  find(text) {
    const digits = text.match(/\d+/), id = digits ? Number(digits[0]) : 0, n = this.data.pieces.length;
    if (id < 1 || id > n) return this.panel.miss(`There is no piece ${text.trim() || "without a number"}: they go from 1 to ${n}.`);
    this.choose(id, true);
  }

  explode(amount) {
    this.state.amount = amount;
    this.stage.explode(amount);
    this.panel.show(this.state, this.ways[this.state.colour]);
  }

  explodeTo(goal) {
    const from = this.state.amount;
    animate(600, (t) => this.explode(from + t * (goal - from)));
  }

  colour(colour) {
    this.set({ colour });
  }

  nextColour() {
    const ways = Object.keys(this.ways).filter((way) => way !== "picture" || this.data.mesh.look);
    this.colour(ways[(ways.indexOf(this.state.colour) + 1) % ways.length]);
  }

  numbers(numbers) {
    this.set({ numbers });
  }

  scope(scope) {
    if (this.state.chosen) this.set({ scope });
  }

  nextScope() {
    const scopes = Object.keys(SCOPES);
    this.scope(scopes[(scopes.indexOf(this.state.scope) + 1) % scopes.length]);
  }

  step(step) {
    const last = this.data.steps.length + 1, before = this.state.step;
    this.set({ step: Math.min(Math.max(step, 1), last), chosen: null, scope: "all" });
    this.goIn(this.state.step > before || (step === 1 && before === last));
  }

  // The pieces of a step slide in, where there is a plan of how.
  goIn(forward) {
    const ids = forward ? this.data.steps[this.state.step - 1] ?? [] : [];
    const pieces = ids.map((id) => this.data.pieces[id - 1]).filter((piece) => piece.axis);
    animate(slideTime(pieces), (t) => this.stage.slide(pieces, t), "slide");
  }

  stepBy(by) {
    this.step(this.state.step + by);
  }

  play() {
    const last = this.data.steps.length + 1;
    if (this.state.playing) return this.pause();
    if (this.state.step >= last) this.step(1);
    const next = () => {
      this.stepBy(1);
      if (this.state.step >= last) this.pause();
      else this.state.playing = setTimeout(next, wait());
    };
    const wait = () => 400 + Math.max(FIRST, slideTime(this.data.steps[this.state.step - 1]));
    this.set({ playing: setTimeout(next, wait()) });
  }

  pause() {
    clearTimeout(this.state.playing);
    this.set({ playing: null });
  }

  home() {
    this.stage.home();
  }

  theme(dark = !document.documentElement.classList.contains("dark")) {
    document.documentElement.classList.toggle("dark", dark);
    this.refresh();
  }

  key(event) {
    const { target, key } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || $("keys").open) return;
    if (target.matches?.("input") && (target.id === "number" || key.startsWith("Arrow")) && key !== "Escape") return;
    const { amount, chosen } = this.state, { stage } = this;
    const act = {
      ArrowLeft: () => stage.orbit(-8, 0), ArrowRight: () => stage.orbit(8, 0),
      ArrowUp: () => stage.orbit(0, 8), ArrowDown: () => stage.orbit(0, -8),
      "+": () => stage.zoom(0.88), "=": () => stage.zoom(0.88), "-": () => stage.zoom(1 / 0.88),
      "[": () => this.chooseBy(-1), "]": () => this.chooseBy(1),
      "/": () => { $("number").focus(); $("number").select(); },
      f: () => chosen && stage.face(this.data.pieces[chosen - 1]),
      h: () => this.nextScope(),
      Escape: () => { this.choose(null); this.panel.miss(""); stage.canvas.focus(); },
      e: () => this.explodeTo(amount > 0.05 ? 0 : 0.6),
      "<": () => this.explode(Math.max(amount - 0.1, 0)), ">": () => this.explode(Math.min(amount + 0.1, 1.5)),
      c: () => this.nextColour(), n: () => this.numbers(!this.state.numbers),
      k: () => this.set({ core: !this.state.core }),
      ",": () => this.stepBy(-1), ".": () => this.stepBy(1), p: () => this.play(),
      0: () => this.home(), t: () => this.theme(), "?": () => $("keys").showModal(),
    }[key.length === 1 ? key.toLowerCase() : key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}

function listenToCanvas(viewer, canvas) {
  let down = null;
  canvas.addEventListener("pointerdown", (event) => {
    down = event.isPrimary ? { x: event.clientX, y: event.clientY } : null;
  });
  canvas.addEventListener("pointerup", (event) => {
    const still = down && Math.hypot(event.clientX - down.x, event.clientY - down.y) < 6;
    down = null;
    if (!still || event.button !== 0) return;
    const box = canvas.getBoundingClientRect();
    viewer.choose(viewer.stage.pieceAt(event.clientX - box.left, event.clientY - box.top));
  });
}

async function pictureOf(source) {
  if (!source) return null;
  const image = new Image();
  image.src = source;
  await image.decode();
  const texture = new THREE.Texture(image);
  Object.assign(texture, { colorSpace: THREE.SRGBColorSpace, needsUpdate: true });
  return texture;
}

async function start() {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  document.documentElement.classList.toggle("dark", dark.matches);
  const data = JSON.parse($("data").textContent);
  const [mesh, image] = await Promise.all([unpackMesh($("mesh").textContent, data.mesh), pictureOf(data.picture)]);
  const canvas = $("view"), stage = new Stage(canvas, mesh, data, image);
  const viewer = (window.viewer = new Viewer(stage, data));
  viewer.panel.fold(innerWidth <= NARROW);
  $("message").textContent = "";
  new ResizeObserver(() => stage.resize()).observe(canvas.parentElement);
  dark.addEventListener("change", () => viewer.theme(dark.matches));
  document.addEventListener("keydown", (event) => viewer.key(event));
  listenToCanvas(viewer, canvas);
  stage.drawNow();
  stage.finish();
  document.documentElement.dataset.readyAfter = Math.round(performance.now());
}

start().catch((error) => {
  const old = !window.DecompressionStream || !window.WebGL2RenderingContext;
  $("message").textContent = old
    ? "This browser is too old to show the puzzle: it needs WebGL 2 and DecompressionStream."
    : `The puzzle can't be shown here (${error.message}). Is 3D drawing (WebGL) switched on?`;
  console.error(error);
});
