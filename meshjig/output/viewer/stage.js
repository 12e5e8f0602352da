// The stage: camera, light, drawing on demand, and what lies under a place of the picture.

const TOO_SLOW = 70; // milliseconds for a frame
const CORE = new THREE.Color("#9a9a9a"); // stays in the middle, and is no piece
const LIFT = 0.7; // radii: how far outside a piece begins to go in
const STILL = 160; // milliseconds after which what moved has come to rest; twice that on a slow machine

class Stage {
  constructor(canvas, mesh, data, image) {
    this.canvas = canvas;
    this.data = data;
    this.amount = 0;
    this.onMove = this.onStill = () => {};
    this.byProcessor = drawnByProcessor();
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !this.byProcessor, alpha: true });
    const rows = Math.ceil((data.pieces.length + data.core) / ROW);
    this.tints = table(rows);
    this.moves = table(rows);
    this.slides = table(rows);
    this.lifted = [];
    data.pieces.forEach((piece, k) => this.moves.image.data.set([...piece.way, 1], 4 * k));
    this.uniforms = {
      tints: { value: this.tints },
      moves: { value: this.moves },
      slides: { value: this.slides },
      amount: { value: 0 },
      picture: { value: false },
      pale: { value: new THREE.Color() },
      image: { value: image },
    };
    const look = data.mesh.look === "uv" ? "UV" : data.mesh.look === "rgb" ? "RGB" : null;
    this.material = material(this.uniforms, FRAGMENT, look);
    this.idMaterial = material(this.uniforms, FRAGMENT_IDS, "IDS");
    this.mesh = mesh;
    this.fine = geometryOf(mesh);
    this.model = new THREE.Mesh(this.fine, this.material);
    this.model.frustumCulled = false;
    this.scene = new THREE.Scene();
    this.scene.add(this.model);
    this.camera = new THREE.PerspectiveCamera(26, 1, 1, 10);
    this.camera.up.fromArray(data.up);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { enableDamping: true, dampingFactor: 0.15 });
    this.controls.addEventListener("change", () => this.draw());
    this.resize();
    this.home(false);
  }

  // Draw soon. While something moves, a slow machine draws a rougher model; the true one follows.
  draw(moving = true) {
    this.moving = moving && this.moving !== false;
    this.waiting ??= requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    cancelAnimationFrame(this.waiting);
    const slow = this.moving && this.isSlow;
    this.moving = undefined;
    this.waiting = null;
    this.controls.update();
    this.uniforms.amount.value = this.amount;
    const away = this.camera.position.length();
    const radius = 1.1 * this.data.radius * (1 + this.amount + (this.lifted.length ? LIFT : 0));
    this.camera.near = Math.max(away - radius, radius / 200);
    this.camera.far = away + radius;
    this.camera.updateProjectionMatrix();
    this.model.geometry = slow ? this.rough : this.fine;
    const start = performance.now();
    this.renderer.render(this.scene, this.camera);
    if (this.drawn && this.isSlow === undefined) {
      this.finish();
      this.isSlow = performance.now() - start > TOO_SLOW;
    }
    this.drawn = true;
    this.onMove();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      if (slow) this.draw(false);
      else this.onStill();
    }, slow ? 2 * STILL : STILL);
  }

  get rough() {
    this.roughOne ??= geometryOf({ ...this.mesh, index: roughCorners(this.mesh, this.data.radius / 70) }, this.fine);
    return this.roughOne;
  }

  // One call that waits until the picture is really there.
  finish() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setPixelRatio(this.byProcessor ? 1 : Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    const before = this.distance;
    this.camera.aspect = width / height;
    this.zoom(this.distance / before);
    this.draw(false);
  }

  // How far the eye must be for the whole model to be in the frame.
  get distance() {
    return this.distanceAt(this.amount);
  }

  distanceAt(amount) {
    const wide = this.data.wide + amount * this.data.grown[0], high = this.data.high + amount * this.data.grown[1];
    const slope = Math.tan((this.camera.fov * Math.PI) / 360);
    const far = Math.max((high + 0.3 * wide) / slope, wide / (slope * this.camera.aspect));
    return 1.06 * far + wide;
  }

  home(gently = true) {
    const eye = new THREE.Vector3().fromArray(this.data.eye).setLength(this.distance);
    this.fly(eye, new THREE.Vector3(), gently);
  }

  // Look at a piece from outside.
  face(piece) {
    const way = new THREE.Vector3().fromArray(piece.way);
    const up = new THREE.Vector3().fromArray(this.data.up);
    const steep = way.dot(up) / (way.length() || 1);
    way.addScaledVector(up, -0.5 * steep * way.length());
    if (!way.length()) return;
    this.fly(way.setLength(this.camera.position.distanceTo(this.controls.target)).add(this.controls.target));
  }

  fly(eye, target = this.controls.target, gently = true) {
    const from = this.camera.position.clone(), was = this.controls.target.clone(), to = target.clone();
    const startWay = from.clone().sub(was), endWay = eye.clone().sub(to);
    const radius = [startWay.length() || 1, endWay.length()];
    animate(gently ? 450 : 0, (t) => {
      this.controls.target.lerpVectors(was, to, t);
      const way = startWay.clone().normalize().lerp(endWay.clone().normalize(), t);
      if (way.length() < 0.05) way.add(new THREE.Vector3(0.1, 0.07, 0.13));
      way.setLength(radius[0] + t * (radius[1] - radius[0]));
      this.camera.position.copy(this.controls.target).add(t === 1 ? endWay : way);
      this.draw();
    });
  }

  // Turn about the target by degrees: around the upward axis, and over it.
  orbit(around, over) {
    const way = this.camera.position.clone().sub(this.controls.target);
    const up = this.camera.up, right = up.clone().cross(way).normalize();
    const steep = (way.angleTo(up) * 180) / Math.PI;
    const lift = Math.min(Math.max(over, steep - 178), steep - 2);
    way.applyAxisAngle(right, (-lift * Math.PI) / 180).applyAxisAngle(up, (around * Math.PI) / 180);
    this.camera.position.copy(this.controls.target).add(way);
    this.draw();
  }

  zoom(factor) {
    const way = this.camera.position.clone().sub(this.controls.target);
    this.camera.position.copy(this.controls.target).addScaledVector(way, factor);
    this.draw();
  }

  // The camera backs off as pieces part, so that all stay in the frame.
  explode(amount) {
    const factor = this.distanceAt(amount) / this.distance;
    this.amount = amount;
    this.controls.target.multiplyScalar(factor);
    this.camera.position.multiplyScalar(factor);
    this.draw();
  }

  // Pieces go in one after the other, each along its axis; t goes from 0 to 1.
  slide(pieces, t) {
    const slides = this.slides.image.data, out = LIFT * this.data.radius;
    for (const piece of this.lifted) slides.fill(0, 4 * piece.id - 4, 4 * piece.id);
    pieces.forEach(({ id, axis }, k) => {
      const left = 1 - Math.min(Math.max(t * pieces.length - k, 0), 1);
      slides.set(axis.map((x) => left * out * x), 4 * id - 4);
    });
    this.lifted = t < 1 ? pieces : [];
    this.slides.needsUpdate = true;
    this.draw();
  }

  dress(tintOf, keepOf, coreKeeps, picture, pale) {
    const tints = this.tints.image.data, moves = this.moves.image.data;
    this.data.pieces.forEach((piece, k) => {
      const keep = keepOf(piece);
      tints.set([...tintOf(piece), keep === null ? 0 : 1], 4 * k);
      moves[4 * k + 3] = keep ?? 0;
    });
    for (let k = this.data.pieces.length; k < this.data.pieces.length + this.data.core; k++) {
      tints.set([...CORE.toArray(), coreKeeps === null ? 0 : 1], 4 * k);
      moves[4 * k + 3] = coreKeeps ?? 0;
    }
    this.tints.needsUpdate = this.moves.needsUpdate = true;
    this.uniforms.picture.value = picture;
    this.uniforms.pale.value.set(pale);
    this.draw(false);
  }

  // The number of the piece at each pixel of a small picture, 0 where there is none; rows from below.
  ids(width, height, part) {
    const target = new THREE.WebGLRenderTarget(width, height);
    const size = this.renderer.getSize(new THREE.Vector2());
    if (part) this.camera.setViewOffset(size.x, size.y, part.x, part.y, 1, 1);
    const clear = this.renderer.getClearAlpha();
    this.model.material = this.idMaterial;
    this.model.geometry = this.isSlow && !part ? this.rough : this.fine;
    this.renderer.setRenderTarget(target);
    this.renderer.setClearAlpha(0);
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    const pixels = new Uint8Array(4 * width * height);
    this.renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
    this.renderer.setRenderTarget(null);
    this.renderer.setClearAlpha(clear);
    this.model.material = this.material;
    this.camera.clearViewOffset();
    target.dispose();
    const numbers = new Uint32Array(width * height);
    for (let k = 0; k < numbers.length; k++)
      numbers[k] = pixels[4 * k] + 256 * pixels[4 * k + 1] + 65536 * pixels[4 * k + 2];
    return numbers;
  }

  pieceAt(x, y) {
    const id = this.ids(1, 1, { x, y })[0];
    return id && id <= this.data.pieces.length ? id : null;
  }
}

