// A cloud in three dimensions with planes, boxes, machine and stop, drawn by three.js on the canvas that it is given.
// All is in base, in metres, +Z up. A tint is a name of the page's colours (report.css). It draws when something changed
// and can be seen, and never else.
//
//   const scene = new Scene3D(canvas, { on_change: () => { ... } });  // when fault or is_awake changed
//   scene.fault                          // null, or why nothing is drawn: 'no_library', 'no_webgl', 'lost'
//   scene.set_cloud(xyz, labels, shown)  // Float32Array of 3 n, Uint8Array of n (place in LAYERS), one boolean a layer
//   scene.set_old(is_old)                // the cloud is not of now: pale, in one colour
//   scene.set_planes([{ corners, tint, is_pale, grid_m }])   // four corners in turn; grid_m: lines so far apart
//   scene.set_region([{ corners, tint }])                    // what of the planes was measured
//   scene.set_boxes([[x0, x1, y0, y1, z0, z1]], { editable, on_edit })  // on_edit(index, box, is_done) while a face moves
//   scene.set_machine({ corners, ahead, sensor, lines: [{ from, to, tint, is_dashed }] })  // outline and way ahead; or null
//   scene.set_sweep({ patches: [{ corners, tint }], nearest })          // of the obstacle stop; or null
//   scene.look_from('behind' | 'left' | 'above')
//   scene.draw()                         // soon, if it can be seen
//   scene.png()                          // a picture of now, as a data: address; '' where there is none
//
// One finger scrolls the page over the view until the view is tapped; then it turns the view until the page is tapped
// elsewhere. Two fingers turn and zoom at any time. A finger on the handle of a box moves that face at any time.

const kHandle_px = 16, kCatch_px = 14, kCatchFinger_px = 26, kTap_px = 8;
const kBoxLeast_m = 0.05, kStep_m = 0.01;
// Within so much of the view's direction a normal looks too short to be dragged along: the square of the sine.
const kFacing = 0.02;

// How much is left of points that are not of now.
const OLD_ALPHA = 0.45;

// Of a point: size in pixels at a metre, its bounds, colours and which layers are shown.
const POINT_SHADER = {
  vertexShader: `
    attribute float label;
    uniform vec3 tints[5];
    uniform float shown[5];
    uniform vec3 size;
    uniform vec3 old_tint;
    uniform float is_old;
    varying vec3 tint;
    void main() {
      int layer = int(label + 0.5);
      vec4 seen = modelViewMatrix * vec4(position, 1.0);
      gl_Position = shown[layer] > 0.5 ? projectionMatrix * seen : vec4(2.0, 2.0, 2.0, 1.0);
      gl_PointSize = clamp(size.x / max(0.1, -seen.z), size.y, size.z);
      tint = mix(tints[layer], old_tint, is_old);
    }`,
  fragmentShader: `
    varying vec3 tint;
    void main() {
      vec2 off = gl_PointCoord - 0.5;
      if (dot(off, off) > 0.25) discard;
      gl_FragColor = vec4(tint, 1.0);
    }`,
};

class Scene3D {
  constructor(canvas, { on_change = () => {} } = {}) {
    Object.assign(this, { canvas, on_change, fault: null, is_awake: false, drawn: 0 });
    Object.assign(this, { boxes: [], editable: false, on_edit: () => {}, drag: null, hovered: -1, ahead: null, is_placed: false });
    this.parts = { planes: [], region: [], boxes: [], machine: [], sweep: [] };
    this.is_seen = this.is_asked = this.are_shapes_old = false;
    this.fault = this.open();
    if (this.fault) return;
    this.listen();
    this.watch();
  }

