// The panel and the card: they show what is chosen, and say what is asked for.

const $ = (id) => document.getElementById(id);

const PLAY = `<svg viewBox="0 0 24 24"><path class="full" d="M8 5v14l11-7z"/></svg>`;
const PAUSE = `<svg viewBox="0 0 24 24"><path d="M9 6v12M15 6v12"/></svg>`;
const CLOSE = `<svg viewBox="0 0 24 24"><path d="m6 6 12 12M18 6 6 18"/></svg>`;
const NARROW = 760; // pixels; below, the panel is a sheet at the bottom
const PLANNED = "This order was planned, but not every piece was found to go straight in: some may have to wait for others.";
const SCOPES = { all: "All", near: "Neighbours", one: "Alone" };

class Panel {
  constructor(data, ask) {
    this.data = data;
    this.ask = ask;
    const n = data.pieces.length;
    $("summary").textContent = `${n} piece${n === 1 ? "" : "s"}`;
    $("step").max = data.steps.length + 1;
    $("unverified").hidden = data.verified;
    if (data.pieces.some((piece) => piece.axis)) $("unverified").textContent = PLANNED;
    document.querySelector("[value=picture]").closest("label").hidden = !data.mesh.look;
    this.listen();
  }

  listen() {
    const { ask } = this;
    $("search").addEventListener("submit", (event) => {
      event.preventDefault();
      ask.find($("number").value);
    });
    $("explode").addEventListener("input", (event) => ask.explode(Number(event.target.value)));
    $("colours").addEventListener("change", (event) => ask.colour(event.target.value));
    $("numbers").addEventListener("change", (event) => ask.numbers(event.target.checked));
    $("step").addEventListener("input", (event) => ask.step(Number(event.target.value)));
    $("back").addEventListener("click", () => ask.stepBy(-1));
    $("next").addEventListener("click", () => ask.stepBy(1));
    $("play").addEventListener("click", () => ask.play());
    $("home").addEventListener("click", () => ask.home());
    $("theme").addEventListener("click", () => ask.theme());
    $("help").addEventListener("click", () => $("keys").showModal());
    $("fold").addEventListener("click", () => this.fold());
    $("card").addEventListener("click", ({ target }) => {
      const button = target.closest("button");
      if (button) button.dataset.piece ? ask.choose(Number(button.dataset.piece), true) : ask.choose(null);
    });
    $("card").addEventListener("change", ({ target }) => ask.scope(target.value));
  }

  fold(folded = !document.querySelector("aside").classList.contains("folded")) {
    document.querySelector("aside").classList.toggle("folded", folded);
    $("fold").setAttribute("aria-expanded", String(!folded));
  }

  show(state, way) {
    $("explode").value = state.amount;
    $("apart").textContent = `${Math.round(100 * state.amount)} %`;
    document.querySelector(`[name=colour][value=${state.colour}]`).checked = true;
    $("legend").innerHTML = way.legend ?? "";
    $("numbers").checked = state.numbers;
    this.showSteps(state);
    this.showCard(state, way);
  }

  showSteps({ step, playing }) {
    const { steps } = this.data, adds = steps[step - 1];
    $("step").value = step;
    $("step").setAttribute("aria-valuetext", adds ? `step ${step} of ${steps.length}` : "complete");
    $("adds").textContent = adds
      ? `Step ${step} of ${steps.length} adds ${adds.join(", ")}.`
      : `Complete, after ${steps.length} step${steps.length === 1 ? "" : "s"}.`;
    $("back").disabled = step <= 1;
    $("next").disabled = !adds;
    $("play").innerHTML = playing ? PAUSE : PLAY;
    $("play").setAttribute("aria-label", playing ? "Pause" : "Play");
  }

  showCard({ chosen, scope }, way) {
    const card = $("card"), piece = this.data.pieces[chosen - 1];
    if (piece && card.hidden && innerWidth <= NARROW) this.fold(true);
    card.hidden = !piece;
    if (!piece) return;
    const chips = piece.neighbours.map((id) => `<button data-piece="${id}" aria-label="Piece ${id}">${id}</button>`);
    const choices = Object.entries(SCOPES).map(([value, name]) => {
      const checked = value === scope ? "checked" : "";
      return `<label><input type="radio" name="scope" value="${value}" ${checked}><span>${name}</span></label>`;
    });
    const content = `
      <h2><i style="background:${css(new THREE.Color().fromArray(way.tint(piece)))}"></i>Piece ${piece.id}
        <button class="close" aria-label="Let go" title="Let go (Esc)">${CLOSE}</button></h2>
      <dl>${piece.plate ? `<dt>Plate</dt><dd>${piece.plate}</dd>` : ""}
        <dt>Size</dt><dd>${squareMm(piece.area)}</dd>
        <dt>Step</dt><dd>${piece.step}</dd>
        <dt>Touches</dt><dd class="chips">${chips.join("") || "nothing"}</dd></dl>
      <div class="choice" role="radiogroup" aria-label="Show">${choices.join("")}</div>`;
    if (content === this.content) return; // what stays is not read out again
    this.content = content;
    const focus = !card.contains(document.activeElement) ? null : document.activeElement.name ? `[value=${scope}]` : ".close";
    card.innerHTML = content;
    if (focus) card.querySelector(focus).focus();
  }

  miss(text) {
    $("missing").textContent = text;
  }
}