function table(rows) {
  const texture = new THREE.DataTexture(new Float32Array(4 * ROW * rows), ROW, rows, THREE.RGBAFormat, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
}

function material(uniforms, fragmentShader, define) {
  const defines = { ROW, ...(define && { [define]: 1 }) };
  return new THREE.ShaderMaterial({ uniforms, vertexShader: VERTEX, fragmentShader, defines });
}

function geometryOf({ position, normal, piece, look, index }, like) {
  const geometry = new THREE.BufferGeometry();
  if (like) Object.assign(geometry.attributes, like.attributes);
  else {
    const four = new THREE.InterleavedBuffer(normal, 4);
    geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
    geometry.setAttribute("normal", new THREE.InterleavedBufferAttribute(four, 3, 0, true));
    geometry.setAttribute("piece", new THREE.BufferAttribute(piece, 1));
    if (look instanceof Uint16Array) geometry.setAttribute("look", new THREE.BufferAttribute(look, 2));
    if (look instanceof Uint8Array) geometry.setAttribute("look", new THREE.BufferAttribute(look, 4, true));
  }
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  return geometry;
}

// Without a graphics card, soft edges and fine pixels would cost more than they give.
function drawnByProcessor() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const facts = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = facts ? gl.getParameter(facts.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

const running = {};
const calm = matchMedia("(prefers-reduced-motion: reduce)");

// What moves in the same lane ends what moved there before.
function animate(duration, show, lane = "view") {
  const start = performance.now(), mine = {};
  running[lane] = mine;
  if (!duration || calm.matches) return show(1);
  const tick = (now) => {
    if (running[lane] !== mine) return;
    const t = Math.min(Math.max((now - start) / duration, 0), 1);
    show(t === 1 ? 1 : t * t * (3 - 2 * t));
    if (t < 1) requestAnimationFrame(tick);
  };
  tick(start);
}