  // Asks for the context itself: three.js would complain to the log where there is none.
  open() {
    if (typeof THREE === 'undefined') return 'no_library';
    const context = this.canvas.getContext('webgl2', { antialias: true, alpha: false, powerPreference: 'low-power' });
    if (!context) return 'no_webgl';
    THREE.ColorManagement.enabled = false;  // colours are those of the page, as they are
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, context });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(50, 1, 0.05, 400);
    this.camera.up.set(0, 0, 1);
    this.cloud = this.add_points([3, 1.5, 6]);
    this.handles = this.add_points([0, kHandle_px, kHandle_px]);
    this.handles.material.depthTest = false;
    this.handles.renderOrder = 3;
    const usual = { vertexColors: true, transparent: true, depthWrite: false };
    this.patches = this.add(new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({ ...usual, side: THREE.DoubleSide })), 1);
    this.strokes = this.add(new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial(usual)), 2);
    return null;
  }

  add(thing, order) {
    thing.frustumCulled = false;
    thing.renderOrder = order;
    this.scene.add(thing);
    return thing;
  }

  add_points(size) {
    const uniforms = { tints: { value: LAYERS.map(() => new THREE.Color()) }, shown: { value: LAYERS.map(() => 1) }, size: { value: new THREE.Vector3(...size) },
      old_tint: { value: new THREE.Color() }, is_old: { value: 0 } };
    const points = new THREE.Points(new THREE.BufferGeometry(), new THREE.ShaderMaterial({ ...POINT_SHADER, uniforms }));
    points.size = size;
    fill_points(points.geometry, new Float32Array(0), new Uint8Array(0));
    return this.add(points, 0);
  }

  // ---- What is shown

  set_cloud(xyz, labels, shown) {
    if (!this.renderer) return;
    fill_points(this.cloud.geometry, xyz, labels);
    this.cloud.material.uniforms.shown.value = LAYERS.map((_, k) => (shown[k] ? 1 : 0));
    this.draw();
  }

  set_planes(planes) {
    this.set_part('planes', planes.flatMap(({ corners, tint, is_pale, grid_m }) => [
      { corners, tint, alpha: is_pale ? 0.05 : 0.12 },
      ...(grid_m ? grid_lines(corners, grid_m).map((line) => ({ line, tint: 'faint', alpha: 0.25 })) : [])]));
  }

  set_old(is_old) {
    if (this.fault || this.cloud.material.uniforms.is_old.value === Number(is_old)) return;
    this.cloud.material.uniforms.is_old.value = Number(is_old);
    this.draw();
  }

  set_region(regions) {
    this.set_part('region', regions.flatMap(({ corners, tint }) => [{ corners, tint, alpha: 0.16 }, { line: closed(corners), tint, alpha: 1 }]));
  }

  set_boxes(boxes, { editable = false, on_edit = () => {} } = {}) {
    if (this.drag) return;  // who drags knows better than who tells
    Object.assign(this, { boxes: boxes.map((box) => box.slice()), editable, on_edit });
    this.place_boxes();
  }

  set_machine(machine) {
    const shapes = [];
    if (machine) {
      const { corners, ahead, sensor, lines = [] } = machine, nose = middle(corners[0], corners[1]);
      this.ahead = ahead;
      shapes.push({ corners, tint: 'machine', alpha: 0.35 }, { line: closed(corners), tint: 'machine', alpha: 1 });
      shapes.push(...arrow(nose, ahead, 2).map((line) => ({ line, tint: 'machine', alpha: 1 })));
      if (sensor) shapes.push(...cross(sensor, 0.15).map((line) => ({ line, tint: 'ink', alpha: 1 })));
      for (const { from, to, tint, is_dashed } of lines) shapes.push(...(is_dashed ? dashes(from, to) : [[from, to]]).map((line) => ({ line, tint, alpha: 1 })));
    }
    this.set_part('machine', shapes);
    if (machine && !this.is_placed) this.look_from('behind');
  }

  set_sweep(sweep) {
    const shapes = [];
    if (sweep) {
      for (const { corners, tint } of sweep.patches) shapes.push({ corners, tint, alpha: 0.14 }, { line: closed(corners), tint, alpha: 0.9 });
      if (sweep.nearest) shapes.push(...cross(sweep.nearest, 0.3).map((line) => ({ line, tint: 'invalid', alpha: 1 })));
    }
    this.set_part('sweep', shapes);
  }

  set_part(name, shapes) {
    this.parts[name] = shapes;
    this.are_shapes_old = true;
    this.draw();
  }

  place_boxes() {
    const corners = (box) => Array.from({ length: 8 }, (_, k) => [box[k & 1], box[2 + (k >> 1 & 1)], box[4 + (k >> 2 & 1)]]);
    const edges = (points) => points.flatMap((p, k) => [1, 2, 4].filter((bit) => !(k & bit)).map((bit) => [p, points[k | bit]]));
    const held = this.drag ? this.drag.handle : this.hovered;
    this.set_part('boxes', this.boxes.flatMap((box, b) => [
      ...edges(corners(box)).map((line) => ({ line, tint: 'dropped', alpha: 1 })),
      ...(this.editable ? [0, 1, 2, 3, 4, 5].map((face) => ({ corners: face_corners(box, face), tint: 'dropped', alpha: held === 6 * b + face ? 0.4 : 0.07 })) : [])]));
    if (!this.renderer) return;
    const places = this.handle_places();
    fill_points(this.handles.geometry, new Float32Array(places.flat()), new Uint8Array(places.map((_, k) => (k === held ? 1 : 0))));
  }

  // Six of a box: the middles of its faces, from the least x to the greatest z.
  handle_places() { return this.editable ? this.boxes.flatMap((box) => [0, 1, 2, 3, 4, 5].map((face) => face_middle(box, face))) : []; }

  // ---- Looking

  look_from(side) {
    if (!this.renderer) return;
    const [ax, ay] = this.ahead || [1, 0], far = { behind: [-9, 0, 5], left: [1, 12, 2.5], above: [0.99, 0, 15] }[side];
    const target = [ax, ay, 0];
    this.controls.target.set(...target);
    this.camera.position.set(ax * far[0] - ay * far[1], ay * far[0] + ax * far[1], far[2]);
    this.is_placed = true;
    this.controls.update();
    this.draw();
  }

  draw() {
    if (this.fault || this.is_asked || !this.is_seen || document.hidden) return;
    this.is_asked = true;
    requestAnimationFrame(() => { this.is_asked = false; this.render(); });
  }

  render() {
    if (this.fault || !this.canvas.clientWidth) return;
    const scale = Math.min(2, window.devicePixelRatio || 1), { clientWidth: width, clientHeight: height } = this.canvas;
    if (this.canvas.width !== Math.floor(width * scale) || this.canvas.height !== Math.floor(height * scale)) {
      this.renderer.setPixelRatio(scale);
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
    }
    this.take_colours(scale, height);
    if (this.are_shapes_old) this.build_shapes();
    this.renderer.render(this.scene, this.camera);
    ++this.drawn;
  }

  take_colours(scale, height) {
    const theme = document.documentElement.dataset.theme;
    this.cloud.material.uniforms.size.value.set(this.cloud.size[0] * scale * height / 100, this.cloud.size[1] * scale, this.cloud.size[2] * scale);
    this.handles.material.uniforms.size.value.set(0, kHandle_px * scale, kHandle_px * scale);
    if (this.theme === theme) return;
    this.theme = theme;
    this.are_shapes_old = true;
    this.scene.background = new THREE.Color(colour('panel'));
    this.cloud.material.uniforms.old_tint.value.set(colour('panel')).lerp(new THREE.Color(colour('other')), OLD_ALPHA);
    LAYERS.forEach((name, k) => this.cloud.material.uniforms.tints.value[k].set(colour(name)));
    ['dropped', 'machine'].forEach((name, k) => this.handles.material.uniforms.tints.value[k].set(colour(name)));
  }

  build_shapes() {
    const tints = new Map(), patches = { places: [], colours: [] }, strokes = { places: [], colours: [] };
    const tint_of = (name) => {
      if (!tints.has(name)) tints.set(name, new THREE.Color(colour(name)).toArray());
      return tints.get(name);
    };
    const put = (into, point, { tint, alpha }) => { into.places.push(...point); into.colours.push(...tint_of(tint), alpha); };
    for (const shape of Object.values(this.parts).flat()) {
      if (shape.corners) for (const k of [0, 1, 2, 0, 2, 3]) put(patches, shape.corners[k], shape);
      else for (let k = 1; k < shape.line.length; ++k) { put(strokes, shape.line[k - 1], shape); put(strokes, shape.line[k], shape); }
    }
    fill_shapes(this.patches.geometry, patches);
    fill_shapes(this.strokes.geometry, strokes);
    this.are_shapes_old = false;
  }

  png() {
    if (this.fault) return '';
    this.render();
    return this.canvas.toDataURL('image/png');
  }

  // ---- Mouse and fingers

  listen() {
    const { canvas } = this;
    // Before those of OrbitControls: a handle is caught first.
    canvas.addEventListener('pointerdown', (event) => this.begin_drag(event));
    canvas.addEventListener('pointermove', (event) => this.go_on(event));
    for (const kind of ['pointerup', 'pointercancel']) canvas.addEventListener(kind, (event) => this.end_drag(event));
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { maxDistance: 120, minDistance: 0.5, zoomSpeed: 1.4 });
    this.controls.addEventListener('change', () => this.draw());
    this.wake(false);
    const keep_page = (event) => {
      const touch = event.touches[0], box = canvas.getBoundingClientRect();
      const is_on_handle = event.touches.length === 1 && this.handle_at(touch.clientX - box.left, touch.clientY - box.top, kCatchFinger_px) >= 0;
      if (event.cancelable && (event.touches.length === 2 || is_on_handle || this.drag)) event.preventDefault();
    };
    for (const kind of ['touchstart', 'touchmove']) canvas.addEventListener(kind, keep_page, { passive: false });
    this.listen_for_taps();
  }

  listen_for_taps() {
    let down = null;
    document.addEventListener('pointerdown', (event) => {
      down = event.target === this.canvas && event.isPrimary && event.pointerType === 'touch' ? [event.clientX, event.clientY] : null;
      if (event.target !== this.canvas && this.is_awake) this.wake(false);
    });
    document.addEventListener('pointerup', (event) => {
      if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > kTap_px) return;
      if (!this.is_awake) this.wake(true);
    });
  }

  // Awake, the view takes every finger.
  wake(is_awake) {
    const is_news = this.is_awake !== is_awake;
    this.is_awake = is_awake;
    this.canvas.style.touchAction = is_awake ? 'none' : 'pan-x pan-y';
    this.controls.touches = is_awake ? { ONE: THREE.TOUCH.ROTATE, TWO: THREE.TOUCH.DOLLY_PAN } : { ONE: -1, TWO: THREE.TOUCH.DOLLY_ROTATE };
    if (is_news) this.on_change();
  }

  watch() {
    new IntersectionObserver((seen) => { this.is_seen = seen[seen.length - 1].isIntersecting; this.draw(); }).observe(this.canvas);
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    document.addEventListener('visibilitychange', () => this.draw());
    new MutationObserver(() => this.draw()).observe(document.documentElement, { attributeFilter: ['data-theme'] });
    this.canvas.addEventListener('webglcontextlost', (event) => { event.preventDefault(); this.fault = 'lost'; this.on_change(); });
    this.canvas.addEventListener('webglcontextrestored', () => { this.fault = null; this.theme = undefined; this.on_change(); this.draw(); });
  }

  // ---- Handles

  // A place of base on the canvas, in pixels; null behind the camera.
  place_of(point) {
    this.camera.updateMatrixWorld();  // it may have moved since the last picture
    const seen = new THREE.Vector3(...point).project(this.camera);
    return seen.z > 1 ? null : [(seen.x + 1) / 2 * this.canvas.clientWidth, (1 - seen.y) / 2 * this.canvas.clientHeight];
  }

  // The handle at a place of the canvas: 6 times the box, and the face; or -1.
  handle_at(x, y, within_px) {
    let best = -1, least = within_px;
    this.handle_places().forEach((point, k) => {
      const place = this.place_of(point), away = place ? Math.hypot(place[0] - x, place[1] - y) : Infinity;
      if (away < least) [best, least] = [k, away];
    });
    return best;
  }

  begin_drag(event) {
    if (event.button !== 0 || !event.isPrimary || !this.editable) return;
    const handle = this.handle_at(event.offsetX, event.offsetY, event.pointerType === 'touch' ? kCatchFinger_px : kCatch_px);
    if (handle < 0) return;
    const box = this.boxes[Math.floor(handle / 6)], face = handle % 6, middle_m = face_middle(box, face);
    const began_m = this.along(middle_m, face >> 1, event);
    if (began_m === null) return;
    event.stopImmediatePropagation();
    this.drag = { handle, face, middle_m, began_m, at_m: box[face], pointer: event.pointerId };
    this.controls.enabled = false;
    this.canvas.setPointerCapture(event.pointerId);
    this.place_boxes();
  }

  go_on(event) {
    if (!this.drag) return this.hover(event);
    if (event.pointerId !== this.drag.pointer) return undefined;
    const { handle, face, middle_m, began_m, at_m } = this.drag, now_m = this.along(middle_m, face >> 1, event);
    if (now_m === null) return undefined;
    const index = Math.floor(handle / 6), box = this.boxes[index];
    const to_m = Math.round((at_m + now_m - began_m) / kStep_m) * kStep_m;
    box[face] = Number((face & 1 ? Math.max(to_m, box[face - 1] + kBoxLeast_m) : Math.min(to_m, box[face + 1] - kBoxLeast_m)).toFixed(3));
    this.place_boxes();
    return this.on_edit(index, box.slice(), false);
  }

  end_drag(event) {
    if (!this.drag || event.pointerId !== this.drag.pointer) return;
    const index = Math.floor(this.drag.handle / 6);
    this.drag = null;
    this.hovered = -1;
    this.controls.enabled = true;
    this.place_boxes();
    this.on_edit(index, this.boxes[index].slice(), true);
  }

  hover(event) {
    if (!this.editable || event.pointerType === 'touch' || event.buttons) return;
    const handle = this.handle_at(event.offsetX, event.offsetY, kCatch_px);
    if (handle === this.hovered) return;
    this.hovered = handle;
    this.canvas.style.cursor = handle < 0 ? '' : 'move';
    this.place_boxes();
  }

  // How far along an axis through a point the pointer is, in metres; null where the axis points at the eye.
  along(through, axis, event) {
    const eye = this.camera.position, x = 2 * event.offsetX / this.canvas.clientWidth - 1, y = 1 - 2 * event.offsetY / this.canvas.clientHeight;
    const sight = new THREE.Vector3(x, y, 0.5).unproject(this.camera).sub(eye).normalize();
    const normal = new THREE.Vector3().setComponent(axis, 1), off = new THREE.Vector3(...through).sub(eye);
    const cosine = normal.dot(sight), facing = 1 - cosine * cosine;
    return facing < kFacing ? null : (cosine * sight.dot(off) - normal.dot(off)) / facing;
  }
}

// ---- Shapes

function middle(a, b) { return a.map((v, i) => (v + b[i]) / 2); }
function closed(corners) { return [...corners, corners[0]]; }
function towards(from, to, share) { return from.map((v, i) => v + share * (to[i] - v)); }

function face_middle(box, face) {
  const place = [0, 2, 4].map((k) => (box[k] + box[k + 1]) / 2);
  place[face >> 1] = box[face];
  return place;
}

function face_corners(box, face) {
  const axis = face >> 1, [b, c] = [0, 1, 2].filter((k) => k !== axis);
  return [[0, 0], [1, 0], [1, 1], [0, 1]].map(([i, j]) => {
    const place = [0, 0, 0];
    place[axis] = box[face];
    place[b] = box[2 * b + i];
    place[c] = box[2 * c + j];
    return place;
  });
}

// Lines across a patch, at most 60 each way; in pieces, for software that draws WebGL loses a line that begins behind the
// eye.
function grid_lines([a, b, c, d], step_m) {
  const across = (from, to, from_2, to_2) => {
    const count = Math.min(60, Math.floor(Math.hypot(...to.map((v, i) => v - from[i])) / step_m));
    return Array.from({ length: count + 1 }, (_, k) => [towards(from, to, k / count), towards(from_2, to_2, k / count)])
      .map(([begin_m, end_m]) => Array.from({ length: 9 }, (_, k) => towards(begin_m, end_m, k / 8)));
  };
  return [...across(a, b, d, c), ...across(a, d, b, c)];
}

function arrow(from, ahead, length_m) {
  const tip = from.map((v, i) => v + length_m * ahead[i]), left = [-ahead[1], ahead[0], 0];
  const barb = (side) => tip.map((v, i) => v - 0.4 * ahead[i] + side * 0.25 * left[i]);
  return [[from, tip], [barb(1), tip, barb(-1)]];
}

function cross(at, half_m) {
  return [0, 1, 2].map((axis) => [-1, 1].map((sign) => at.map((v, i) => (i === axis ? v + sign * half_m : v))));
}

function dashes(from, to) {
  const count = Math.max(1, Math.min(200, Math.ceil(Math.hypot(...to.map((v, i) => v - from[i])) / 0.3)));
  return Array.from({ length: count }, (_, k) => [towards(from, to, k / count), towards(from, to, (k + 0.55) / count)]);
}

// ---- Buffers: they grow by half, and are filled anew in place.

function fill_attribute(geometry, name, numbers, width, kind) {
  let attribute = geometry.getAttribute(name);
  if (!attribute || attribute.array.length < numbers.length) {
    geometry.dispose();
    attribute = new THREE.BufferAttribute(new kind(Math.ceil(1.5 * numbers.length / width) * width), width);
    attribute.setUsage(THREE.DynamicDrawUsage);
    geometry.setAttribute(name, attribute);
  }
  attribute.array.set(numbers);
  attribute.clearUpdateRanges();
  attribute.addUpdateRange(0, numbers.length);
  attribute.needsUpdate = true;
}

function fill_points(geometry, xyz, labels) {
  fill_attribute(geometry, 'position', xyz, 3, Float32Array);
  fill_attribute(geometry, 'label', labels, 1, Uint8Array);
  geometry.setDrawRange(0, labels.length);
}

function fill_shapes(geometry, { places, colours }) {
  fill_attribute(geometry, 'position', places, 3, Float32Array);
  fill_attribute(geometry, 'color', colours, 4, Float32Array);
  geometry.setDrawRange(0, places.length / 3);
}
